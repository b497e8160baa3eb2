#include "solvers/solve/near_singular.h"

#include <memory>

#include "lib/robot/chain.h"
#include "lib/robot/gears.h"
#include "lib/robot/kinematics.h"
#include "maxwrench/measure.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

constexpr double kOff = 0.01;  // rad, as joints of arms are calibrated without care
constexpr double kMuch = 0.5;  // of the value

/// The values of postures near that of an answer.
class Nearby {
 public:
  explicit Nearby(const Answer& answer)
      : problem_(*answer.task),
        at_(answer.posture),
        posture_(answer.posture),
        program_(make_wrench_program(problem_, answer.choice.wrench)),
        measure_(resolve_lower_level(problem_, answer.choice).make_measure()),
        kinematics_(problem_.robot) {
    kinematics_.set_joints(at_.q);
    kinematics_.gravity_and_buoyancy(at_.base.R, load_);
  }

  /// The value with joint i off; nothing if the posture has none.
  std::optional<double> value(int i, double by) {
    posture_.q = at_.q;
    posture_.q[i] += by;
    apply_gears(problem_.robot, posture_.q);
    kinematics_.set_joints(posture_.q);
    const auto tip = static_cast<std::size_t>(problem_.end_effector);
    kinematics_.jacobian(problem_.robot.end_effectors[tip], at_.base.R, posture_.J);
    kinematics_.gravity_and_buoyancy(at_.base.R, posture_.tau_d);
    posture_.tau_d += at_.tau_d - load_;  // and what water adds
    set_posture(posture_, program_);
    measure_->evaluate(posture_, program_, false, capability_);
    if (capability_.status != Status::kOptimal) return std::nullopt;
    return capability_.beta;
  }

 private:
  const Problem& problem_;
  const Posture& at_;
  Posture posture_;
  WrenchProgram program_;
  std::unique_ptr<Measure> measure_;
  Kinematics<double> kinematics_;
  Eigen::VectorXd load_;
  Capability capability_;
};

bool has_wrench_of_one_tool(const Answer& answer) {
  const Problem& problem = *answer.task;
  return !problem.motion && !problem.contact && problem.scenarios.empty() && answer.has_value() &&
         answer.has_posture() && answer.beta() > 0 && answer.unit == problem.unit();
}

}  // namespace

std::optional<JointOff> find_joint_off(const Answer& answer) {
  if (!has_wrench_of_one_tool(answer)) return std::nullopt;
  const Robot& robot = answer.task->robot;
  Nearby nearby(answer);
  JointOff least{"", 0, kMuch * answer.beta()};
  for (const int i : chain_to(robot, answer.task->end_effector)) {
    const Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    if (joint.type != JointType::kRevolute || joint.gear) continue;
    for (const double by : {-kOff, kOff}) {
      const std::optional<double> beta = nearby.value(i, by);
      if (beta && *beta < least.beta) least = {joint.name, by, *beta};
    }
  }
  if (least.joint.empty()) return std::nullopt;
  return least;
}

}  // namespace maxwrench
