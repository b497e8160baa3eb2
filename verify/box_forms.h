#pragma once

#include <unordered_map>
#include <vector>

#include "maxwrench/types.h"
#include "verify/form.h"

namespace maxwrench {

/// A box of coordinates, with corners that enclose the terms of each coordinate. For a turning
/// joint these are the three corners of a triangle: the ends of its arc and the point where their
/// tangents meet. For a sliding joint they are the ends of its interval. The values of a form over
/// the box lie in the convex hull of its values at products of these corners. These values are its
/// control points, one for each coefficient.
class BoxForms {
 public:
  /// Keeps a reference to the shape.
  explicit BoxForms(const FormShape& shape) : shape_(shape), corners_(shape.terms.size()) {}

  /// Sets the box. False if an arc is half a turn or more, or cannot be enclosed.
  bool set(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
  /// Replaces coefficients by control points.
  void over_box(std::vector<Narrow>& values) const;

  /// The value at a single point q, where all corners coincide.
  static Narrow at_point(const FormShape& shape, const FormRow& row, const Eigen::VectorXd& q);

 private:
  /// A term at a corner, within `radius` of `middle`.
  struct Term {
    double middle = 0, radius = 0;
    Term() = default;
    explicit Term(const Narrow& x);
  };
  struct Corners {
    double lower = kInfinity, upper = -kInfinity;
    Term first[3], second[3];  ///< the first two terms other than 1 at each corner
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

/// Computes the products of terms at q, one for each coefficient, in ordinary arithmetic.
void set_products(const FormShape& shape, const Eigen::VectorXd& q, std::vector<double>& terms);
/// A number near the value of a row, from the products of terms.
double value_near(const FormRow& row, const std::vector<double>& terms);

}  // namespace maxwrench
