#include "cli/task/state.h"

#include <fmt/format.h>

#include <array>

#include "cli/cli.h"
#include "cli/output.h"
#include "lib/robot/dynamics.h"
#include "maxwrench/load.h"
#include "maxwrench/version.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

/// M n×n, J 6×n, the others n, in SI units.
struct Terms {
  Eigen::MatrixXd M;
  Eigen::VectorXd C_v, D_v, g, tau_d;
  Matrix6Xd J;
};

Terms evaluate_terms(const Problem& problem, const State& state) {
  const int n = problem.robot.velocities();
  Terms terms;
  for (auto* vector : {&terms.C_v, &terms.D_v, &terms.g, &terms.tau_d}) vector->resize(n);
  terms.J.resize(6, n);
  Dynamics dynamics(problem.robot);
  dynamics.set_configuration(state.base.R, state.q);
  dynamics.mass_matrix(terms.M);
  dynamics.coriolis(state.velocity, terms.C_v);
  dynamics.damping(state.velocity, terms.D_v);
  dynamics.gravity(terms.g);
  dynamics.inverse(state.velocity, state.acceleration, terms.tau_d);
  dynamics.kinematics().jacobian(problem.robot.end_effectors[problem.end_effector], state.base.R,
                                 terms.J);
  return terms;
}

void print_terms_object(const Problem& problem, const std::string& file, const Terms& terms) {
  ordered_json object;
  object["problem"] = problem.name;
  object["state"] = file;
  object["velocities"] = velocity_names(problem.robot);
  object["M"] = rows(terms.M);
  object["C_v"] = array(terms.C_v);
  object["D_v"] = array(terms.D_v);
  object["g"] = array(terms.g);
  object["tau_d"] = array(terms.tau_d);
  object["J"] = rows(terms.J);
  object["version"] = version();
  print_json(object);
}

void print_row(std::string_view name, const Eigen::VectorXd& values) {
  fmt::print("{:<18}", name);
  for (const double value : values) fmt::print(" {:>10}", decimals(value));
  fmt::print("\n");
}

void print_terms(const Problem& problem, const Terms& terms) {
  const std::vector<std::string> names = velocity_names(problem.robot);
  fmt::print("{}  M, the terms of tau_d = M v_d + C_v + D_v + g, and J by columns\n", problem.name);
  for (std::size_t i = 0; i < names.size(); ++i) {
    print_row(fmt::format("M  {}", names[i]), terms.M.row(static_cast<Eigen::Index>(i)));
  }
  print_row("C_v", terms.C_v);
  print_row("D_v", terms.D_v);
  print_row("g", terms.g);
  print_row("tau_d", terms.tau_d);
  for (std::size_t i = 0; i < names.size(); ++i) {
    print_row(fmt::format("J' {}", names[i]), terms.J.col(static_cast<Eigen::Index>(i)));
  }
}

}  // namespace

std::vector<std::string> velocity_names(const Robot& robot) {
  std::vector<std::string> names;
  for (const int axis : robot.base_axes)
    names.emplace_back(kTwistAxes[static_cast<std::size_t>(axis)]);
  for (const Joint& joint : robot.joints) names.push_back(joint.name);
  return names;
}

int report_state(const Problem& problem, const std::string& file, bool json) {
  const Terms terms = evaluate_terms(problem, load_state(file, problem.robot));
  if (!terms.tau_d.allFinite()) {
    throw std::invalid_argument(file + ": got a motion whose tau_d overflows, expected smaller " +
                                "numbers");
  }
  if (json) {
    print_terms_object(problem, file, terms);
  } else {
    print_terms(problem, terms);
  }
  return kAnswered;
}

}  // namespace maxwrench
