#include "solvers/solve/too_weak.h"

#include <fmt/format.h>

#include <cmath>

#include "lib/math/random.h"
#include "lib/robot/chain.h"
#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "maxwrench/wrench_solver.h"
#include "solvers/solve/format.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

constexpr int kSampled = 400;    // values of theta_r, at most
constexpr int kSolutions = 100;  // IK solutions that tell
constexpr double kFarTooWeak = 1.0 / 3;

/// How much of its load a posture bears.
class Bearing {
 public:
  explicit Bearing(const WrenchProgram& of) : solver_(find_wrench_solver("condensed").make()) {
    const Eigen::Index k = of.columns();
    program_ = of;
    program_.W_0.resize(6, 0);
    program_.W.resize(6, 1 + k);
    program_.W << Vector6d::Zero(), of.W;  // the load is no wrench of the end effector
    program_.c_w = Eigen::VectorXd::Unit(1 + k, 0);
    program_.w_min.resize(1 + k);
    program_.w_min << 0, of.w_min;
    program_.w_max.resize(1 + k);
    program_.w_max << kInfinity, of.w_max;
    program_.JtW.resize(of.JtW.rows(), 1 + k);
    program_.tau_d.setZero();
  }

  /// The largest s; infinite: any. NaN: no verdict.
  double of(const WrenchProgram& posture) {
    program_.JtW << posture.tau_d, posture.JtW;
    solver_->solve(program_, true, result_);
    if (result_.status == Status::kUnbounded) return kInfinity;
    return result_.status == Status::kOptimal ? result_.beta
                                              : std::numeric_limits<double>::quiet_NaN();
  }

  /// The actuator at a limit that costs most of the load of the last posture; -1: none is.
  int weakest() const {
    const Zonotope& set = *program_.actuation;
    if (result_.lambda.size() != set.B.rows() || result_.u.size() != set.B.cols()) return -1;
    const Eigen::VectorXd price = set.B.transpose() * result_.lambda;
    double most = 1e-9;
    int weakest = -1;
    for (Eigen::Index i = 0; i < price.size(); ++i) {
      const double share = std::abs(price[i] * result_.u[i]);
      if (share <= most) continue;
      most = share;
      weakest = static_cast<int>(i);
    }
    return weakest;
  }

 private:
  std::unique_ptr<WrenchSolver> solver_;
  WrenchProgram program_;
  Capability result_;
};

}  // namespace

TooWeak find_too_weak(const Problem& task, const Method& method) {
  TooWeak result;
  const bool known = !task.motion && !task.contact && task.scenarios.empty();
  if (!known || task.redundancy() == 0) return result;
  PostureEvaluator model(task);
  WrenchProgram program = make_wrench_program(task, method.choice.wrench);
  program.JtW.setZero(task.robot.velocities(), program.columns());
  program.tau_d.setZero(task.robot.velocities());
  Bearing bearing(program);
  Random random(method.choice.seed);
  Eigen::VectorXd theta_r = task.theta_r_default;
  Tally tally;
  double most = 0;
  int solutions = 0, weakest = -1;
  while (result.evaluations < kSampled && solutions < kSolutions) {
    const Posture& first = model.evaluate(theta_r);
    ++result.evaluations;
    tally.add(first.ik_solutions);
    const int count = first.status == Status::kValid ? model.ik_solutions() : 0;
    for (int i = 0; i < count; ++i) {
      if (!set_posture(model.select(i), program)) return result;
      const double share = bearing.of(program);
      if (!(share < kFarTooWeak)) return result;
      ++solutions;
      if (share < most) continue;
      most = share;
      weakest = bearing.weakest();
    }
    for (Eigen::Index i = 0; i < theta_r.size(); ++i) {
      theta_r[i] = random.uniform(task.theta_r_min[i], task.theta_r_max[i]);
    }
  }
  if (solutions < kSolutions) return result;
  result.ik_solutions = tally.sum();
  result.why = fmt::format(
      "in {} sampled postures the efforts bear at most {:.2g} % of the robot's own load{}",
      solutions, 100 * most,
      weakest < 0 ? "" : fmt::format("; too weak is {}", actuator_name(task.robot, weakest)));
  return result;
}

}  // namespace maxwrench
