// Prints tasks as the engine reads them, random postures, and the native results there, as JSON.
// view/engine/check compares the engine with them.

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "solvers/solve/method.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/scenario_task.h"
#include "tests/support/support.h"
#include "view/engine/problem_data.h"
#include "view/scene/parts.h"
#include "view/scene/scene.h"

namespace maxwrench {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kPostures = 100;
/// The number of postures whose sets of wrenches and explanation are compared.
constexpr int kPosturesWithParts = 20;
/// The number of trajectories of a task in time.
constexpr int kTrajectories = 5;
/// The number of postures that each measure is evaluated at, beside linf_polytope.
constexpr int kPosturesOfOthers = 10;

Json list(const Eigen::MatrixXd& M) {
  Json numbers = Json::array();
  for (Eigen::Index i = 0; i < M.rows(); ++i) {
    for (Eigen::Index j = 0; j < M.cols(); ++j) numbers.push_back(M(i, j));
  }
  return numbers;
}

Json list(const Pose<double>& pose) {
  Eigen::Matrix<double, 3, 4> matrix;
  matrix << pose.R, pose.p;
  return list(matrix);
}

std::string hexadecimal(const std::string& bytes) {
  std::string text;
  for (const char byte : bytes) text += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return text;
}

/// A task with cylinders and boxes, which FCL tests and the engine cannot leave to it.
Problem with_cylinders() {
  Collision collision = vehicle_shapes();
  Shape wide = capsule(2);
  wide.body = "wide";
  wide.kind = Shape::Kind::kCylinder;
  wide.placement.p.y() = -0.03;
  wide.radius = 0.03;
  Shape box = wide;
  box.body = "box";
  box.kind = Shape::Kind::kBox;
  box.half_sizes = {0.02, 0.02, 0.05};
  box.placement.p.y() = 0.03;
  Shape post = capsule(0);
  post.body = "post";
  post.kind = Shape::Kind::kCylinder;
  post.placement.p = {0.35, 0.2, 0};
  collision.shapes.insert(collision.shapes.end(), {wide, box, post});
  collision.ignore = {{"hull", "link_1"},
                      {"link_1", "link_2"},
                      {"link_1", "wide"},
                      {"link_1", "box"},
                      {"post", "link_1"}};
  TaskSpec task = push(finalize(vehicle(), collision));
  task.name = "vehicle with cylinders";
  return make_problem(task);
}

/// A task whose last joint follows the one before it.
Problem with_a_gear() {
  Robot robot = vehicle();
  robot.joints[1].gear = Gear{0, 0.5, 0.1};
  TaskSpec task = push(finalize(robot, vehicle_shapes()));
  task.name = "vehicle with a gear";
  return make_problem(task);
}

/// A path in a current along x.
Problem turn_in_a_current() {
  Problem problem = load_problem("uvms/valve_trajectory");
  problem.name += " in a current";
  problem.robot.current = {0.3, 0, 0};  // [m/s]
  return problem;
}

Json case_at(const Problem& problem, const Eigen::VectorXd& theta_r, const Options& options,
             bool with_parts) {
  const Answer answer = evaluate(problem, theta_r, options);
  const Posture& posture = answer.posture;
  Json links = Json::array();
  for (const Pose<double>& link : posture.links) {
    for (const Json& number : list(posture.base * link)) links.push_back(number);
  }
  Json result = {{"measure", options.measure},
                 {"wrench", to_string(options.wrench)},
                 {"collision", options.check_collision},
                 {"theta_r", list(theta_r)},
                 {"status", to_string(answer.status)},
                 {"reason", answer.reason.str()},
                 {"solutions", posture.ik_solutions.valid()},
                 {"theta", list(posture.q)},
                 {"tau_d", list(posture.tau_d)},
                 {"links", links}};
  if (answer.status != Status::kOptimal) return result;
  const Capability& capability = answer.capability;
  result["beta"] = answer.beta();
  result["unit"] = answer.unit;
  result["gradient"] = list(answer.trajectory.gradient);
  result["lambda"] = list(capability.lambda);
  result["u"] = list(capability.u);
  result["h"] = capability.w.size() > 0 ? list(capability.h) : Json::array();
  result["end_effector"] = list(answer.trajectory.instants[0].end_effector);
  result["J"] = list(posture.J);
  result["J_2"] = list(posture.J_2);
  if (!with_parts) return result;
  result["sets"] = sets_json(answer, 0);
  result["explanation"] = explanation_json(answer);
  result["scenarios"] = scenarios_json(answer);
  return result;
}

std::vector<Options> choices_of(const Problem& problem) {
  std::vector<Options> choices;
  for (const MeasureEntry& measure : measures()) {
    for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
      Options options;
      options.measure = measure.name;
      options.wrench = wrench;
      try {
        resolve_lower_level(problem, options).make_measure();
      } catch (const std::invalid_argument&) {
        continue;
      }
      choices.push_back(options);
    }
  }
  return choices;
}

Json cases_of(const Problem& problem) {
  Json cases = Json::array();
  Random random(7);
  const std::vector<Options> choices = choices_of(problem);
  for (int i = 0; i < kPostures; ++i) {
    const Eigen::VectorXd theta_r = random_theta_r(problem, random);
    for (Options options : choices) {
      const bool polytope = options.measure == Case().measure;
      if (!polytope && i >= kPosturesOfOthers) continue;
      cases.push_back(case_at(problem, theta_r, options, false));
      options.check_collision = false;
      if (polytope) cases.push_back(case_at(problem, theta_r, options, i < kPosturesWithParts));
    }
  }
  return {{"name", problem.name},
          {"data", hexadecimal(problem_data(problem))},
          {"list", !problem.scenarios.empty()},
          {"B", list(problem.robot.actuation.B)},
          {"u_min", list(problem.robot.actuation.u_min)},
          {"u_max", list(problem.robot.actuation.u_max)},
          {"cases", cases}};
}

/// Trajectories near the default one.
Json trajectories_of(const Problem& problem) {
  Json cases = Json::array();
  Random random(9);
  const Eigen::VectorXd width = problem.theta_r_max - problem.theta_r_min;
  for (int i = 0; i < kTrajectories; ++i) {
    Eigen::MatrixXd knots = default_knots(problem);
    for (auto knot : knots.rowwise()) {
      for (Eigen::Index k = 0; k < knot.size(); ++k) {
        knot[k] += (i == 0 ? 0 : 0.02) * width[k] * (random.uniform() - 0.5);
      }
    }
    const Answer answer = evaluate(problem, knots);
    const std::size_t middle = answer.trajectory.instants.size() / 2;
    Json shown = shown_json({"own", answer}, 0);
    cases.push_back({{"shown", shown}, {"instant", middle}, {"sets", sets_json(answer, middle)}});
  }
  return {{"name", problem.name},
          {"data", hexadecimal(problem_data(problem))},
          {"trajectories", cases}};
}

}  // namespace
}  // namespace maxwrench

int main() {
  using namespace maxwrench;
  Json tasks = Json::array();
  for (const char* name :
       {"uvms/valve", "uvms/lift", "dual_arm/two_arms", "mobile/push", "fixed/push", "planar/force",
        "planar/two_arms", "mobile/push_any_height"}) {
    tasks.push_back(cases_of(load_problem(name)));
  }
  for (const char* name : {"turn_both_ways", "lift_with_a_dead_thruster", "turn_guaranteed"}) {
    const std::string folder = MAXWRENCH_SOURCE_DIR "/examples/tasks/";
    tasks.push_back(cases_of(load_problem(folder + name + ".toml")));
  }
  tasks.push_back(cases_of(second_contact_task(
      "bar_wall.toml", kTurn, "[uncertainty]\nmass.vehicle = 0.2\n[loss]\nany = 1\n")));
  for (const char* name : {"planar/trajectory", "uvms/valve_trajectory", "uvms/valve_impulse"}) {
    tasks.push_back(trajectories_of(load_problem(name)));
  }
  for (const char* name : {"carry_steel_along", "two_link/lift", "two_link/luus"}) {
    const std::string folder = MAXWRENCH_SOURCE_DIR "/examples/tasks/";
    tasks.push_back(trajectories_of(load_problem(folder + name + ".toml")));
  }
  tasks.push_back(trajectories_of(turn_in_a_current()));
  tasks.push_back(cases_of(with_a_gear()));
  tasks.push_back(cases_of(with_cylinders()));
  std::puts(tasks.dump().c_str());
}
