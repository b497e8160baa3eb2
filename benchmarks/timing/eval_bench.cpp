// Times theta_r -> beta (model and lower level only) for every measure, wrench and solver, on
// random postures without collision checks; its parts; and KDL on the same chain. Prints ratios of
// these measurements at the end. You may add task files to the command line.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>
#include <map>
#include <memory>
#include <vector>

#include "benchmarks/suite/product.h"
#include "lib/math/random.h"
#include "lib/robot/chain.h"
#include "lib/search/forwarding.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

constexpr int kPostures = 1024;

std::vector<Eigen::VectorXd> random_postures(const Problem& problem) {
  Random random(1);
  std::vector<Eigen::VectorXd> postures(kPostures, Eigen::VectorXd(problem.redundancy()));
  for (Eigen::VectorXd& theta_r : postures) {
    for (int i = 0; i < problem.redundancy(); ++i) {
      theta_r[i] = random.uniform(problem.theta_r_min[i], problem.theta_r_max[i]);
    }
  }
  return postures;
}

void time_objective(benchmark::State& state, const Problem& problem, const Case& c, bool gradient) {
  const auto objective =
      make_capability_objective(problem, c.wrench, resolve(problem, c).make_measure, false);
  const std::vector<Eigen::VectorXd> postures = random_postures(problem);
  Eigen::VectorXd slope;
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        objective->evaluate(postures[i++ % kPostures], gradient ? &slope : nullptr));
  }
}

void time_model(benchmark::State& state, const Problem& problem) {
  PostureEvaluator model(problem, false);
  const std::vector<Eigen::VectorXd> postures = random_postures(problem);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(model.evaluate(postures[i++ % kPostures]).J.data());
  }
}

/// The part of a model with a second contact that a search needs where the contact is reachable:
/// all valid IK solutions, with collision checks.
void time_ik_solutions(benchmark::State& state, const Problem& problem) {
  PostureEvaluator model(problem);
  std::vector<Eigen::VectorXd> postures;
  for (Eigen::VectorXd& theta_r : random_postures(problem)) {
    if (model.evaluate(theta_r).status == Status::kValid) postures.push_back(std::move(theta_r));
  }
  std::size_t i = 0;
  for (auto _ : state) {
    if (i == postures.size()) i = 0;
    benchmark::DoNotOptimize(model.evaluate(postures[i++]).J.data());
    for (int ik_solution = 1; ik_solution < model.ik_solutions(); ++ik_solution) {
      benchmark::DoNotOptimize(model.select(ik_solution).J_2.data());
    }
  }
}

/// Forwards evaluations and records where a search evaluates.
class Recorder : public ForwardingObjective {
 public:
  Recorder(std::unique_ptr<Objective> objective, std::vector<Eigen::VectorXd>& visited)
      : ForwardingObjective(std::move(objective)), visited_(visited) {}
  double evaluate(const Eigen::VectorXd& theta_r, Eigen::VectorXd* gradient) override {
    visited_.push_back(theta_r);
    return objective_->evaluate(theta_r, gradient);
  }
  std::unique_ptr<Objective> clone() const override {
    return std::make_unique<Recorder>(objective_->clone(), visited_);
  }

 private:
  std::vector<Eigen::VectorXd>& visited_;
};

std::vector<Eigen::VectorXd> postures_of_a_search(const Problem& problem) {
  std::vector<Eigen::VectorXd> visited;
  Recorder recorder(
      make_capability_objective(problem, Wrench::kPure, resolve(problem, {}).make_measure, false),
      visited);
  SearchOptions options;
  options.budget = 4 * kPostures;
  find_search("crs2").make()->maximize(recorder, options);
  return visited;
}

/// The points of a search, in its order, with all postures that reach the pose. The counters are
/// their number, and the time of each at the median point.
void time_along_a_search(benchmark::State& state, const Problem& problem) {
  using Clock = std::chrono::steady_clock;
  const std::vector<Eigen::VectorXd> visited = postures_of_a_search(problem);
  PostureEvaluator model(problem, false);
  std::vector<double> each;
  long found = 0, places = 0;
  for (auto _ : state) {
    for (const Eigen::VectorXd& theta_r : visited) {
      const auto start = Clock::now();
      const long here = model.evaluate(theta_r).ik_solutions.found;
      for (int ik_solution = 1; ik_solution < model.ik_solutions(); ++ik_solution) {
        benchmark::DoNotOptimize(model.select(ik_solution).J.data());
      }
      const std::chrono::duration<double, std::nano> spent = Clock::now() - start;
      if (here > 0) each.push_back(spent.count() / static_cast<double>(here));
      found += here;
      ++places;
    }
  }
  const auto middle = each.begin() + static_cast<std::ptrdiff_t>(each.size() / 2);
  std::nth_element(each.begin(), middle, each.end());
  state.counters["ik_solutions"] = static_cast<double>(found) / static_cast<double>(places);
  state.counters["ns_per_ik_solution"] = *middle;
}

/// Only the collision check, for known link poses.
void time_collision(benchmark::State& state, const Problem& problem) {
  PostureEvaluator model(problem, false);
  std::vector<std::vector<Pose<double>>> links;
  for (const Eigen::VectorXd& theta_r : random_postures(problem)) {
    links.push_back(model.evaluate(theta_r).links);
  }
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(problem.robot.collision->collides(links[i++ % kPostures]));
  }
}

/// The chain of the arm with one segment for each joint, the fewest that KDL needs.
KDL::Chain kdl_chain(const Problem& problem) {
  const Robot& robot = problem.robot;
  const auto vector = [](const Eigen::Vector3d& v) { return KDL::Vector(v.x(), v.y(), v.z()); };
  const auto frame = [&](const Pose<double>& pose) {
    const Eigen::Matrix3d& R = pose.R;
    return KDL::Frame(KDL::Rotation(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0),
                                    R(2, 1), R(2, 2)),
                      vector(pose.p));
  };
  KDL::Chain chain;
  const std::vector<int> joints = chain_to(robot, problem.end_effector);
  for (const int i : joints) {
    const Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    const EndEffector& tool = robot.end_effectors[static_cast<std::size_t>(problem.end_effector)];
    const auto type =
        joint.type == JointType::kRevolute ? KDL::Joint::RotAxis : KDL::Joint::TransAxis;
    chain.addSegment(KDL::Segment(
        KDL::Joint("joint", vector(joint.placement.p), vector(joint.placement.R * joint.axis),
                   type),
        frame(i == joints.back() ? joint.placement * tool.placement : joint.placement)));
  }
  return chain;
}

/// Forward kinematics and Jacobian with KDL.
void time_kdl(benchmark::State& state, const Problem& problem) {
  const KDL::Chain chain = kdl_chain(problem);
  KDL::ChainFkSolverPos_recursive forward(chain);
  KDL::ChainJntToJacSolver backward(chain);
  Random random(1);
  std::vector<KDL::JntArray> postures(kPostures, KDL::JntArray(chain.getNrOfJoints()));
  for (KDL::JntArray& posture : postures) {
    for (double& q : posture.data) q = random.uniform(-1, 1);
  }
  KDL::Frame tip;
  KDL::Jacobian J(chain.getNrOfJoints());
  std::size_t i = 0;
  for (auto _ : state) {
    const KDL::JntArray& q = postures[i++ % kPostures];
    forward.JntToCart(q, tip);
    backward.JntToJac(q, J);
    benchmark::DoNotOptimize(tip.p.data[0]);
    benchmark::DoNotOptimize(J.data.data());
  }
}

/// The call of the library that users make, with everything that an answer has.
void time_evaluate(benchmark::State& state, const Problem& problem) {
  const std::vector<Eigen::VectorXd> postures = random_postures(problem);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(evaluate(problem, postures[i++ % kPostures].transpose()).beta());
  }
}

void add_problem(const Problem& problem) {
  const auto name = [&](const std::string& rest) { return problem.name + "/" + rest; };
  const auto add = [](const std::string& title, auto body) {
    benchmark::RegisterBenchmark(title.c_str(), body);
  };
  if (!chain_to(problem.robot, problem.end_effector).empty()) {
    add(name("kdl"), [&](benchmark::State& state) { time_kdl(state, problem); });
  }
  add(name("model"), [&](benchmark::State& state) { time_model(state, problem); });
  add(name("evaluate"), [&](benchmark::State& state) { time_evaluate(state, problem); });
  if (problem.contact) {
    add(name("model/ik_solutions"),
        [&](benchmark::State& state) { time_ik_solutions(state, problem); });
  }
  if (!problem.dependent.empty()) {
    add(name("model/search"),
        [&](benchmark::State& state) { time_along_a_search(state, problem); });
  }
  if (problem.robot.collision) {
    add(name("collision"), [&](benchmark::State& state) { time_collision(state, problem); });
  }
  for (const Case& c : product(problem, 1, 1)) {
    if (c.search != general_search()) continue;
    const std::string title =
        name(fmt::format("{}/{}/{}", c.measure, to_string(c.wrench), c.solver));
    add(title,
        [&problem, c](benchmark::State& state) { time_objective(state, problem, c, false); });
    add(title + "+gradient",
        [&problem, c](benchmark::State& state) { time_objective(state, problem, c, true); });
  }
}

/// Prints the console's table and keeps the shortest time of each name.
class Keeper : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      const auto counter = run.counters.find("ns_per_ik_solution");
      const double time =
          counter == run.counters.end() ? run.GetAdjustedCPUTime() : double(counter->second);
      const auto [kept, added] = times_.try_emplace(run.run_name.function_name, time);
      if (!added) kept->second = std::min(kept->second, time);
    }
  }

  /// Prints the ratios of a problem if all its parts were measured.
  void print_ratios(const Problem& problem) const {
    const auto time = [&](const std::string& rest) {
      const auto found = times_.find(problem.name + "/" + rest);
      return found == times_.end() ? 0.0 : found->second;
    };
    const double model = time("model"), kdl = time("kdl"), collision = time("collision");
    const double value = time("linf_polytope/pure/facets");
    const double gradient = time("linf_polytope/pure/facets+gradient");
    if (model > 0 && kdl > 0) {
      fmt::print("{}: model (poses, J, tau_d) / KDL (pose, J) = {:.2f}\n", problem.name,
                 model / kdl);
    }
    if (time("model/search") > 0 && kdl > 0) {
      fmt::print("{}: along a search, median of model / ik_solutions / KDL = {:.2f}\n",
                 problem.name, time("model/search") / kdl);
    }
    if (value > 0 && gradient > 0) {
      fmt::print("{}: beta_2 with gradient / beta_2 = {:.2f}\n", problem.name, gradient / value);
    }
    if (value > 0 && collision > 0) {
      fmt::print("{}: share of the collision check in one evaluation of beta_2 = {:.0f} %\n",
                 problem.name, 100 * collision / (value + collision));
    }
  }

 private:
  std::map<std::string, double> times_;
};

}  // namespace
}  // namespace maxwrench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  std::vector<std::string> names = maxwrench::shipped_problems();
  names.insert(names.end(), argv + 1, argv + argc);
  std::vector<std::unique_ptr<maxwrench::Problem>> problems;
  for (const std::string& name : names) {
    auto problem = std::make_unique<maxwrench::Problem>(maxwrench::load_problem(name));
    if (problem->motion) continue;
    problems.push_back(std::move(problem));
    maxwrench::add_problem(*problems.back());
  }
  maxwrench::Keeper keeper;
  benchmark::RunSpecifiedBenchmarks(&keeper);
  for (const auto& problem : problems) keeper.print_ratios(*problem);
}
