#include "maxwrench/posture.h"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "lib/posture/dependent_joints.h"
#include "lib/posture/pull_back.h"
#include "lib/posture/second_arm.h"
#include "lib/robot/chain.h"
#include "lib/robot/kinematics.h"
#include "maxwrench/capability.h"

namespace maxwrench {
/// The state of one posture.
struct PostureState {
  explicit PostureState(const Problem& p)
      : problem(p),
        kinematics(p.robot),
        theta_r(Eigen::VectorXd::Constant(p.redundancy(), kNothing)),
        q(p.robot.joints.size()),
        J(6, p.robot.velocities()),
        J_2(6, p.contact ? p.robot.velocities() : 0),
        tau_d(p.robot.velocities()) {
    if (p.contact) {
      q = p.contact->q_rest;
      return;
    }
    q = resting_joints(p.robot);
  }

  const EndEffector& end_effector() const {
    return problem.robot.end_effectors[problem.end_effector];
  }

  /// The base follows in closed form from all joints of the chain.
  void evaluate(const Eigen::VectorXd& at) {
    theta_r = at;
    for (std::size_t i = 0; i < problem.redundant.size(); ++i) {
      q[problem.redundant[i]] = at[static_cast<Eigen::Index>(i)];
    }
    kinematics.set_joints(q);
    base = problem.pose * kinematics.end_effector(end_effector()).inverse();
    finish();
  }

  /// z = [x, y, z, yaw of the base; all joints].
  void evaluate_at(const Eigen::VectorXd& at, const Eigen::VectorXd& z) {
    theta_r = at;
    q = z.tail(q.size());
    kinematics.set_joints(q);
    base = base_pose(problem.robot, z.head<4>());
    finish();
  }

  void finish() {
    kinematics.jacobian(end_effector(), base.R, J);
    kinematics.gravity_and_buoyancy(base.R, tau_d);
    if (!problem.contact) return;
    const auto second = static_cast<std::size_t>(problem.contact->end_effector);
    kinematics.jacobian(problem.robot.end_effectors[second], base.R, J_2);
  }

  /// Before the first evaluation: equals no theta_r.
  static constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

  const Problem& problem;
  Kinematics<double> kinematics;
  Eigen::VectorXd theta_r, q;
  Pose<double> base;
  Matrix6Xd J, J_2;
  Eigen::VectorXd tau_d;
};

namespace {

/// What is wrong with a posture, and how that is said; null: nothing.
struct Fault {
  Violation violation = Violation::kNone;
  const char* reason = nullptr;
};

void require_theta_r(const Problem& problem, const Eigen::VectorXd& theta_r) {
  if (theta_r.size() != problem.redundancy()) {
    throw std::invalid_argument("theta_r: got " + std::to_string(theta_r.size()) +
                                " numbers, expected " + std::to_string(problem.redundancy()) +
                                " for " + problem.name);
  }
  if (!theta_r.allFinite()) {
    throw std::invalid_argument("theta_r: got a value that is not a finite number");
  }
}

}  // namespace

struct PostureEvaluator::Workspace {
  Workspace(const Problem& p, bool check)
      : problem(p),
        check_collision(check && p.robot.collision != nullptr),
        model(p),
        reverse(p.robot, p.end_effector, p.contact ? p.contact->end_effector : -1) {
    if (!p.dependent.empty()) branch.emplace(p);
    if (p.contact) second.emplace(p);
    posture.q.resize(model.q.size());
    posture.links = model.kinematics.links();
    posture.J = model.J;
    posture.tau_d = model.tau_d;
  }

  void evaluate(const Eigen::VectorXd& theta_r) {
    if (second) {
      model.q = problem.contact->q_rest;
      placed = -1;
    }
    if (!branch) return model.evaluate(theta_r);
    joints_of_theta_r = theta_r.head(static_cast<Eigen::Index>(problem.redundant.size()));
    branch_reason = branch->follow(joints_of_theta_r);
    model.evaluate_at(theta_r, branch->z());
  }

  /// Why the posture does not exist.
  Fault find_fault(const Eigen::VectorXd& theta_r) const {
    for (Eigen::Index i = 0; i < theta_r.size(); ++i) {
      if (theta_r[i] < problem.theta_r_min[i] - kLimitTolerance ||
          theta_r[i] > problem.theta_r_max[i] + kLimitTolerance) {
        return {Violation::kThetaR, i < static_cast<Eigen::Index>(problem.redundant.size())
                                        ? "joint limit"
                                        : "regrasp coordinate beyond its limits"};
      }
    }
    if (branch_reason) return {Violation::kNoSolution, branch_reason};
    for (const int i : problem.dependent) {
      const Joint& joint = problem.robot.joints[i];
      if (model.q[i] < joint.q_min - kLimitTolerance || model.q[i] > joint.q_max + kLimitTolerance)
        return {Violation::kDependentJoint, "joint limit of a dependent joint"};
    }
    if (!branch && !base_reaches(problem.robot, model.base))
      return {Violation::kBase, "unreachable pose: the base would leave its free axes"};
    if (second || !collides()) return {};  // a second arm moves yet
    return {Violation::kCollision, "self-collision"};
  }

  bool collides() const {
    return check_collision && problem.robot.collision->collides(model.kinematics.links());
  }

  /// Moves the second arm to a branch; whether that is within its limits.
  bool place(int i) {
    const bool inside = second->place(i, model.q);
    model.kinematics.set_joints(model.q);
    model.finish();
    placed = i;
    return inside;
  }

  /// Finds the valid branches of the second arm and moves it to the first, or says why there is
  /// none.
  Fault reach() {
    BranchCounts& counts = posture.branches;
    counts = {};
    valid_count = 0;
    const int found = second->reach(model.base);
    counts.found = found;
    counts.unreachable = found == 0;
    for (int i = 0; i < found; ++i) {
      if (!place(i)) {
        ++counts.beyond_limit;
      } else if (smallest_gain(problem.robot, *problem.contact, model.J, model.J_2) <
                 problem.contact->sigma_min) {
        ++counts.singular;
      } else if (collides()) {
        ++counts.collision;
      } else {
        valid[static_cast<std::size_t>(valid_count++)] = i;
      }
    }
    if (valid_count > 0) {
      if (placed != valid[0]) place(valid[0]);
      return {};
    }
    if (counts.collision > 0) return {Violation::kCollision, "self-collision"};
    if (counts.singular > 0) {
      return {Violation::kNoSolution, "singular: the two contacts lack a direction of motion"};
    }
    if (found > 0) return {Violation::kSecondArm, "joint limit of the second arm"};
    return {Violation::kNoSolution, "unreachable contact: the second arm does not get there"};
  }

  void read_model(const Eigen::VectorXd& theta_r) {
    posture.theta_r = theta_r;
    posture.base = model.base;
    posture.q = model.q;
    posture.links = model.kinematics.links();
    posture.J = model.J;
    posture.tau_d = model.tau_d;
    if (!second) return;
    posture.J_2 = model.J_2;
    posture.C_2 = second->C_2();
    posture.contact = second->contact();
  }

  /// All of `PostureEvaluator::evaluate`.
  void run(const Eigen::VectorXd& theta_r) {
    evaluate(theta_r);
    Fault fault = find_fault(theta_r);
    valid_count = fault.reason ? 0 : 1;
    if (second) {
      posture.branches = {};
      second->touch(theta_r);
      if (!fault.reason) fault = reach();
    }
    read_model(theta_r);
    posture.violation = fault.violation;
    if (fault.reason) {
      posture.conclude(Status::kInvalidPosture, fault.reason);
    } else {
      posture.conclude(Status::kValid);
    }
  }

  void pull_back(const Eigen::VectorXd& theta_r, const Eigen::VectorXd& tau_seed,
                 const Matrix6Xd& J_seed, const Matrix6Xd& J2_seed, const Matrix6Xd& C2_seed,
                 Eigen::VectorXd& gradient) {
    if (model.theta_r != theta_r) {
      if (second) {
        run(theta_r);  // chooses a branch
      } else {
        evaluate(theta_r);
      }
    }
    gradient.resize(theta_r.size());
    const Matrix6Xd& seeds =
        second ? second->shifted_seeds(problem.pose.p, J_seed, J2_seed) : J_seed;
    reverse.evaluate(model.kinematics, model.base.R, model.J, tau_seed, seeds, q_gradient);
    if (second) {
      second->follow(problem.pose.p, model.J, model.J_2, J2_seed, C2_seed, q_gradient, gradient);
    }
    for (std::size_t k = 0; k < problem.redundant.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      // The base follows from all joints in closed form here too: what Newton solves holds along
      // the branch.
      gradient[i] = branch ? branch->slopes().col(i).tail(model.q.size()).dot(q_gradient)
                           : q_gradient[problem.redundant[k]];
    }
  }

  const Problem& problem;
  const bool check_collision;
  PostureState model;
  PullBack reverse;
  Eigen::VectorXd q_gradient;
  std::optional<DependentJoints> branch;  ///< if there are dependent joints
  const char* branch_reason = nullptr;
  Eigen::VectorXd joints_of_theta_r;
  std::optional<SecondArm> second;  ///< if there is a second contact
  std::array<int, ContactArm::kMostSolutions> valid{};
  int valid_count = 0, placed = -1;
  const Matrix6Xd none;  ///< no seeds
  Posture posture;
};

PostureEvaluator::PostureEvaluator(const Problem& problem, bool check_collision)
    : workspace_(std::make_unique<Workspace>(problem, check_collision)) {}
PostureEvaluator::~PostureEvaluator() = default;

const Posture& PostureEvaluator::evaluate(const Eigen::VectorXd& theta_r) {
  Workspace& ws = *workspace_;
  require_theta_r(ws.problem, theta_r);
  ws.run(theta_r);
  return ws.posture;
}

int PostureEvaluator::branches() const { return workspace_->valid_count; }

const Posture& PostureEvaluator::select(int branch) {
  Workspace& ws = *workspace_;
  assert(branch >= 0 && branch < ws.valid_count);
  const int i = ws.valid[static_cast<std::size_t>(branch)];
  if (!ws.second || ws.placed == i) return ws.posture;
  ws.place(i);
  ws.read_model(ws.model.theta_r);
  return ws.posture;
}

void PostureEvaluator::pull_back(const Eigen::VectorXd& theta_r, const Eigen::VectorXd& tau_seed,
                                 const Matrix6Xd& J_seed, Eigen::VectorXd& gradient) {
  require_theta_r(workspace_->problem, theta_r);
  const Matrix6Xd& none = workspace_->none;
  workspace_->pull_back(theta_r, tau_seed, J_seed, none, none, gradient);
}

void PostureEvaluator::pull_back(const Eigen::VectorXd& theta_r, const Capability& capability,
                                 Eigen::VectorXd& gradient) {
  require_theta_r(workspace_->problem, theta_r);
  workspace_->pull_back(theta_r, capability.lambda, capability.beta_J, capability.beta_J2,
                        capability.beta_C2, gradient);
}

}  // namespace maxwrench
