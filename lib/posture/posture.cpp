#include "maxwrench/posture.h"

#include <cassert>
#include <cmath>
#include <optional>

#include "lib/posture/ik/dependent_joints.h"
#include "lib/posture/ik/primary_ik.h"
#include "lib/posture/ik/second_arm.h"
#include "lib/posture/posture_state.h"
#include "lib/posture/pull_back.h"
#include "lib/posture/scenario_slopes.h"
#include "lib/posture/seeds.h"
#include "maxwrench/capability.h"

namespace maxwrench {
namespace {

/// The violation of a posture and its description; null if there is none.
struct Fault {
  Violation violation = Violation::kNone;
  const char* reason = nullptr;
};

constexpr Fault kBeyondDependent{Violation::kDependentJoint, "joint limit of a dependent joint"};
constexpr Fault kBeyondSecondArm{Violation::kSecondArm, "joint limit of the second arm"};
constexpr Fault kSingularPosture{Violation::kNoSolution, kSingularReason};
constexpr Fault kSingularContacts{Violation::kNoSolution,
                                  "singular: the two contacts lack a direction of motion"};
constexpr Fault kUnreachablePose{Violation::kNoSolution, kUnreachableReason};
constexpr Fault kUnreachableContact{Violation::kNoSolution,
                                    "unreachable contact: the second arm does not reach it"};
constexpr Fault kBaseOffItsAxes{Violation::kBase,
                                "unreachable pose: the base would leave its free axes"};
constexpr Fault kSelfCollision{Violation::kCollision, "self-collision"};

/// A posture at one theta_r: the indices of the IK solutions for the dependent coordinates and for
/// the second arm.
struct IkSolution {
  int primary = -1, second = -1;
  bool operator==(const IkSolution&) const = default;
};

}  // namespace

struct PostureEvaluator::Workspace {
  Workspace(const Problem& p, bool check)
      : problem(p),
        check_collision(check && p.robot.collision != nullptr),
        model(p),
        reverse(p.robot, p.end_effector, p.contact ? p.contact->end_effector : -1) {
    if (!p.dependent.empty()) primary.emplace(p);
    if (p.contact) second.emplace(p);
    if (!p.scenarios.empty()) slopes.emplace(p);
  }

  Fault find_beyond(const Eigen::VectorXd& theta_r) const {
    for (Eigen::Index i = 0; i < theta_r.size(); ++i) {
      if (theta_r[i] < problem.theta_r_min[i] - kLimitTolerance ||
          theta_r[i] > problem.theta_r_max[i] + kLimitTolerance) {
        const Eigen::Index joints = static_cast<Eigen::Index>(problem.redundant.size());
        if (i < joints) return {Violation::kThetaR, "joint limit"};
        return {Violation::kThetaR, i < joints + problem.free.count()
                                        ? "free pose coordinate beyond its limits"
                                        : "regrasp coordinate beyond its limits"};
      }
    }
    return {};
  }

  bool collides() const {
    return check_collision && problem.robot.collision->collides(model.kinematics.links());
  }

  /// Moves the second arm to IK solution i.
  void place_second(int i) {
    second->place(i, model.q);
    model.finish_second();
    placed.second = i;
  }

  /// Moves the dependent coordinates to IK solution i.
  void place_primary(int i) {
    primary->place(i);
    model.evaluate_at(model.theta_r, primary->z());
    placed = {i, -1};
    if (second) second->reach(model.base);
  }

  void place(const IkSolution& ik_solution) {
    if (ik_solution.primary != placed.primary) place_primary(ik_solution.primary);
    if (ik_solution.second != placed.second) place_second(ik_solution.second);
  }

  /// Tries all IK solutions for the second arm at the current base pose.
  void try_second() {
    const int found = second->reach(model.base);
    if (found == 0) blame(kUnreachableContact);
    for (int i = 0; i < found; ++i) {
      placed.second = i;
      if (!second->within_limits(i)) {
        turn_down(model.ik_solutions.beyond_limit, kBeyondSecondArm);
        continue;
      }
      place_second(i);
      if (near_singular(problem.robot, *problem.contact, model.J, model.J_2)) {
        turn_down(model.ik_solutions.singular, kSingularContacts);
      } else {
        try_collision();
      }
    }
  }

  void try_collision() {
    if (collides()) return turn_down(model.ik_solutions.collision, kSelfCollision);
    ++model.ik_solutions.found;
    valid.push_back(placed);
  }

  /// Counts the current IK solution as invalid.
  void turn_down(long& count, const Fault& why) {
    ++model.ik_solutions.found;
    ++count;
    blame(why);
  }

  /// Keeps the gravest fault, which is the one reported for a theta_r without a valid posture.
  void blame(const Fault& why) {
    if (fault.reason && why.violation <= fault.violation) return;
    fault = why;
    shown = placed;
  }

  /// Tries all IK solutions for the dependent coordinates.
  void try_primary(const Eigen::VectorXd& theta_r) {
    const int found = primary->solve(theta_r);
    model.theta_r = theta_r;
    if (found == 0) {
      primary->place_guess();
      model.evaluate_at(theta_r, primary->z());
    }
    for (int i = 0; i < found; ++i) {
      placed = {i, -1};
      if (!primary->place(i)) {
        turn_down(model.ik_solutions.beyond_limit, kBeyondDependent);
        continue;
      }
      model.evaluate_at(theta_r, primary->z());
      if (primary->is_singular(model.J)) {
        turn_down(model.ik_solutions.singular, kSingularPosture);
      } else if (second) {
        try_second();
      } else {
        try_collision();
      }
    }
  }

  /// Fills `valid` and, if there is no valid posture, `fault`. The model ends at the first valid
  /// posture, or at the one with the reported fault.
  void find_ik_solutions(const Eigen::VectorXd& theta_r) {
    valid.clear();
    fault = {};
    shown = placed = {};
    model.ik_solutions = {};
    if (second) {
      model.q = problem.contact->q_rest;
      second->touch(theta_r);
    }
    if (primary) {
      try_primary(theta_r);
    } else {
      model.evaluate(theta_r);
      if (!base_reaches(problem.robot, model.base)) {
        fault = kBaseOffItsAxes;
      } else if (second) {
        try_second();
      } else {
        try_collision();
      }
    }
    IkCounts& counts = model.ik_solutions;
    counts.most = counts.found;
    counts.unreachable = counts.found == 0;
    counts.incomplete = primary && !primary->complete();
    if (!valid.empty()) {
      fault = {};
      return place(valid.front());
    }
    if (!fault.reason) fault = second ? kUnreachableContact : kUnreachablePose;
    if (primary && shown.primary >= 0) place_primary(shown.primary);
    if (shown.second >= 0) {
      place_second(shown.second);
    } else if (second) {
      model.finish_second();  // at rest
    }
  }

  /// Fills what only the result needs.
  void complete() {
    model.links = model.kinematics.links();
    if (problem.free.wrench_turns) model.turn = model.pose.R * problem.pose.R.transpose();
    if (!second) return;
    model.kinematics.gravity_and_buoyancy(model.base.R, model.tau_d);
    model.C_2 = second->C_2();
    model.contact = second->contact();
  }

  /// All of `PostureEvaluator::evaluate`.
  void run(const Eigen::VectorXd& theta_r) {
    find_ik_solutions(theta_r);
    if (const Fault beyond = find_beyond(theta_r); beyond.reason) {
      fault = beyond;
      valid.clear();
    }
    complete();
    model.violation = fault.violation;
    if (fault.reason) {
      model.conclude(Status::kInvalidPosture, fault.reason);
    } else {
      model.conclude(Status::kValid);
    }
  }

  /// Returns the workspace whose posture is at theta_r: this one, or a second one, so that the
  /// posture that `evaluate` returned stays.
  Workspace& at(const Eigen::VectorXd& theta_r) {
    if (model.theta_r == theta_r) return *this;
    if (!elsewhere) elsewhere = std::make_unique<Workspace>(problem, check_collision);
    if (elsewhere->model.theta_r != theta_r) elsewhere->run(theta_r);
    return *elsewhere;
  }

  /// `PostureEvaluator::pull_back` at the last theta_r.
  void pull_back(const Seeds& by, const Capability* decided, Eigen::VectorXd& gradient) {
    by.require(model.J.cols(), model.q.size());
    if (second) {
      require_columns("J_2", by.J_2.cols(), model.J.cols());
      require_columns("C_2", by.C_2.cols(), problem.contact_columns());
    }
    gradient.resize(model.theta_r.size());
    const Eigen::Vector3d& p_e = model.pose.p;
    const Matrix6Xd& seeds = second ? second->shifted_seeds(p_e, by.J, by.J_2) : by.J;
    if (decided) slopes->load(decided->decides, model);
    reverse.evaluate(model.kinematics, model.base.R, model.J, by.tau_d, seeds, q_gradient);
    Eigen::Vector3d by_turn = Eigen::Vector3d::Zero();
    if (decided) {
      slopes->unload(model);
      by_turn = slopes->add(model, *decided, q_gradient);
    }
    if (by.q.size() > 0) q_gradient += by.q;
    const std::vector<Joint>& joints = problem.robot.joints;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const std::optional<Gear>& gear = joints[i].gear;
      if (!gear) continue;
      q_gradient[gear->leader] += gear->ratio * q_gradient[static_cast<Eigen::Index>(i)];
    }
    if (second) {
      second->follow(p_e, model.J, model.J_2, by.J_2, by.C_2, q_gradient, gradient);
    }
    if (primary) {
      primary->follow(model.J, q_gradient, gradient);
    } else {
      for (std::size_t k = 0; k < problem.redundant.size(); ++k) {
        gradient[static_cast<Eigen::Index>(k)] = q_gradient[problem.redundant[k]];
      }
    }
    if (!problem.free.axes.empty()) follow_pose(by.J, by_turn, gradient);
  }

  /// The derivatives by the free coordinates of the pose; `by_turn`: what a turn of the robot
  /// changes beside tau_d and J. Each moves the robot by a twist of the
  /// end effector at resting joints; then the dependent coordinates change.
  void follow_pose(const Matrix6Xd& J_seed, const Eigen::Vector3d& by_turn,
                   Eigen::VectorXd& gradient) const {
    Vector6d by_twist = reverse.by_twist();
    by_twist.tail<3>() += by_turn;
    for (Eigen::Index i = 0; i < J_seed.cols(); ++i) {
      const Eigen::Vector3d a = J_seed.col(i).head<3>(), b = J_seed.col(i).tail<3>();
      const Eigen::Vector3d v = model.J.col(i).head<3>(), w = model.J.col(i).tail<3>();
      by_twist.head<3>() -= w.cross(a);  // J moves along with its point
      if (problem.free.wrench_turns) by_twist.tail<3>() += a.cross(v) + b.cross(w);
    }
    if (second) by_twist += second->by_twist(model.pose.p);
    if (primary) by_twist += primary->by_twist();
    const auto joints = static_cast<Eigen::Index>(problem.redundant.size());
    for (int i = 0; i < problem.free.count(); ++i) {
      gradient[joints + i] = by_twist.dot(free_twist(problem, model.theta_r, i));
    }
  }

  const Problem& problem;
  const bool check_collision;
  PostureState model;
  PullBack reverse;
  Eigen::VectorXd q_gradient;
  std::optional<PrimaryIk> primary;      ///< if joints are dependent
  std::optional<SecondArm> second;       ///< if there is a second contact
  std::optional<ScenarioSlopes> slopes;  ///< if there is a list of scenarios
  std::vector<IkSolution> valid;
  Fault fault;               ///< set if no posture is valid
  IkSolution shown, placed;  ///< where the fault is; where the model is
  const Matrix6Xd none;      ///< no seeds
  const Eigen::VectorXd none_by_q;
  std::unique_ptr<Workspace> elsewhere;  ///< made by the first `pull_back` at another theta_r
};

PostureEvaluator::PostureEvaluator(const Problem& problem, bool check_collision)
    : workspace_(std::make_unique<Workspace>(problem, check_collision)) {}
PostureEvaluator::~PostureEvaluator() = default;

const Posture& PostureEvaluator::evaluate(const Eigen::VectorXd& theta_r) {
  Workspace& ws = *workspace_;
  require_theta_r(ws.problem, theta_r);
  ws.run(theta_r);
  return ws.model;
}

int PostureEvaluator::ik_solutions() const { return static_cast<int>(workspace_->valid.size()); }

const Posture& PostureEvaluator::select(int ik_solution) {
  Workspace& ws = *workspace_;
  assert(ik_solution >= 0 && ik_solution < ik_solutions());
  const IkSolution& chosen = ws.valid[static_cast<std::size_t>(ik_solution)];
  if (chosen == ws.placed) return ws.model;
  ws.place(chosen);
  ws.complete();
  return ws.model;
}

void PostureEvaluator::pull_back(const Eigen::VectorXd& theta_r, const Eigen::VectorXd& tau_seed,
                                 const Matrix6Xd& J_seed, Eigen::VectorXd& gradient) {
  require_theta_r(workspace_->problem, theta_r);
  Workspace& ws = workspace_->at(theta_r);
  ws.pull_back({tau_seed, J_seed, ws.none_by_q, ws.none, ws.none}, nullptr, gradient);
}

void PostureEvaluator::pull_back(const Eigen::VectorXd& theta_r, const Capability& capability,
                                 Eigen::VectorXd& gradient) {
  require_theta_r(workspace_->problem, theta_r);
  Workspace& ws = workspace_->at(theta_r);
  ws.pull_back({capability.lambda, capability.beta_J, capability.beta_q, capability.beta_J2,
                capability.beta_C2},
               ws.slopes ? &capability : nullptr, gradient);
}

}  // namespace maxwrench
