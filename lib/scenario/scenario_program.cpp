#include "lib/scenario/scenario_program.h"

#include <algorithm>

#include "lib/math/rotated.h"
#include "lib/scenario/static_load.h"
#include "maxwrench/posture.h"

namespace maxwrench {

ScenarioPosture::ScenarioPosture(const Problem& problem)
    : problem_(problem), added_(Eigen::VectorXd::Zero(problem.robot.velocities())) {
  if (has_current(problem.scenarios)) water_.emplace(problem.robot);
}

void ScenarioPosture::set(const Posture& posture) {
  posture_ = &posture;
  in_water_ = false;
}

const Eigen::VectorXd& ScenarioPosture::tau_d() const { return posture_->tau_d; }

void ScenarioPosture::exert(const Vector6d& c, Eigen::VectorXd& tau) const {
  tau.noalias() = posture_->J.transpose().lazyProduct(c);
}

Vector6d ScenarioPosture::wrench(int i) const {
  const ScenarioList& list = problem_.scenarios;
  if (list.payload) {
    const EndEffector& tool =
        problem_.robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)];
    const Eigen::Matrix3d R = posture_->base.R *
                              posture_->links[static_cast<std::size_t>(tool.link)].R *
                              tool.placement.R;
    return payload_wrench(problem_.robot, *list.payload, R);
  }
  return rotated(posture_->turn, list.wrenches[static_cast<std::size_t>(i)].c);
}

Vector6d ScenarioPosture::ball_axis(Eigen::Index i) const {
  const WrenchBall& ball = *problem_.scenarios.ball;
  return ball.radius * rotated(posture_->turn, Vector6d(ball.E.col(i)));
}

void ScenarioPosture::add_load(const LoadCase& load, Eigen::VectorXd& tau) {
  add_static_loads(problem_.robot, *posture_, load.loads, 1, tau);
  if (load.current.isZero(0)) return;
  if (!in_water_) water_->set(posture_->base.R, posture_->q);
  in_water_ = true;
  water_->evaluate(load.current, added_);
  tau += added_;
}

ScenarioProgram::ScenarioProgram(const Problem& problem, Wrench wrench, int axes)
    : problem_(problem),
      first_(std::max(axes, 1)),
      axes_(axes > 0),
      F_(wrench == Wrench::kAny ? problem.scenarios.F : Matrix6Xd(6, 0)) {
  const Eigen::Index own = first_ + F_.cols(), l = problem.contact_columns(), k = own + l;
  const Eigen::Index n = problem.robot.velocities();
  program_.W.setZero(6, own);
  program_.C_2.setZero(6, l);
  program_.c_w = Eigen::VectorXd::Unit(k, 0);
  program_.w_min = Eigen::VectorXd::Constant(k, -kInfinity);
  program_.w_max = -program_.w_min;
  if (l > 0) {
    program_.w_min.tail(l) = problem.contact->w_min;
    program_.w_max.tail(l) = problem.contact->w_max;
  }
  program_.JtW.setZero(n, k);
  program_.tau_d.setZero(n);
}

const WrenchProgram& ScenarioProgram::write(ScenarioPosture& at, const ScenarioChoice& choice) {
  const ScenarioList& list = problem_.scenarios;
  const Posture& posture = at.posture();
  program_.actuation = &list.limits[static_cast<std::size_t>(choice.limits)].actuation;
  for (Eigen::Index i = 0; i < first_; ++i) {
    program_.W.col(i) = axes_ ? at.ball_axis(i) : choice.c;
  }
  for (Eigen::Index i = 0; i < F_.cols(); ++i) {
    program_.W.col(first_ + i) = rotated(posture.turn, Vector6d(F_.col(i)));
  }
  const Eigen::Index own = program_.W.cols(), l = program_.columns() - own;
  program_.JtW.leftCols(own).noalias() = posture.J.transpose().lazyProduct(program_.W);
  if (l > 0) {
    program_.C_2 = posture.C_2;
    program_.JtW.rightCols(l).noalias() = posture.J_2.transpose().lazyProduct(program_.C_2);
  }
  program_.tau_d = posture.tau_d;
  for (std::size_t group = 0; group < choice.cases.size(); ++group) {
    at.add_load(list.loads[group][static_cast<std::size_t>(choice.cases[group])], program_.tau_d);
  }
  if (axes_) cut(kInfinity);
  return aim(1);
}

const WrenchProgram& ScenarioProgram::aim_along(const Eigen::Vector2d& d) {
  program_.c_w.head(first_) = d.head(first_);
  return program_;
}

void ScenarioProgram::cut(double most) {
  program_.w_max.head(first_).setConstant(most);
  program_.w_min.head(first_).setConstant(-most);
}

const WrenchProgram& ScenarioProgram::aim(double sign, double most) {
  program_.c_w[0] = sign;
  program_.w_max[0] = most;
  return program_;
}

}  // namespace maxwrench
