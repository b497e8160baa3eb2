#include "verify/form.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace maxwrench {

FormShape::FormShape(std::vector<int> terms_of, std::vector<int> coordinates_of)
    : terms(std::move(terms_of)), coordinates(std::move(coordinates_of)) {
  strides.resize(terms.size());
  for (std::size_t i = terms.size(); i-- > 0;) {
    strides[i] = size;
    size *= terms[i];
    if (size > kMostTerms) {
      throw std::invalid_argument("got " + std::to_string(terms.size()) +
                                  " coordinates of a posture, expected at most 9 that turn: a "
                                  "proof uses 3 points for each, multiplied");
    }
  }
}

FormShape FormShape::stretch(int from, int to) const {
  return {{terms.begin() + from, terms.begin() + to},
          {coordinates.begin() + from, coordinates.begin() + to}};
}

Form::Form(const FormShape& shape, const Wide& constant)
    : shape_(&shape), c_(static_cast<std::size_t>(shape.size)) {
  c_[0] = constant;
}

Form::Form(const FormShape& shape, int variable, const Wide& constant, const Wide& by_1,
           const Wide& by_2)
    : Form(shape, constant) {
  const auto at = static_cast<std::size_t>(variable);
  const auto stride = static_cast<std::size_t>(shape.strides[at]);
  c_[stride] = by_1;
  if (shape.terms[at] == 3) c_[2 * stride] = by_2;
}

long double Form::magnitude(int index, const std::vector<double>& far) const {
  Wide term = c_[static_cast<std::size_t>(index)].magnitude();
  for (std::size_t i = 0; i < far.size(); ++i) {
    const bool slides = shape_->terms[i] == 2 && shape_->digit(index, i) == 1;
    if (slides) term = term * Wide(far[i]);
  }
  return term.high;
}

long double Form::magnitude(const std::vector<double>& far) const {
  Wide sum;
  for (int k = 0; k < shape_->size; ++k) sum += Wide(magnitude(k, far));
  return sum.high;
}

Form& Form::operator+=(const Form& other) {
  for (std::size_t k = 0; k < c_.size(); ++k) {
    if (other.c_[k].is_zero()) continue;
    c_[k] = c_[k].is_zero() ? other.c_[k] : c_[k] + other.c_[k];
  }
  return *this;
}

Form Form::operator-() const {
  Form result = *this;
  for (Wide& c : result.c_) c = -c;
  return result;
}

std::vector<int> Form::nonzero() const {
  std::vector<int> index;
  for (int k = 0; k < shape_->size; ++k) {
    if (!c_[static_cast<std::size_t>(k)].is_zero()) index.push_back(k);
  }
  return index;
}

/// The functions have no common variable, so the index of a product is the sum of the two indices.
Form operator*(const Form& a, const Form& b) {
  const std::vector<int> of_a = a.nonzero(), of_b = b.nonzero();
  for (std::size_t i = 0; i < a.shape_->terms.size(); ++i) {
    const auto has = [&](int k) { return a.shape_->digit(k, i) != 0; };
    if (std::any_of(of_a.begin(), of_a.end(), has) && std::any_of(of_b.begin(), of_b.end(), has)) {
      throw std::logic_error("a product of functions of the same variable");
    }
  }
  Form result(*a.shape_);
  for (const int i : of_a) {
    const Wide& x = a.c_[static_cast<std::size_t>(i)];
    for (const int j : of_b) {
      const Wide& y = b.c_[static_cast<std::size_t>(j)];
      Wide& to = result.c_[static_cast<std::size_t>(i + j)];
      to = to.is_zero() ? x * y : to + x * y;
    }
  }
  return result;
}

Form dot(const FormVector& a, const FormVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

FormVector operator+(const FormVector& a, const FormVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

FormVector operator-(const FormVector& a, const FormVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

FormVector operator*(const Form& a, const FormVector& b) { return {a * b[0], a * b[1], a * b[2]}; }

FormVector operator*(const FormMatrix& a, const FormVector& b) {
  return {dot(a[0], b), dot(a[1], b), dot(a[2], b)};
}

FormMatrix operator*(const FormMatrix& a, const FormMatrix& b) {
  const FormMatrix columns = transposed(b);
  return transposed({a * columns[0], a * columns[1], a * columns[2]});
}

FormVector cross(const FormVector& a, const FormVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

FormMatrix transposed(const FormMatrix& a) {
  return {FormVector{a[0][0], a[1][0], a[2][0]}, FormVector{a[0][1], a[1][1], a[2][1]},
          FormVector{a[0][2], a[1][2], a[2][2]}};
}

FormRow::FormRow(const Form& form, const std::vector<double>& far) {
  constexpr long double kNearlyZero = 1e-16L;  // share of the sum of all magnitudes
  const long double all = form.magnitude(far);
  Wide constant = form.coefficients()[0];
  for (int k = 1; k < static_cast<int>(form.coefficients().size()); ++k) {
    const Wide& c = form.coefficients()[static_cast<std::size_t>(k)];
    if (c.is_zero()) continue;
    const long double size = form.magnitude(k, far);
    if (size <= kNearlyZero * all) {
      constant += Wide(-size, size);
      continue;
    }
    index.push_back(k);
    coefficient.push_back(narrow(c));
  }
  if (constant.is_zero()) return;
  index.push_back(0);
  coefficient.push_back(narrow(constant));
}

FormRow on_stretch(FormRow row, const FormShape& shape, int from, int to) {
  const int repeat = repeat_after(shape, to), size = repeat_after(shape, from) / repeat;
  for (int& index : row.index) {
    if (index % repeat != 0 || index / repeat >= size) {
      throw std::logic_error("a row depends on other variables");
    }
    index /= repeat;
  }
  return row;
}

int repeat_after(const FormShape& shape, int to) {
  int repeat = 1;
  for (auto i = static_cast<std::size_t>(to); i < shape.terms.size(); ++i) repeat *= shape.terms[i];
  return repeat;
}

}  // namespace maxwrench
