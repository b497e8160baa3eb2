#include "lib/posture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "lib/branch.h"
#include "lib/kinematics.h"
#include "lib/posture/pull_back.h"

namespace maxwrench {
namespace {

/// Distance [m] and rotation [-] below which the base counts as lying on its free axes.
constexpr double kReachTolerance = 1e-9;
/// A posture on its limit is inside: theta_r may carry rounding from a search's box.
constexpr double kLimitTolerance = 1e-12;

/// The state of one posture.
struct Model {
  explicit Model(const Problem& p)
      : problem(p),
        kinematics(p.robot),
        theta_r(Eigen::VectorXd::Constant(p.redundancy(), kNothing)),
        q(p.robot.joints.size()),
        J(6, p.robot.velocities()),
        tau_d(p.robot.velocities()) {
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      q[i] = std::clamp(0.0, p.robot.joints[i].q_min, p.robot.joints[i].q_max);
    }
  }

  const EndEffector& end_effector() const {
    return problem.robot.end_effectors[problem.end_effector];
  }

  /// The base follows in closed form from all joints of the chain.
  void evaluate(const Eigen::VectorXd& at) {
    theta_r = at;
    for (std::size_t i = 0; i < problem.redundant.size(); ++i) q[problem.redundant[i]] = at[i];
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
  }

  /// Before the first evaluation: equals no theta_r.
  static constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

  const Problem& problem;
  Kinematics<double> kinematics;
  Eigen::VectorXd theta_r, q;
  Pose<double> base;
  Matrix6Xd J;
  Eigen::VectorXd tau_d;
};

/// Whether the pose is reached by moving along the free base axes from the mount.
bool base_reaches(const Robot& robot, const Pose<double>& in_world) {
  const Pose<double> base = robot.mount.inverse() * in_world;
  const auto is_free = [&](int axis) {
    return std::find(robot.base_axes.begin(), robot.base_axes.end(), axis) != robot.base_axes.end();
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_free(axis) && std::abs(base.p[axis]) > kReachTolerance) return false;
  }
  if (is_free(3)) return true;
  if (std::abs(base.R(2, 2) - 1) > kReachTolerance) return false;
  return is_free(5) || std::abs(base.R(0, 0) - 1) <= kReachTolerance;
}

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

struct PostureModel::Workspace {
  Workspace(const Problem& p, bool check)
      : problem(p),
        check_collision(check && p.robot.collision != nullptr),
        model(p),
        reverse(p.robot, p.end_effector) {
    if (!p.dependent.empty()) branch.emplace(p);
    posture.q.resize(model.q.size());
    posture.links = model.kinematics.links();
    posture.J = model.J;
    posture.tau_d = model.tau_d;
  }

  void evaluate(const Eigen::VectorXd& theta_r) {
    if (!branch) return model.evaluate(theta_r);
    branch_reason = branch->follow(theta_r);
    model.evaluate_at(theta_r, branch->z());
  }

  /// Why the posture does not exist, or null.
  const char* violation(const Eigen::VectorXd& theta_r) const {
    for (Eigen::Index i = 0; i < theta_r.size(); ++i) {
      if (theta_r[i] < problem.theta_r_min[i] - kLimitTolerance ||
          theta_r[i] > problem.theta_r_max[i] + kLimitTolerance) {
        return "joint limit";
      }
    }
    if (branch_reason) return branch_reason;
    for (const int i : problem.dependent) {
      const Joint& joint = problem.robot.joints[i];
      if (model.q[i] < joint.q_min - kLimitTolerance || model.q[i] > joint.q_max + kLimitTolerance)
        return "joint limit of a dependent joint";
    }
    if (!branch && !base_reaches(problem.robot, model.base))
      return "unreachable pose: the base would leave its free axes";
    if (check_collision && problem.robot.collision->collides(posture.links))
      return "self-collision";
    return nullptr;
  }

  const Problem& problem;
  const bool check_collision;
  Model model;
  PullBack reverse;
  Eigen::VectorXd q_gradient;
  std::optional<Branch> branch;  ///< if there are dependent joints
  const char* branch_reason = nullptr;
  Posture posture;
};

PostureModel::PostureModel(const Problem& problem, bool check_collision)
    : workspace_(std::make_unique<Workspace>(problem, check_collision)) {}
PostureModel::~PostureModel() = default;

const Posture& PostureModel::evaluate(const Eigen::VectorXd& theta_r) {
  Workspace& ws = *workspace_;
  require_theta_r(ws.problem, theta_r);
  ws.evaluate(theta_r);
  Posture& posture = ws.posture;
  posture.theta_r = theta_r;
  posture.base = ws.model.base;
  posture.q = ws.model.q;
  posture.links = ws.model.kinematics.links();
  posture.J = ws.model.J;
  posture.tau_d = ws.model.tau_d;
  const char* violation = ws.violation(theta_r);
  posture.status = violation ? Status::kInvalidPosture : Status::kOptimal;
  posture.reason = violation ? violation : "";
  return posture;
}

void PostureModel::pull_back(const Eigen::VectorXd& theta_r, const Eigen::VectorXd& tau_seed,
                             const Matrix6Xd& J_seed, Eigen::VectorXd& gradient) {
  Workspace& ws = *workspace_;
  require_theta_r(ws.problem, theta_r);
  Model& model = ws.model;
  if (model.theta_r != theta_r) ws.evaluate(theta_r);
  ws.reverse.evaluate(model.kinematics, model.base.R, model.J, tau_seed, J_seed, ws.q_gradient);
  gradient.resize(theta_r.size());
  for (Eigen::Index k = 0; k < theta_r.size(); ++k) {
    // The base follows from all joints in closed form here too: what Newton solves holds along the
    // branch.
    gradient[k] = ws.branch ? ws.branch->slopes().col(k).tail(model.q.size()).dot(ws.q_gradient)
                            : ws.q_gradient[ws.problem.redundant[static_cast<std::size_t>(k)]];
  }
}

}  // namespace maxwrench
