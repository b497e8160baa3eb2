#include "lib/posture/scenario_slopes.h"

#include "lib/scenario/static_load.h"

namespace maxwrench {
namespace {

/// Calls `visit` with each case of a scenario.
template <class Visit>
void for_each_case(const ScenarioList& list, const ScenarioChoice& choice, const Visit& visit) {
  for (std::size_t group = 0; group < choice.cases.size(); ++group) {
    visit(list.loads[group][static_cast<std::size_t>(choice.cases[group])]);
  }
}

}  // namespace

ScenarioSlopes::ScenarioSlopes(const Problem& problem)
    : problem_(problem), tau_(Eigen::VectorXd::Zero(problem.robot.velocities())) {
  if (has_current(problem.scenarios)) water_.emplace(problem.robot);
}

void ScenarioSlopes::load(const ScenarioChoice& choice, PostureState& state) {
  changes_.clear();
  for_each_case(problem_.scenarios, choice, [&](const LoadCase& load) {
    changes_.insert(changes_.end(), load.loads.begin(), load.loads.end());
  });
  if (changes_.empty()) return;
  state.kinematics.set_loads(changes_);
  state.kinematics.gravity_and_buoyancy(state.base.R, tau_);
}

void ScenarioSlopes::unload(PostureState& state) {
  if (changes_.empty()) return;
  state.kinematics.set_loads({});
  state.kinematics.gravity_and_buoyancy(state.base.R, tau_);
}

Eigen::Vector3d ScenarioSlopes::add(const PostureState& state, const Capability& capability,
                                    Eigen::VectorXd& q_gradient) {
  const ScenarioList& list = problem_.scenarios;
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  for_each_case(list, capability.decides, [&](const LoadCase& load) {
    if (load.current.isZero(0)) return;
    water_->set(state.base.R, state.q);
    turn += water_->add_slopes(load.current, capability.lambda, q_gradient);
  });
  // While the end effector rests, the base turns against each joint between them.
  const Eigen::Index axes = state.J.cols() - q_gradient.size();
  for (Eigen::Index k = 0; k < q_gradient.size(); ++k) {
    q_gradient[k] -= state.J.col(axes + k).tail<3>().dot(turn);
  }
  if (list.payload) {
    const Vector6d twist = state.J.lazyProduct(capability.lambda);
    turn += capability.beta *
            payload_slope(problem_.robot, *list.payload, state.pose.R, twist.tail<3>());
  }
  return turn;
}

}  // namespace maxwrench
