#include "solvers/certify/bound/thrust_points.h"

namespace maxwrench {

ThrustPoints::ThrustPoints(const LoopModel& model, const Zonotope& set, Eigen::Index thrusters)
    : n_(model.n),
      repeat_(model.size / model.levers->size()),
      B_(set.B.leftCols(thrusters)),
      u_min_(set.u_min.head(thrusters)),
      u_max_(set.u_max.head(thrusters)),
      corners_(*model.levers),
      patterns_(static_cast<std::size_t>(model.levers->size())),
      u_(thrusters) {
  const LoopCoordinates& x = model.coordinates;
  const Eigen::VectorXd levers = model.levers->magnitudes(x.lower, x.upper);
  const Eigen::VectorXd most = u_min_.cwiseAbs().cwiseMax(u_max_.cwiseAbs());
  const Eigen::VectorXd force = B_.topRows<3>().cwiseAbs() * most;
  sizes_ = levers.reshaped(n_, 3) * force + B_.cwiseAbs() * most;
}

void ThrustPoints::weigh(const Eigen::VectorXd& lambda, Eigen::VectorXd& g) {
  own_.noalias() = B_.transpose() * lambda;
  for (std::size_t p = 0; p < patterns_.size(); ++p) {
    const auto at = static_cast<Eigen::Index>(p);
    weights_.noalias() = points_->col(at).reshaped(n_, 3).transpose() * lambda;
    slopes_ = own_;
    slopes_.noalias() -= B_.topRows<3>().transpose() * weights_;  // of -lambda'K u
    double most = 0;
    int pattern = 0;
    for (Eigen::Index k = 0; k < slopes_.size(); ++k) {
      const bool high = slopes_[k] > 0;
      most += slopes_[k] * (high ? u_max_[k] : u_min_[k]);
      pattern |= (high ? 1 : 0) << k;
    }
    patterns_[p] = pattern;
    g.segment(at * repeat_, repeat_).array() -= most;
  }
}

void ThrustPoints::add(Eigen::Index v, int pattern, Eigen::VectorXd& load) {
  for (Eigen::Index k = 0; k < u_.size(); ++k) u_[k] = pattern >> k & 1 ? u_max_[k] : u_min_[k];
  const Eigen::Vector3d force = B_.topRows<3>() * u_;
  load.noalias() += points_->col(v / repeat_).reshaped(n_, 3) * force;
  load.noalias() -= B_ * u_;
}

}  // namespace maxwrench
