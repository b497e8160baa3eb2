#include "lib/measure/closed_form.h"

#include <stdexcept>

namespace maxwrench {

bool regular(const Eigen::LDLT<SmallMatrix>& factor) {
  const auto pivots = factor.vectorD();
  return pivots.minCoeff() > kPivotTolerance * pivots.maxCoeff();
}

void require_full_row_rank(const Robot& robot, const std::string& measure) {
  if (robot.actuation.full_row_rank()) return;
  throw std::invalid_argument("measure " + measure + ": B of " + robot.name + " has rank " +
                              std::to_string(robot.actuation.rank) + ", expected " +
                              std::to_string(robot.actuation.dimension()));
}

void require_both_directions(const Robot& robot, const std::string& measure) {
  const Zonotope& set = robot.actuation;
  if ((set.u_min.array() < 0).all() && (set.u_max.array() > 0).all()) return;
  throw std::invalid_argument("measure " + measure + ": an actuator of " + robot.name +
                              " cannot act in both directions, expected min < 0 < max");
}

Eigen::VectorXd smaller_limits(const Zonotope& actuation) {
  return actuation.u_min.cwiseAbs().cwiseMin(actuation.u_max.cwiseAbs());
}

Eigen::MatrixXd weighted_inverse(const Robot& robot, const std::string& measure) {
  require_full_row_rank(robot, measure);
  require_both_directions(robot, measure);
  return smaller_limits(robot.actuation).cwiseInverse().asDiagonal() * robot.actuation.B_pinv;
}

Status without_answer(Status how, const char* why, Capability& capability) {
  capability.lambda.setZero();
  return capability.conclude(how, why);
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
