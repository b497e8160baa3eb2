#include "verify/box_forms.h"

namespace maxwrench {
namespace {

/// Arcs as wide are not enclosed: below pi.
constexpr double kWidestArc = 3.1;

CosSin<double> enclose(double x) {
  const CosSin<long double> at = enclose_wide(x);
  return {narrow(at.c), narrow(at.s)};
}

}  // namespace

const CosSin<double>& BoxForms::at(double angle) {
  const auto found = known_.find(angle);
  return found != known_.end() ? found->second
                               : known_.emplace(angle, enclose(angle)).first->second;
}

/// With the middle m and half the width r: where the tangents meet, (cos m, sin m)/cos r, is the
/// sum of the ends over 1 + cos 2r.
bool BoxForms::set_turning(Corners& corners) {
  if (!(Narrow::above(corners.upper - corners.lower) < kWidestArc)) return false;
  const CosSin<double> a = at(corners.lower), b = at(corners.upper);
  const Narrow below = Narrow(1.0) + a.c * b.c + a.s * b.s;
  corners.first[0] = a.c;
  corners.second[0] = a.s;
  corners.first[1] = (a.c + b.c) / below;
  corners.second[1] = (a.s + b.s) / below;
  corners.first[2] = b.c;
  corners.second[2] = b.s;
  return true;
}

bool BoxForms::set(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  bool narrow_enough = true;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    Corners& corners = corners_[i];
    if (corners.lower == lower[k] && corners.upper == upper[k]) continue;
    corners.lower = lower[k];
    corners.upper = upper[k];
    if (shape_.terms[i] == 2) {
      corners.first[0] = lower[k];
      corners.first[1] = upper[k];
    } else if (!set_turning(corners)) {
      corners.lower = kInfinity;  // look again
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
          values[k] = f0 + f1 * corners.first[0];
          values[k + stride] = f0 + f1 * corners.first[1];
          continue;
        }
        const Narrow f2 = values[k + 2 * stride];
        for (std::size_t corner = 0; corner < 3; ++corner) {
          values[k + corner * stride] =
              f0 + f1 * corners.first[corner] + f2 * corners.second[corner];
        }
      }
    }
  }
}

Narrow BoxForms::at_point(const FormShape& shape, const FormRow& row, const Eigen::VectorXd& q) {
  Narrow sum;
  std::vector<CosSin<double>> known;
  for (const double x : q) known.push_back(enclose(x));
  for (std::size_t k = 0; k < row.index.size(); ++k) {
    Narrow term = row.coefficient[k];
    for (std::size_t i = 0; i < known.size(); ++i) {
      const int digit = shape.digit(row.index[k], i);
      if (digit == 0) continue;
      const Narrow turning = digit == 1 ? known[i].c : known[i].s;
      term = term * (shape.terms[i] == 2 ? Narrow(q[static_cast<Eigen::Index>(i)]) : turning);
    }
    sum += term;
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
