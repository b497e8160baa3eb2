#include <algorithm>

#include "verify/model.h"
#include "verify/wide_matrix.h"

namespace maxwrench {
namespace {

/// The coefficient `index` of each entry; zero if `index` is negative.
WideRows coefficients(const FormMatrix& R, int index) {
  WideRows M(3, std::vector<Wide>(3));
  if (index < 0) return M;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      M[i][j] = R[i][j].coefficients()[static_cast<std::size_t>(index)];
    }
  }
  return M;
}

/// The largest row sum of |R'R - 1| for R = A + c B + s C at any angle. Because c^2 = 1 - s^2, R'R
/// is a sum of matrices times 1, c, s, s^2 and c s.
long double off_rotations(const WideRows& A, const WideRows& B, const WideRows& C) {
  const WideRows AT = transposed(A), BT = transposed(B), CT = transposed(C);
  const WideRows AA = AT * A, BB = BT * B, CC = CT * C, AB = AT * B, AC = AT * C, BC = BT * C;
  long double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    Wide row;
    for (std::size_t j = 0; j < 3; ++j) {
      const Wide one(i == j ? 1.0L : 0.0L);
      row += (AA[i][j] + BB[i][j] - one).magnitude();
      row += (AB[i][j] + AB[j][i]).magnitude();
      row += (AC[i][j] + AC[j][i]).magnitude();
      row += (CC[i][j] - BB[i][j]).magnitude();
      row += (BC[i][j] + BC[j][i]).magnitude();
    }
    most = std::max(most, row.high);
  }
  return most;
}

}  // namespace

long double FormModel::shrinking() const {
  Wide sum;
  const auto add = [&](const FormMatrix& R, int variable) {
    const int stride = variable < 0 ? -1 : shape_.strides[static_cast<std::size_t>(variable)];
    const bool turns = variable >= 0 && shape_.terms[static_cast<std::size_t>(variable)] == 3;
    sum += off_rotations(coefficients(R, 0), coefficients(R, turns ? stride : -1),
                         coefficients(R, turns ? 2 * stride : -1));
  };
  const auto tip = static_cast<std::size_t>(problem_.end_effector);
  add(transposed(matrix(problem_.pose.R)), -1);
  add(matrix(problem_.robot.end_effectors[tip].placement.R), -1);
  for (std::size_t i = 0; i < places_.size(); ++i) add(places_[i].R, coordinates_.of_joint[i]);
  return sum.high;
}

}  // namespace maxwrench
