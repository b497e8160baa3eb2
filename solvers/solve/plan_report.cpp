#include <fmt/format.h>

#include "solvers/solve/plan_row.h"
#include "cli/cli.h"
#include "cli/motion_options.h"
#include "cli/output.h"
#include "solvers/solve/pieces.h"
#include "solvers/solve/plan_limits.h"
#include "maxwrench/version.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

constexpr int kMostLines = 21;  ///< of the table of instants

/// Instants from knot to knot.
int instants_per_interval(const MotionTask& task) {
  return task.scheme == Scheme::kSpline ? task.instants_per_interval : 1;
}

bool is_turn_in_place(const Path& path) {
  const Eigen::Vector3d p = path.pose(0).p;
  for (const double s : {0.3, 0.5, 1.0}) {
    if ((path.pose(s * path.duration()).p - p).norm() > 1e-12) return false;
  }
  return path.angle() != 0;
}

ordered_json path_json(const Path& path) {
  return {{"start", to_json(path.pose(0))},
          {"end", to_json(path.pose(path.duration()))},
          {"angle", path.angle()}};
}

ordered_json task_json(const Problem& problem, const PlanRow& row) {
  const MotionTask& task = *problem.motion;
  const int t_h = task.t_h > 0 ? task.t_h : row.plan.t_h;
  ordered_json object;
  object["kind"] = problem.type();
  object["scheme"] = to_string(task.scheme);
  object["k"] = task.k;
  object["T"] = task.T;
  object["c"] = array(problem.c);
  object["rates"] = task.rates;
  object["wrench"] = to_string(row.choice.wrench);
  object["t_h"] = known(task.impulse && t_h > 0, t_h);
  object["u0"] = known(task.impulse, to_string(task.start));
  object["theta0"] = known(task.impulse, array(task.theta_0));
  object["collision"] = row.collision;
  if (is_turn_in_place(task.path)) {
    object["angle"] = task.path.angle();
  } else {
    object["path"] = path_json(task.path);
  }
  object["sub"] = instants_per_interval(task);
  return object;
}

/// In the order of u; `rate` is null where it has no limit.
ordered_json actuators_json(const Robot& robot) {
  ordered_json list = ordered_json::array();
  for (Eigen::Index i = 0; i < robot.actuators(); ++i) {
    const double rate = robot.u_rate_max[i];
    list.push_back({{"name", actuator_name(robot, i)},
                    {"min", robot.actuation.u_min[i]},
                    {"max", robot.actuation.u_max[i]},
                    {"rate", known(rate < kInfinity, rate)}});
  }
  return list;
}

ordered_json instant_json(const Robot& robot, const Instant& instant, bool solved) {
  ordered_json object;
  object["t"] = instant.t;
  object["theta"] = theta(robot, instant.base, instant.q);
  object["velocity"] = array(instant.v);
  object["acceleration"] = array(instant.v_dot);
  object["tau_d"] = array(instant.tau_d);
  object["c"] = array(instant.c);
  object["h"] = known(solved, array(instant.h));
  object["u"] = known(solved, array(instant.u));
  object["beta"] = known(solved, instant.beta());
  return object;
}

ordered_json clearance_json(const std::optional<Clearance>& clearance) {
  if (!clearance) return nullptr;
  return {{"least", clearance->least}, {"t", clearance->t}, {"pair", clearance->pair}};
}

ordered_json plan_json(const Problem& problem, const PlanRow& row) {
  const Case& c = row.choice;
  const Plan& plan = row.plan;
  const bool solved = row.has_value();
  ordered_json object;
  object["problem"] = c.problem;
  object["measure"] = c.measure;
  object["wrench"] = to_string(c.wrench);
  object["lp"] = c.lp;
  object["search"] = known(!c.search.empty(), c.search);
  object["seed"] = known(!c.search.empty(), c.seed);
  object["status"] = to_string(row.status);
  object["reason"] = known(!row.reason.empty(), row.reason.str());
  object["beta"] = known(solved, plan.value);
  object["unit"] = row.unit;
  object["theta_r"] = known(row.has_plan(), rows(plan.knots));
  for (const char* key : {"theta", "w", "h", "u", "lambda"}) object[key] = nullptr;
  object["gradient"] = known(solved, rows(plan.gradient));
  object["residual"] = known(solved, to_json(plan.solution.residual));
  object["evaluations"] = row.evaluations;
  object["calls"] = known(!c.search.empty(), to_json(row.calls));
  object["wall_s"] = row.wall_s;
  object["version"] = version();
  object["task"] = task_json(problem, row);
  object["value"] = known(solved, plan.value);
  object["continuous"] = plan.continuous;
  object["continuous_reason"] =
      known(!plan.continuous_reason.empty(), plan.continuous_reason.str());
  object["collision"] = known(!plan.collision.empty(), plan.collision.str());
  object["clearance"] = clearance_json(row.clearance);
  object["actuators"] = actuators_json(problem.robot);
  object["instants"] = ordered_json::array();
  for (const Instant& instant : plan.instants) {
    object["instants"].push_back(instant_json(problem.robot, instant, solved));
  }
  return object;
}

/// Some of the instants at knots.
void print_instants(const Problem& problem, const PlanRow& row) {
  const auto& instants = row.plan.instants;
  const auto count = static_cast<int>(instants.size());
  const int per_knot = instants_per_interval(*problem.motion);
  const int step = per_knot * ((count - 1) / per_knot / kMostLines + 1);
  fmt::print("    t [s]  {:>9}  {:<{}}  nearest limit of an effort\n", "beta", " theta_r",
             10 * problem.redundancy());
  for (int i = 0; i < count; i += step) {
    const Instant& instant = instants[static_cast<std::size_t>(i)];
    const std::string beta = row.has_value() ? fmt::format("{:.5f}", instant.beta()) : "-";
    fmt::print("{:>9.4f}  {:>9}  {}  {}\n", instant.t, beta, line(instant.q(problem.redundant)),
               row.has_value() ? nearest_limit(problem.robot, instant.u) : "");
  }
}

void print_value(const PlanRow& row) {
  const Plan& plan = row.plan;
  fmt::print("value    {:>10.5f} {}\n", plan.value, row.unit);
  if (plan.continuous_reason.empty()) {
    fmt::print("continuous {:>8.5f} {}\n", plan.continuous, row.unit);
  } else {
    fmt::print("continuous none: {}\n", plan.continuous_reason.c_str());
  }
  if (!plan.collision.empty()) fmt::print("collides: {}\n", plan.collision.c_str());
}

void print_plan(const Problem& problem, const PlanRow& row) {
  const MotionTask& task = *problem.motion;
  const Plan& plan = row.plan;
  fmt::print("{}  measure {}  wrench {}  lp {}\n", row.choice.problem, row.choice.measure,
             to_string(row.choice.wrench), row.choice.lp);
  fmt::print("{} of {:g} s, {} knots, scheme {}", problem.type(), task.T, task.k,
             to_string(task.scheme));
  if (row.has_plan()) fmt::print(", {} instants", plan.instants.size());
  if (!task.impulse && task.scheme == Scheme::kForward && task.k > 1) {
    fmt::print(" T/k apart at poses T/(k-1) apart");
  }
  if (task.impulse && plan.t_h > 0) fmt::print(", peak at knot {}", plan.t_h);
  fmt::print("\n{}{}{}\n", to_string(row.status), row.reason.empty() ? "" : ": ",
             row.reason.c_str());
  if (row.has_value()) {
    print_value(row);
    for (const std::string& text : binding_limits(problem.robot, row)) {
      fmt::print("{}\n", text);
    }
  }
  if (row.clearance) {
    fmt::print("clearance {:>9.5f} m at {:.4f} s: {}\n", row.clearance->least, row.clearance->t,
               row.clearance->pair);
  }
  if (row.has_plan()) print_instants(problem, row);
  if (row.has_value()) fmt::print("residual {}; ", line(plan.solution.residual));
  fmt::print("{}\n", line(row.evaluations, row.wall_s));
}

}  // namespace

int report(const Problem& problem, const PlanRow& row, bool json) {
  if (json) {
    print_json(plan_json(problem, row));
  } else {
    print_plan(problem, row);
  }
  return answers(row.status) ? kAnswered : kOtherStatus;
}

}  // namespace maxwrench
