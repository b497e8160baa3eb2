#pragma once

#include <memory>
#include <vector>

#include "verify/box_forms.h"

namespace maxwrench {

class FormModel;
struct Problem;

/// What a posture's coordinates x fulfil, f(x) = 0, m rows, each the sum of two sides.
///
/// Unless the base follows in closed form, its pose in its mount, by the joints up to the middle of
/// the chain and by those behind it, in all rows of the rotation and those of the position that no
/// free axis moves:
///
///     Rz(yaw) T_1(q_1) ... T_k(q_k) - mount^-1 X(s) (T_k+1(q_k+1) ... T_n(q_n))^-1 = 0.
///
/// And the place of the second end effector is the contact's, T_e2(q_2) - T_e1(q_1) X(s)^-1 F(s_2)
/// = 0, in position or in all. Each row is an interval about that: what the rounding of the
/// problem's numbers may do to it, so that a posture of the numbers meant is one of these.
class Equations {
 public:
  /// Of a model, which outlives it.
  Equations(const Problem& problem, const FormModel& model);

  int count() const { return count_; }

  /// Some rows that depend on a stretch of the variables alone. On the grid of the control points
  /// of all, point v of all is point (v / repeat) mod shape.size of these.
  struct Side {
    std::unique_ptr<const FormShape> shape;
    int repeat = 1;
    int row = 0;  ///< the first
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

/// nu'f over a box. One object serves one thread.
class EquationsOverBox {
 public:
  /// Keeps a reference.
  explicit EquationsOverBox(const Equations& equations);

  /// False if the box is too wide, or nothing is known of it.
  bool set(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
  /// Whether nu'f > 0 in all of the box, so that it has no posture.
  bool excluded(const double* nu);
  /// Adds the control points of nu'f to those of all.
  void add_to(std::vector<Narrow>& points, const double* nu);

 private:
  const std::vector<Narrow>& points(std::size_t side, const double* nu);

  const Equations& equations_;
  std::vector<BoxForms> boxes_;
  std::vector<Narrow> points_;
};

}  // namespace maxwrench
