#pragma once

#include <array>
#include <vector>

#include "verify/interval.h"

namespace maxwrench {

/// The variables of a `Form`: a turning one q has the terms 1, cos q, sin q, a sliding one 1, q.
struct FormShape {
  std::vector<int> terms;        ///< 3 or 2 for each variable
  std::vector<int> coordinates;  ///< which side of a box each variable is
  std::vector<int> strides;      ///< of a variable's terms among all, the last one's 1
  int size = 1;                  ///< of all products of terms, at most kMostTerms

  /// More products of terms than this take too long for a box, and too much memory.
  static constexpr int kMostTerms = 20'000;

  /// Throws std::invalid_argument, in one line, if there are more.
  FormShape(std::vector<int> terms_of, std::vector<int> coordinates_of);
  /// Of the variables from one to before another.
  FormShape stretch(int from, int to) const;
  int digit(int index, std::size_t variable) const {
    return index / strides[variable] % terms[variable];
  }
};

/// A multi-affine function of joints: a coefficient for each product of terms, one term of each
/// variable. The shape outlives it.
class Form {
 public:
  explicit Form(const FormShape& shape, const Wide& constant = 0.0L);
  /// constant + by_1 t_1 + by_2 t_2 with the terms of one variable.
  Form(const FormShape& shape, int variable, const Wide& constant, const Wide& by_1,
       const Wide& by_2);

  const std::vector<Wide>& coefficients() const { return c_; }
  /// Sum of |coefficients| where all terms are at most 1 in magnitude, sliding ones up to `far`.
  long double magnitude(const std::vector<double>& far) const;
  /// The same of one of them.
  long double magnitude(int index, const std::vector<double>& far) const;

  Form& operator+=(const Form& other);
  Form operator-() const;
  friend Form operator+(Form a, const Form& b) { return a += b; }
  friend Form operator-(Form a, const Form& b) { return a += -b; }
  /// Of functions that have no variable in common; throws std::logic_error of others.
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

/// The coefficients of a form, rounded outward. Those that are nearly zero, by the rounding of what
/// they were made of, become part of the constant one: their terms are at most 1 in magnitude, or
/// at most `far`.
struct FormRow {
  std::vector<int> index;
  std::vector<Narrow> coefficient;
  FormRow(const Form& form, const std::vector<double>& far);
};

}  // namespace maxwrench
