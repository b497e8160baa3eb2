#include "solvers/search/knot_drawing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "lib/math/decompositions.h"

namespace maxwrench {
namespace {

constexpr double kNear = 0.5;  // [rad or m] distance of near tables, at most
constexpr double kBump = 1.2;  // [rad or m] the largest wave that is added to a transfer
constexpr int kWaves = 3;

}  // namespace

KnotDrawing::KnotDrawing(const Objective& objective, const TrajectoryEvaluator& trajectories,
                         Eigen::VectorXd start)
    : objective_(objective),
      rows_(trajectories.rows()),
      start_(std::move(start)),
      alike_(!trajectories.starts()),
      knots_(trajectories.knots()),
      between_(trajectories.starts() && trajectories.program().common) {
  std::vector<Eigen::Index> equations;
  for (Eigen::Index row = 0; row < rows_.r_min.size(); ++row) {
    if (rows_.r_min[row] == rows_.r_max[row]) equations.push_back(row);
  }
  const Eigen::MatrixXd R = rows_.R;
  equations_ = R(equations, Eigen::all);
  if (!equations.empty()) inverse_ = pseudo_inverse(equations_);
  const Eigen::Index moved = alike_ ? start_.size() / trajectories.knots() : start_.size();
  const Eigen::Index times = start_.size() / moved;
  down_ = (objective.lower() - start_).reshaped(moved, times).rowwise().maxCoeff();
  up_ = (objective.upper() - start_).reshaped(moved, times).rowwise().minCoeff();
}

Eigen::VectorXd KnotDrawing::draw(Random random, bool near) const {
  if (between_) return bump(random, near ? kNear : kBump);
  Eigen::VectorXd offset(down_.size());
  for (Eigen::Index i = 0; i < offset.size(); ++i) {
    offset[i] = near ? std::clamp(random.uniform(-kNear, kNear), down_[i], up_[i])
                     : random.uniform(down_[i], up_[i]);
  }
  return moved(offset.replicate(start_.size() / offset.size(), 1));
}

Eigen::VectorXd KnotDrawing::kick(Random random, double reach, bool alike) const {
  const Eigen::Index drawn = alike ? down_.size() : start_.size();
  const Eigen::VectorXd offset =
      Eigen::VectorXd::NullaryExpr(drawn, [&] { return random.uniform(-reach, reach); });
  return moved(offset.replicate(start_.size() / drawn, 1)
                   .cwiseMax(objective_.lower() - start_)
                   .cwiseMin(objective_.upper() - start_));
}

Eigen::VectorXd KnotDrawing::moved(Eigen::VectorXd offset) const {
  if (equations_.rows() > 0) offset -= inverse_ * (equations_ * offset);
  return (start_ + offset.cwiseProduct(shares(offset).replicate(knots_, 1)))
      .cwiseMax(objective_.lower())
      .cwiseMin(objective_.upper());
}

/// Adds a smooth curve to each coordinate that vanishes at both ends of a transfer.
Eigen::VectorXd KnotDrawing::bump(Random& random, double reach) const {
  const Eigen::Index r = start_.size() / knots_;
  Eigen::MatrixXd offset = Eigen::MatrixXd::Zero(r, knots_);
  for (int wave = 1; wave <= kWaves; ++wave) {
    const Eigen::RowVectorXd shape = Eigen::RowVectorXd::NullaryExpr(knots_, [&](Eigen::Index i) {
      return std::sin(wave * std::numbers::pi * static_cast<double>(i + 1) /
                      static_cast<double>(knots_ + 1)) /
             wave;
    });
    for (Eigen::Index j = 0; j < r; ++j) offset.row(j) += random.uniform(-reach, reach) * shape;
  }
  return moved(offset.reshaped()
                   .cwiseMax(objective_.lower() - start_)
                   .cwiseMin(objective_.upper() - start_));
}

/// The shares of a step from the start that the rows permit, of each coordinate. Where all knots
/// move alike, and where both ends are given, the least one counts for all: the shape stays.
Eigen::VectorXd KnotDrawing::shares(const Eigen::VectorXd& offset) const {
  const Eigen::Index r = start_.size() / knots_, each = rows_.r_min.size() / r;
  const Eigen::VectorXd at = rows_.R * start_, moved = rows_.R * offset;
  Eigen::VectorXd shares = Eigen::VectorXd::Ones(r);
  for (Eigen::Index row = 0; row < at.size(); ++row) {
    if (std::abs(moved[row]) < 1e-12) continue;
    const double room = moved[row] > 0 ? rows_.r_max[row] - at[row] : rows_.r_min[row] - at[row];
    double& share = shares[row / each];
    share = std::min(share, std::max(0.0, room / moved[row]));
  }
  if (alike_ || between_) shares.setConstant(shares.minCoeff());
  return shares;
}

}  // namespace maxwrench
