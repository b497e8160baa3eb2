#include "lib/measure/closed_form.h"

#include <stdexcept>

namespace maxwrench {

bool regular(const Eigen::LDLT<SmallMatrix>& factor) {
  const auto pivots = factor.vectorD();
  return pivots.minCoeff() > kRankTolerance * pivots.maxCoeff();
}

void require_full_row_rank(const Robot& robot, const std::string& measure) {
  if (robot.actuation.full_row_rank()) return;
  throw std::invalid_argument("measure " + measure + ": B of " + robot.name + " has rank " +
                              std::to_string(robot.actuation.rank) + ", expected " +
                              std::to_string(robot.actuation.dimension()));
}

Eigen::MatrixXd weighted_inverse(const Robot& robot, const std::string& measure) {
  require_full_row_rank(robot, measure);
  const Zonotope& set = robot.actuation;
  if ((set.u_min.array() >= 0).any() || (set.u_max.array() <= 0).any()) {
    throw std::invalid_argument("measure " + measure + ": an actuator of " + robot.name +
                                " cannot act in both directions, expected min < 0 < max");
  }
  const Eigen::VectorXd limit = set.u_min.cwiseAbs().cwiseMin(set.u_max.cwiseAbs());
  return limit.cwiseInverse().asDiagonal() * set.B_pinv;
}

void fill_score(double beta, Eigen::Index velocities, Capability& capability) {
  capability.status = Status::kOptimal;
  capability.reason = "";
  capability.iterations = 0;
  capability.beta = beta;
  capability.w.resize(0);
  capability.h.setZero();
  capability.u.resize(0);
  capability.lambda.setZero(velocities);
}

}  // namespace maxwrench
