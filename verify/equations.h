#pragma once

#include <memory>
#include <vector>

#include "verify/box_forms.h"

namespace maxwrench {

class FormModel;
struct Problem;

/// The equations f(x) = 0 of a posture's coordinates x, m rows. Each row is the sum of two sides.
///
/// Unless the base's pose has a closed form, the first equations equate the base's pose in its
/// mount from the joints up to the middle of the chain with that from the joints after it. They are
/// all rows of the rotation and those rows of the position that no free axis moves:
///
///     Rz(yaw) T_1(q_1) ... T_k(q_k) - mount^-1 X(s) (T_k+1(q_k+1) ... T_n(q_n))^-1 = 0.
///
/// The other equations put the second end effector at the contact, T_e2(q_2) - T_e1(q_1) X(s)^-1
/// F(s_2) = 0, in position only or in the whole pose. Each row is an interval: it includes the
/// effect of rounding in the problem's numbers, so that every posture of the intended numbers
/// satisfies it.
class Equations {
 public:
  /// The model must outlive this object.
  Equations(const Problem& problem, const FormModel& model);

  int count() const { return count_; }

  /// Rows that depend only on a stretch of the variables. On the grid of all control points, point
  /// v corresponds to point (v / repeat) mod shape.size of this side.
  struct Side {
    std::unique_ptr<const FormShape> shape;
    int repeat = 1;
    int row = 0;  ///< index of the first row
    std::vector<FormRow> rows;
  };
  const std::vector<Side>& sides() const { return sides_; }

  /// The largest |f_i| at x.
  double residual(const Eigen::VectorXd& x) const;

 private:
  void add_base(const Problem& problem, const FormModel& model);
  void add_contact(const Problem& problem, const FormModel& model);
  void add_side(const FormModel& model, int from, int to, const std::vector<Form>& rows);

  std::vector<Side> sides_;
  int count_ = 0;
};

/// nu'f over a box. Not thread-safe: use one object for each thread.
class EquationsOverBox {
 public:
  /// Keeps a reference to the equations.
  explicit EquationsOverBox(const Equations& equations);

  /// Sets the box. False if it is too wide or cannot be enclosed.
  bool set(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
  /// Whether nu'f > 0 in the whole box, so that it contains no posture.
  bool excluded(const double* nu);
  /// Adds the control points of nu'f to `points`, which are on the grid of all variables.
  void add_to(std::vector<Narrow>& points, const double* nu);

 private:
  const std::vector<Narrow>& points(std::size_t side, const double* nu);

  const Equations& equations_;
  std::vector<BoxForms> boxes_;
  std::vector<Narrow> points_;
};

}  // namespace maxwrench
