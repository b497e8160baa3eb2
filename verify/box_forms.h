#pragma once

#include <unordered_map>
#include <vector>

#include "maxwrench/types.h"
#include "verify/form.h"

namespace maxwrench {

/// A box of coordinates, corner by corner of what encloses it: of a turning joint the triangle of
/// the ends of its arc and the point where their tangents meet, of a sliding one its interval. A
/// form's values over the box lie in the hull of its values at products of these corners: its
/// control points, one for each coefficient.
class BoxForms {
 public:
  /// Keeps a reference.
  explicit BoxForms(const FormShape& shape) : shape_(shape), corners_(shape.terms.size()) {}

  /// False if an arc is half a turn or more, or nothing is known of it.
  bool set(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
  /// Coefficients -> control points.
  void over_box(std::vector<Narrow>& values) const;

  /// The same of one point: where all corners are one.
  static Narrow at_point(const FormShape& shape, const FormRow& row, const Eigen::VectorXd& q);

 private:
  /// What a term is at a corner: within `radius` of `middle`.
  struct Term {
    double middle = 0, radius = 0;
    Term() = default;
    explicit Term(const Narrow& x);
  };
  struct Corners {
    double lower = kInfinity, upper = -kInfinity;
    Term first[3], second[3];  ///< the second and third term, or the second
  };
  static Narrow combine(const Narrow& f0, const Narrow& f1, const Narrow& f2, const Term& t1,
                        const Term& t2);
  const CosSin<double>& at(double angle);
  bool set_turning(Corners& corners);

  const FormShape& shape_;
  std::vector<Corners> corners_;
  std::unordered_map<double, CosSin<double>> known_;
};

/// sum += factor * row
void add_to(std::vector<Narrow>& sum, const FormRow& row, const Narrow& factor);

}  // namespace maxwrench
