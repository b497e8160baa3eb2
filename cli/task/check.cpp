#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <memory>

#include "cli/cli.h"
#include "cli/task/own_weight.h"
#include "cli/task/problem_options.h"
#include "lib/posture/ik/dependent_joints.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

constexpr int kSamples = 1000;

std::string base_axes(const Robot& robot) {
  std::vector<std::string> names;
  for (const int axis : robot.base_axes) names.emplace_back(kTwistAxes[axis]);
  return fmt::format("{{{}}}", fmt::join(names, ", "));
}

/// A gear has no limit of its own.
std::string describe_gear(const Robot& robot, const Joint& joint) {
  return fmt::format("mimics {}, ratio {:g}, offset {:g}",
                     robot.joints[static_cast<std::size_t>(joint.gear->leader)].name,
                     joint.gear->ratio, joint.gear->offset);
}

void print_own_weight(const Robot& robot) {
  const auto moving = robot.links.size() - 1;
  const bool has_mass = std::any_of(robot.links.begin() + 1, robot.links.end(),
                                    [](const Link& link) { return link.mass > 0; });
  if (moving > 0 && !has_mass) {
    fmt::print("  whether it holds its own weight is not known: {}\n",
               moving == 1 ? "its moving link has no mass"
                           : fmt::format("its {} moving links have no mass", moving));
    return;
  }
  const OwnWeight own = own_weight(robot, kSamples);
  if (own.share == 0) {
    fmt::print("  holds its own weight in all of {} random postures\n", kSamples);
    return;
  }
  const Joint& joint = robot.joints[static_cast<std::size_t>(own.weakest)];
  fmt::print(
      "  cannot hold its own weight in {:.3g} % of {} random postures; weakest joint {} (effort "
      "{:g}, needs up to {:.3g} {})\n",
      100 * own.share, kSamples, joint.name, joint.effort_max, own.needed,
      joint.type == JointType::kRevolute ? "N m" : "N");
}

void print(const Robot& robot) {
  const Zonotope& set = robot.actuation;
  fmt::print("robot {}\n", robot.name);
  fmt::print("  degrees of freedom {}: base {}, {} joints\n", robot.velocities(), base_axes(robot),
             robot.joints.size());
  fmt::print("  actuators {}: {} thrusters, {} joints\n", robot.actuators(), robot.thrusters.size(),
             robot.joints.size());
  fmt::print("  rank of B {} of {}\n", set.rank, set.dimension());
  if (set.has_facets) {
    fmt::print("  facet pairs of {{B u}} {}\n", set.facet_pairs());
  } else {
    fmt::print("  facet pairs of {{B u}} not enumerated: too many\n");
  }
  fmt::print("  end effectors");
  for (const EndEffector& e : robot.end_effectors) {
    fmt::print(" {} (on {})", e.name, robot.links[e.link].name);
  }
  fmt::print("\n  collision pairs {}\n", robot.collision ? robot.collision->pairs() : 0);
  for (const Link& link : robot.links) {
    fmt::print("  link {:<20} {:g} kg, displaces {:g} m^3", link.name, link.mass, link.volume);
    const std::size_t bodies = link.hydrodynamics.size();
    if (bodies > 0)
      fmt::print(", added mass and drag of {} {}", bodies, bodies > 1 ? "bodies" : "body");
    fmt::print("\n");
  }
  if (robot.trim.buoyancy_mass != 0) {
    fmt::print("  trim lifts {:g} kg at [{:g}] m\n", robot.trim.buoyancy_mass,
               fmt::join(robot.trim.position, ", "));
  }
  for (const Thruster& t : robot.thrusters) {
    fmt::print("  thruster {:<16} {:g} .. {:g} N, {:g} N/s\n", t.name, t.force_min, t.force_max,
               t.force_rate_max);
  }
  for (const Joint& j : robot.joints) {
    const bool turns = j.type == JointType::kRevolute;
    fmt::print("  joint {:<19} {:g} .. {:g} {}, {}\n", j.name, j.q_min, j.q_max,
               turns ? "rad" : "m",
               j.gear ? describe_gear(robot, j)
                      : fmt::format("effort {:g} {}", j.effort_max, turns ? "N m" : "N"));
  }
  for (const auto& [name, posture] : robot.states) {
    std::vector<std::string> positions;
    for (const auto& [joint, q] : posture) positions.push_back(fmt::format("{}={:g}", joint, q));
    fmt::print("  posture {:<17} {}\n", name, fmt::join(positions, ", "));
  }
  if (!robot.limits.empty()) fmt::print("  limits in use: {}\n", robot.limits);
  print_own_weight(robot);
  for (const auto& [block, source] : robot.sources)
    fmt::print("  source of {}: {}\n", block, source);
  for (const std::string& note : robot.notes) fmt::print("  note: {}\n", note);
  const std::vector<std::string> warnings = warnings_of(robot);
  if (warnings.empty()) return;
  fmt::print("warnings {}\n", warnings.size());
  for (const std::string& warning : warnings) fmt::print("  warning: {}\n", warning);
}

/// Prints the base pose and the dependent joints at the default of theta_r.
void print_dependents(const Problem& problem) {
  PostureEvaluator model(problem);
  const Posture& posture = model.evaluate(problem.theta_r_default);
  Eigen::VectorXd q = posture.q;
  if (problem.motion &&
      !problem.dependent.empty()) {  // a trajectory begins at the guess's IK solution
    DependentJoints ik_solution(problem);
    ik_solution.follow(problem.theta_r_default);
    q = ik_solution.z().tail(q.size());
  }
  for (const int i : problem.dependent) {
    const Joint& joint = problem.robot.joints[i];
    const bool inside =
        q[i] >= joint.q_min - kLimitTolerance && q[i] <= joint.q_max + kLimitTolerance;
    fmt::print("  dependent {:<15} {:g} .. {:g}, at the default {:g}{}\n", joint.name, joint.q_min,
               joint.q_max, q[i], inside ? "" : ", beyond its limits");
  }
  fmt::print("  {}\n",
             problem.robot.base_axes.empty()
                 ? problem.dependent.empty()
                       ? "fixed base"
                       : "fixed base; for the dependent joints, all IK solutions are tried"
             : problem.dependent.empty()
                 ? "the base pose is dependent, in closed form"
                 : "the base pose is dependent, too; all IK solutions are tried");
  fmt::print("  default posture: {}\n",
             posture.status == Status::kValid ? "exists" : describe_violation(problem, posture));
  if (problem.motion && problem.motion->transfer) return;  // no pose asks for IK solutions
  const Sampled sampled = sample_postures(problem, kSamples);
  fmt::print("  {} of {} random theta_r are valid; {}\n", sampled.valid, kSamples,
             describe(sampled.postures));
}

std::string bounds(double low, double high) {
  if (low == -kInfinity && high == kInfinity) return "any amount";
  return fmt::format("{:g} .. {:g}", low, high);
}

void print(const Robot& robot, const Contact& contact) {
  static constexpr std::array<const char*, 4> kSurfaces = {"point", "line", "plane", "circle"};
  const EndEffector& tip = robot.end_effectors[static_cast<std::size_t>(contact.end_effector)];
  std::vector<std::string> joints;
  for (const int i : contact.follow)
    joints.push_back(robot.joints[static_cast<std::size_t>(i)].name);
  const Eigen::Vector3d inward = (1e9 * contact.frame.R.col(2)).array().round() / 1e9 + 0.0;
  fmt::print(
      "  second contact {}: {} at [{:g}] m, into the environment along [{:.3g}]; dependent {}\n",
      tip.name, kSurfaces[static_cast<std::size_t>(contact.surface)],
      fmt::join(contact.frame.p, ", "), fmt::join(inward, ", "), fmt::join(joints, ", "));
  if (contact.C.cols() == 0) fmt::print("  second contact exerts nothing\n");
  for (Eigen::Index i = 0; i < contact.C.cols(); ++i) {
    fmt::print("  second contact exerts [{:g}], {}\n",
               fmt::join(Eigen::VectorXd(contact.C.col(i)), ", "),
               bounds(contact.w_min[i], contact.w_max[i]));
  }
}

std::string at_pose(const Pose<double>& pose) {
  const Eigen::Vector3d turn = logarithm(pose.R);
  const auto tidy = [](const Eigen::Vector3d& a) {
    return Eigen::Vector3d((1e9 * a).array().round() / 1e9 + 0.0);
  };
  return fmt::format("[{:.6g}] m, rotation vector [{:.6g}] rad", fmt::join(tidy(pose.p), ", "),
                     fmt::join(tidy(turn), ", "));
}

void print_payload(const CarriedBody& body) {
  fmt::print("  payload with its centre of mass at [{:g}] m in axes of the end effector\n",
             fmt::join(body.com, ", "));
}

/// Prints the data of a task in time.
void print(const MotionTask& motion) {
  fmt::print("  {} of {:g} s, {} knots of theta_r, scheme {}",
             motion.impulse    ? "impulse"
             : motion.transfer ? "transfer"
                               : "trajectory",
             motion.T, motion.k, to_string(motion.scheme));
  if (motion.scheme == Scheme::kSpline) {
    fmt::print(", {} instants per interval", motion.instants_per_interval);
  }
  fmt::print("; limits of effort rates {}", motion.rates ? "apply" : "do not apply");
  if (motion.thruster_lag > 0) fmt::print("; lag of thrusters {:g} s", motion.thruster_lag);
  fmt::print("\n");
  if (motion.impulse) {
    fmt::print("  peak at knot {}, start {} at theta_r [{:g}]\n",
               motion.t_h > 0 ? fmt::format("{}", motion.t_h) : "best", to_string(motion.start),
               fmt::join(motion.theta_0, ", "));
    return;
  }
  if (motion.transfer) {
    fmt::print("  from theta_r [{:g}]\n  to           [{:g}]\n", fmt::join(motion.theta_0, ", "),
               fmt::join(motion.theta_T, ", "));
    print_payload(*motion.payload);
    return;
  }
  fmt::print("  path from {}\n       to   {}", at_pose(motion.path.pose(0)),
             at_pose(motion.path.pose(motion.T)));
  if (motion.path.angle() != 0) fmt::print(", turned by {:g} rad", motion.path.angle());
  if (motion.payload) {
    fmt::print("\n");
    print_payload(*motion.payload);
    return;
  }
  if (motion.table) {
    fmt::print("\n  wrenches at {} times of {}", motion.table->t.size(), motion.table->file);
  }
  fmt::print("\n  c {}\n", motion.c_turns ? "turns with the end effector" : "stays in the world");
}

void print(const Problem& problem) {
  fmt::print("task {}{}\n", problem.name,
             problem.label.empty() ? "" : fmt::format(" ({})", problem.label));
  fmt::print("  end effector {}, c = [{:g}] in [force; torque], beta in {}\n",
             problem.robot.end_effectors[problem.end_effector].name, fmt::join(problem.c, ", "),
             problem.unit());
  if (problem.motion) print(*problem.motion);
  if (problem.free.count() > 0) {
    fmt::print("  pose free along {}; c {}\n",
               problem.free.along_end_effector ? "the end effector's axes" : "its own axes",
               problem.free.wrench_turns ? "turns with the end effector" : "stays in the world");
  }
  if (const ScenarioList& list = problem.scenarios; !list.empty()) {
    fmt::print("  scenarios {}: {} wrenches{}, {} limits of actuators, {} uncertain loads\n",
               list.count(), list.wrenches.size(), list.ball ? " with a ball" : "",
               list.limits.size(), list.loads.size());
    for (const ScenarioWrench& wrench : list.wrenches) {
      fmt::print("    {} [{:g}]\n", wrench.name.empty() ? "wrench" : wrench.name,
                 fmt::join(wrench.c, ", "));
    }
    for (const ScenarioLimits& limits : list.limits) {
      if (!limits.name.empty()) fmt::print("    {}\n", limits.name);
    }
  }
  fmt::print("  wrench any: {} columns; reference {:g} {}, desired [{:g}]\n", problem.W_any.cols(),
             problem.reference, problem.unit(), fmt::join(problem.desired, ", "));
  fmt::print("  redundancy {}\n", problem.redundancy());
  for (int i = 0; i < problem.redundancy(); ++i) {
    fmt::print("  theta_r {:<17} {:g} .. {:g}, default {:g}\n", problem.theta_r_name(i),
               problem.theta_r_min[i], problem.theta_r_max[i], problem.theta_r_default[i]);
  }
  print_dependents(problem);
  if (problem.contact) print(problem.robot, *problem.contact);
  if (!problem.source.empty()) fmt::print("  source: {}\n", problem.source);
  print(problem.robot);
}

struct CheckOptions {
  std::string file;
  bool strict = false;
  ProblemOptions source;
};

/// FILE is a robot file, a task file, the name of a shipped problem or a URDF.
int check(const CheckOptions& options) {
  const ProblemOptions& source = options.source;
  const std::vector<std::string> shipped = shipped_problems();
  const bool is_task_file =
      std::find(shipped.begin(), shipped.end(), options.file) != shipped.end() ||
      (!is_urdf(options.file) && is_task(options.file));
  Robot robot;
  if (is_task_file || (is_urdf(options.file) && source.describes_task())) {
    const Problem problem = source.load(options.file);
    print(problem);
    robot = problem.robot;
  } else {
    robot = source.load_robot(options.file);
    print(robot);
  }
  return options.strict && !warnings_of(robot).empty() ? kOtherStatus : kAnswered;
}

}  // namespace

void add_check(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<CheckOptions>();
  options->source.counts_warnings = false;  // they are printed
  CLI::App& command = *app.add_subcommand(
      "check", "prints what a robot, task or URDF contains and what is wrong with it");
  command.add_option("file", options->file, "robot or task file, a shipped task, or a URDF")
      ->required();
  command.add_flag("--strict", options->strict, "exit with 1 if there is a warning");
  options->source.add(command);
  command.callback([options, &exit_status] { exit_status = check(*options); });
}

}  // namespace maxwrench
