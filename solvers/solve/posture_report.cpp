#include <fmt/format.h>

#include <cmath>

#include "solvers/solve/row.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "solvers/solve/pieces.h"
#include "maxwrench/problem.h"
#include "maxwrench/version.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

ordered_json to_json(const BranchCounts& branches) {
  return {{"valid", branches.valid()},           {"most", branches.most},
          {"unreachable", branches.unreachable}, {"beyond_limit", branches.beyond_limit},
          {"singular", branches.singular},       {"collision", branches.collision},
          {"incomplete", branches.incomplete}};
}

ordered_json to_json(const Problem& problem, const Row& row) {
  const Case& c = row.choice;
  const Capability& capability = row.capability;
  const bool solved = row.has_value();
  const bool has_wrench = solved && capability.w.size() > 0;
  ordered_json object;
  object["problem"] = c.problem;
  object["measure"] = c.measure;
  object["wrench"] = to_string(c.wrench);
  object["lp"] = known(c.lp != kNoSolver, c.lp);
  object["search"] = known(!c.search.empty(), c.search);
  object["seed"] = known(!c.search.empty(), c.seed);
  object["status"] = to_string(row.status);
  object["reason"] = known(!row.reason.empty(), row.reason.str());
  object["beta"] = known(solved, capability.beta);
  object["unit"] = row.unit;
  object["yardstick"] = known(std::isfinite(row.yardstick), row.yardstick);
  object["yardstick_unit"] = problem.unit();
  object["theta_r"] = known(row.has_posture(), array(row.posture.theta_r));
  object["theta"] = row.has_posture() ? theta(problem.robot, row.posture.base, row.posture.q)
                                      : ordered_json(nullptr);
  if (problem.free.count() > 0) {
    object["pose"] =
        row.has_posture() ? to_json(pose_at(problem, row.posture.theta_r)) : ordered_json(nullptr);
  }
  object["w"] = known(has_wrench, array(capability.w));
  object["h"] = known(has_wrench, array(capability.h));
  if (problem.contact) object["h_2"] = known(has_wrench, array(capability.h_2));
  object["u"] = known(solved && capability.u.size() > 0, array(capability.u));
  object["lambda"] = known(solved, array(capability.lambda));
  object["gradient"] = known(solved, array(row.gradient));
  object["residual"] = known(solved, to_json(capability.residual));
  object["evaluations"] = row.evaluations;
  object["calls"] = known(!c.search.empty(), to_json(row.calls));
  object["undecided"] = row.undecided;
  object["branches"] = to_json(row.branches);
  object["wall_s"] = row.wall_s;
  object["version"] = version();
  return object;
}

void print_following(const Problem& problem, const Posture& posture,
                     const std::vector<int>& joints) {
  for (const int i : joints) {
    fmt::print("follows  {:>10.5f}  {}\n", posture.q[i], problem.robot.joints[i].name);
  }
}

void print(const Problem& problem, const Row& row) {
  const Case& c = row.choice;
  fmt::print("{}  measure {}  wrench {}  lp {}\n", c.problem, c.measure, to_string(c.wrench), c.lp);
  if (row.has_posture()) {
    fmt::print("theta_r  {}\n", line(row.posture.theta_r));
    fmt::print("base xyz {}\nbase rpy {}\n", line(row.posture.base.p),
               line(rpy(row.posture.base.R)));
    print_following(problem, row.posture, problem.dependent);
    if (problem.free.count() > 0) {
      const Pose<double> pose = pose_at(problem, row.posture.theta_r);
      fmt::print("tool xyz {}\ntool rpy {}\n", line(pose.p), line(rpy(pose.R)));
    }
  }
  if (problem.contact && row.has_posture()) {
    print_following(problem, row.posture, problem.contact->follow);
  }
  if (row.branches.found + row.branches.unreachable > 0) {
    fmt::print("{}\n", describe(row.branches));
  }
  if (!row.has_value()) {
    fmt::print("{}: {}\n", to_string(row.status), row.reason.c_str());
    return;
  }
  if (!answers(row.status)) {
    fmt::print("{}: {}, the best so far\n", to_string(row.status), row.reason.c_str());
  }
  if (row.status == Status::kBestFound) {
    fmt::print("{} by {}\n", to_string(row.status), c.search);
  }
  const Capability& capability = row.capability;
  fmt::print("beta     {:>10.5f} {}\n", capability.beta, row.unit);
  fmt::print("yardstick{:>10.5f} {}\n", row.yardstick, problem.unit());
  if (capability.w.size() > 0) fmt::print("h        {}\n", line(capability.h));
  if (problem.contact) fmt::print("h_2      {}\n", line(capability.h_2));
  for (Eigen::Index i = 0; i < capability.u.size(); ++i) {
    fmt::print("u {:>17.5f}  of {:g} .. {:g}  {}\n", capability.u[i],
               problem.robot.actuation.u_min[i], problem.robot.actuation.u_max[i],
               actuator_name(problem.robot, i));
  }
  fmt::print("gradient {}\n", line(row.gradient));
  if (row.undecided > 0)
    fmt::print("undecided {} (evaluations without a verdict)\n", row.undecided);
  fmt::print("residual {}; {}\n", line(capability.residual), line(row.evaluations, row.wall_s));
}

}  // namespace

int report(const Problem& problem, const Row& row, bool json) {
  if (json) {
    print_json(to_json(problem, row));
  } else {
    print(problem, row);
  }
  return answers(row.status) ? kAnswered : kOtherStatus;
}

}  // namespace maxwrench
