#include "lib/posture/ik/damped_newton.h"

#include <algorithm>
#include <cmath>

#include "lib/math/decompositions.h"

namespace maxwrench {

DampedNewton::DampedNewton(const ToolChain& chain, const Pose<double>& pose)
    : chain_(chain), pose_(pose) {}

bool DampedNewton::run(const Eigen::VectorXd& theta_r, Six<double>& y) {
  constexpr int kMostNewtonSteps = 100;
  constexpr double kMostDamping = 1e6, kLongest = 0.5;
  double damping = 1e-2;
  linearise(theta_r, y);
  for (int step = 0; step < kMostNewtonSteps && error_.norm() > kArrived; ++step) {
    const double before = error_.norm();
    Vector6N dy = damped_step(chain_.J_d(state_), error_, damping);
    double longest = 0;  // of the angles; translations are linear
    for (Eigen::Index i = 0; i < dy.size(); ++i) {
      if (chain_.turns(static_cast<int>(i))) longest = std::max(longest, std::abs(dy[i]));
    }
    if (longest > kLongest) dy *= kLongest / longest;
    Six<double> trial = y;
    for (Eigen::Index i = 0; i < dy.size(); ++i) trial[static_cast<std::size_t>(i)] += dy[i];
    linearise(theta_r, trial);
    if (error_.norm() < before) {
      y = trial;
      damping /= 8;
      continue;
    }
    linearise(theta_r, y);
    damping *= 8;
    if (damping > kMostDamping) return false;
  }
  return error_.norm() <= kArrived;
}

void DampedNewton::linearise(const Eigen::VectorXd& theta_r, const Six<double>& y) {
  const double* const none = nullptr;
  chain_.evaluate(theta_r.data(), y.data(), none, none, state_);
  error_.head<3>() = pose_.p - state_.pose.p;
  error_.tail<3>() = logarithm(pose_.R * state_.pose.R.transpose());
}

}  // namespace maxwrench
