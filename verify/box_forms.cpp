#include "verify/box_forms.h"

namespace maxwrench {
namespace {

/// Arcs this wide or wider are not enclosed. It is below pi.
constexpr double kWidestArc = 3.1;

/// The largest number of cached angles.
constexpr std::size_t kMostKnown = 10000;

CosSin<double> enclose(double x) {
  const CosSin<long double> at = enclose_wide(x);
  return {narrow(at.c), narrow(at.s)};
}

}  // namespace

const CosSin<double>& BoxForms::at(double angle) {
  if (known_.size() > kMostKnown) known_.clear();
  const auto found = known_.find(angle);
  return found != known_.end() ? found->second
                               : known_.emplace(angle, enclose(angle)).first->second;
}

/// Let m be the middle of the arc and r half its width. The tangents meet at (cos m, sin m)/cos r,
/// which is the sum of the ends divided by 1 + cos 2r.
bool BoxForms::set_turning(Corners& corners) {
  if (!(Narrow::above(corners.upper - corners.lower) < kWidestArc)) return false;
  const CosSin<double> a = at(corners.lower), b = at(corners.upper);
  const Narrow below = Narrow(1.0) + a.c * b.c + a.s * b.s;
  if (!(below.low > 0)) return false;  // the angles are so large that no digit is exact
  corners.first[0] = Term(a.c);
  corners.second[0] = Term(a.s);
  corners.first[1] = Term((a.c + b.c) / below);
  corners.second[1] = Term((a.s + b.s) / below);
  corners.first[2] = Term(b.c);
  corners.second[2] = Term(b.s);
  return true;
}

BoxForms::Term::Term(const Narrow& x)
    : middle((x.low + x.high) / 2),
      radius(Narrow::above(std::max(x.high - middle, middle - x.low))) {}

/// f0 + f1 t1 + f2 t2, first rounded to nearest. Let M_i be the magnitudes of f_i, u = epsilon/2,
/// and S = M_0 + M_1 |t1| + M_2 |t2| at the middles. Two products, two sums and the last difference
/// have an error of less than 6 u S. The radii add M_i r_i. The sum is less than E, even after
/// rounding E, which changes it by a few u E.
Narrow BoxForms::combine(const Narrow& f0, const Narrow& f1, const Narrow& f2, const Term& t1,
                         const Term& t2) {
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  const double low = f0.low + (t1.middle < 0 ? f1.high : f1.low) * t1.middle +
                     (t2.middle < 0 ? f2.high : f2.low) * t2.middle;
  const double high = f0.high + (t1.middle < 0 ? f1.low : f1.high) * t1.middle +
                      (t2.middle < 0 ? f2.low : f2.high) * t2.middle;
  const double E = kRounding * f0.magnitude() +
                   (kRounding * std::abs(t1.middle) + 2 * t1.radius) * f1.magnitude() +
                   (kRounding * std::abs(t2.middle) + 2 * t2.radius) * f2.magnitude() + kTiny;
  return {low - E, high + E};
}

bool BoxForms::set(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  bool narrow_enough = true;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const int k = shape_.coordinates[i];
    Corners& corners = corners_[i];
    if (corners.lower == lower[k] && corners.upper == upper[k]) continue;
    corners.lower = lower[k];
    corners.upper = upper[k];
    if (shape_.terms[i] == 2) {
      corners.first[0] = Term(Narrow(lower[k]));
      corners.first[1] = Term(Narrow(upper[k]));
    } else if (!set_turning(corners)) {
      corners.lower = kInfinity;  // compute it again next time
      narrow_enough = false;
    }
  }
  return narrow_enough;
}

void BoxForms::over_box(std::vector<Narrow>& values) const {
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Corners& corners = corners_[i];
    const auto stride = static_cast<std::size_t>(shape_.strides[i]);
    const auto terms = static_cast<std::size_t>(shape_.terms[i]);
    for (std::size_t block = 0; block < values.size(); block += terms * stride) {
      for (std::size_t k = block; k < block + stride; ++k) {
        const Narrow f0 = values[k], f1 = values[k + stride];
        if (terms == 2) {
          values[k] = combine(f0, f1, 0.0, corners.first[0], Term());
          values[k + stride] = combine(f0, f1, 0.0, corners.first[1], Term());
          continue;
        }
        const Narrow f2 = values[k + 2 * stride];
        for (std::size_t corner = 0; corner < 3; ++corner) {
          values[k + corner * stride] =
              combine(f0, f1, f2, corners.first[corner], corners.second[corner]);
        }
      }
    }
  }
}

Narrow BoxForms::at_point(const FormShape& shape, const FormRow& row, const Eigen::VectorXd& q) {
  Narrow sum;
  std::vector<double> x;
  std::vector<CosSin<double>> known;
  for (const int at : shape.coordinates) {
    x.push_back(q[at]);
    known.push_back(enclose(x.back()));
  }
  for (std::size_t k = 0; k < row.index.size(); ++k) {
    Narrow term = row.coefficient[k];
    for (std::size_t i = 0; i < known.size(); ++i) {
      const int digit = shape.digit(row.index[k], i);
      if (digit == 0) continue;
      const Narrow turning = digit == 1 ? known[i].c : known[i].s;
      term = term * (shape.terms[i] == 2 ? Narrow(x[i]) : turning);
    }
    sum += term;
  }
  return sum;
}

void set_products(const FormShape& shape, const Eigen::VectorXd& q, std::vector<double>& terms) {
  terms.assign(1, 1.0);
  for (std::size_t i = 0; i < shape.terms.size(); ++i) {
    const double x = q[shape.coordinates[i]];
    const bool turns = shape.terms[i] == 3;
    std::vector<double> more;
    for (const double term : terms) {
      more.push_back(term);
      more.push_back(term * (turns ? std::cos(x) : x));
      if (turns) more.push_back(term * std::sin(x));
    }
    terms = std::move(more);
  }
}

double value_near(const FormRow& row, const std::vector<double>& terms) {
  double sum = 0;
  for (std::size_t k = 0; k < row.index.size(); ++k) {
    sum += row.coefficient[k].low * terms[static_cast<std::size_t>(row.index[k])];
  }
  return sum;
}

void add_to(std::vector<Narrow>& sum, const FormRow& row, const Narrow& factor) {
  for (std::size_t k = 0; k < row.index.size(); ++k) {
    Narrow& to = sum[static_cast<std::size_t>(row.index[k])];
    to += row.coefficient[k] * factor;
  }
}

}  // namespace maxwrench
