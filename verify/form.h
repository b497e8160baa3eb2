#pragma once

#include <array>
#include <vector>

#include "verify/interval.h"

namespace maxwrench {

/// The variables of a `Form`. A turning variable q has the terms 1, cos q, sin q; a sliding one has
/// 1, q.
struct FormShape {
  std::vector<int> terms;        ///< 3 or 2 for each variable
  std::vector<int> coordinates;  ///< the coordinate of the box that each variable is
  std::vector<int> strides;  ///< index strides of each variable's terms; 1 for the last variable
  int size = 1;              ///< number of products of terms, at most kMostTerms

  /// More products of terms than this need too much time for each box and too much memory.
  static constexpr int kMostTerms = 20'000;

  /// Throws std::invalid_argument, in one line, if there are more products than kMostTerms.
  FormShape(std::vector<int> terms_of, std::vector<int> coordinates_of);
  /// The shape of the variables `from` to `to` - 1.
  FormShape stretch(int from, int to) const;
  int digit(int index, std::size_t variable) const {
    return index / strides[variable] % terms[variable];
  }
};

/// A multi-affine function of joints: one coefficient for each product of terms, with one term of
/// each variable. The shape must outlive the form.
class Form {
 public:
  explicit Form(const FormShape& shape, const Wide& constant = 0.0L);
  /// constant + by_1 t_1 + by_2 t_2 with the terms of one variable.
  Form(const FormShape& shape, int variable, const Wide& constant, const Wide& by_1,
       const Wide& by_2);

  const std::vector<Wide>& coefficients() const { return c_; }
  /// The sum of |coefficients|, each times the largest magnitude of its terms: 1, or `far` for a
  /// sliding variable.
  long double magnitude(const std::vector<double>& far) const;
  /// The same for one coefficient.
  long double magnitude(int index, const std::vector<double>& far) const;

  Form& operator+=(const Form& other);
  Form operator-() const;
  friend Form operator+(Form a, const Form& b) { return a += b; }
  friend Form operator-(Form a, const Form& b) { return a += -b; }
  /// The product of functions without a common variable. Throws std::logic_error for others.
  friend Form operator*(const Form& a, const Form& b);

 private:
  std::vector<int> nonzero() const;

  const FormShape* shape_;
  std::vector<Wide> c_;
};

using FormVector = std::array<Form, 3>;
using FormMatrix = std::array<FormVector, 3>;  ///< rows

Form dot(const FormVector& a, const FormVector& b);
FormVector operator+(const FormVector& a, const FormVector& b);
FormVector operator-(const FormVector& a, const FormVector& b);
FormVector operator*(const Form& a, const FormVector& b);
FormVector operator*(const FormMatrix& a, const FormVector& b);
FormMatrix operator*(const FormMatrix& a, const FormMatrix& b);
FormVector cross(const FormVector& a, const FormVector& b);
FormMatrix transposed(const FormMatrix& a);

/// The coefficients of a form, rounded outward. Coefficients that are zero up to the rounding of
/// their terms are added to the constant one as an interval, with the largest magnitude of their
/// terms: 1, or `far`.
struct FormRow {
  std::vector<int> index;
  std::vector<Narrow> coefficient;
  FormRow(const Form& form, const std::vector<double>& far);
};

/// The same row on the variables `from` to `to` - 1 of a shape alone, `FormShape::stretch`. On the
/// grid of all variables, point v is point (v / repeat) mod size of the stretch; `repeat_after`.
/// Throws std::logic_error if the row depends on other variables.
FormRow on_stretch(FormRow row, const FormShape& shape, int from, int to);

/// The number of products of the terms of all variables from `to` on.
int repeat_after(const FormShape& shape, int to);

}  // namespace maxwrench
