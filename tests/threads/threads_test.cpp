#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "lib/math/random.h"
#include "maxwrench/batch.h"
#include "maxwrench/evaluations.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "maxwrench/wrench_program.h"
#include "solvers/certify/certify.h"
#include "solvers/certify/proof_recorder.h"
#include "solvers/solve/method.h"
#include "solvers/solve/row.h"
#include "solvers/solve/tank.h"
#include "verify/verify.h"

// What runs beside each other, in one small program: the thread sanitizer's build holds nothing
// else. Everything is compared with what one thread alone gets.

namespace maxwrench {
namespace {

constexpr int kThreads = 4;

/// Calls body(0) ... body(kThreads - 1) at once.
void at_once(const std::function<void(int)>& body) {
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) threads.emplace_back(body, t);
  for (std::thread& thread : threads) thread.join();
}

Eigen::VectorXd anywhere(const Problem& problem, Random& random) {
  const Eigen::VectorXd share =
      Eigen::VectorXd::NullaryExpr(problem.redundancy(), [&] { return random.uniform(); });
  return problem.theta_r_min + share.cwiseProduct(problem.theta_r_max - problem.theta_r_min);
}

TEST(Threads, ParallelForCallsEachOnceAndWhatFollowsSeesIt) {
  for (int round = 0; round < 20; ++round) {
    std::vector<int> calls(500, 0);
    long sum = 0;
    parallel_for(kThreads, 500, [&](long i) { calls[static_cast<std::size_t>(i)] += round; });
    for (const int count : calls) sum += count;
    EXPECT_EQ(sum, 500 * round);
  }
}

/// A posture in the virtual tank, and an impulse.
TEST(Threads, ShareTheTank) {
  for (const char* name : {"fixed/push", "uvms/valve_impulse"}) {
    const Problem problem = load_problem(name);
    const char* const scheme = problem.motion ? "spline" : "";
    const Case c{.problem = name, .search = "", .scheme = scheme, .integrator = "cvode"};
    const Answer one = experiment(problem, {c});
    ASSERT_TRUE(one.has_value()) << name;
    std::vector<Answer> rows(kThreads);
    at_once([&](int t) { rows[static_cast<std::size_t>(t)] = experiment(problem, {c}); });
    for (const Answer& row : rows) {
      EXPECT_EQ(row.status, one.status);
      EXPECT_EQ(row.beta(), one.beta()) << name;
      EXPECT_EQ(row.evaluations, one.evaluations) << name;
    }
  }
}

class ThreadsInSearch : public testing::TestWithParam<SearchEntry> {};

INSTANTIATE_TEST_SUITE_P(All, ThreadsInSearch,
                         testing::ValuesIn(searches().begin(), searches().end()),
                         [](const testing::TestParamInfo<SearchEntry>& entry) {
                           std::string name = entry.param.name;
                           for (char& c : name) c = std::isalnum(c) ? c : '_';
                           return name;
                         });

/// uvms/valve has self-collision of boxes and capsules, dual_arm/bar_wall IK solutions that are
/// counted.
TEST_P(ThreadsInSearch, FindsTheSame) {
  for (const char* name : {"uvms/valve", "dual_arm/bar_wall"}) {
    const Problem problem = load_problem(name);
    Case c;
    c.problem = problem.name;
    c.search = GetParam().name;
    c.budget = 400;
    const Method method = resolve(problem, c);
    const Answer one = solve(problem, {method.choice, 1}),
                 many = solve(problem, {method.choice, kThreads});
    EXPECT_EQ(one.status, many.status);
    EXPECT_EQ(one.evaluations, many.evaluations);
    EXPECT_EQ(one.ik_solutions.found, many.ik_solutions.found);
    if (one.has_value()) {
      EXPECT_EQ(one.posture.theta_r, many.posture.theta_r);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BetweenFacets, ThreadsInSearch,
                         testing::ValuesIn(facet_searches().begin(), facet_searches().end()),
                         [](const auto& entry) { return std::string(entry.param.name); });

/// All threads add the same names again while others solve by them.
TEST(Threads, ShareWhatUsersAdd) {
  const Problem problem = load_problem("planar/force");
  Case c{problem.name, "ellipsoid"};
  c.search = "cmaes";
  c.budget = 200;
  const Answer one = solve(problem, {c, 1});
  c.measure = "own_shared";
  c.search = "own_shared";
  at_once([&](int /*t*/) {
    for (int round = 0; round < 10; ++round) {
      add_measure({"own_shared", "", false, true, nullptr,
                   [](const Problem& of, auto) { return make_ellipsoid(of.robot); }});
      add_search({"own_shared", "", false, [] { return find_search("cmaes").make(); }, true});
      EXPECT_EQ(solve(problem, {c, 2}).beta(), one.beta());
    }
  });
}

TEST(Threads, CertifyProvesTheSame) {
  const Problem problem = load_problem("uvms/lift");
  Case c{problem.name};
  const Method method = resolve(problem, c);
  const Answer best = solve(problem, {method.choice, 1});
  const auto bound = make_capability_bound(problem, c.measure, c.wrench);
  const auto objective = make_objective(problem, method);
  CertifyOptions options;
  options.gap = 0.05;
  const Candidate incumbent{best.posture.theta_r, best.capability.beta};
  const CertifyResult one = certify(*objective, *bound, incumbent, options);
  options.threads = kThreads;
  ProofRecorder recorder;
  options.sink = [&](const CertifiedBox& box) { recorder.add(box); };
  const CertifyResult many = certify(*objective, *bound, incumbent, options);
  EXPECT_EQ(one.status, Status::kProven);
  EXPECT_EQ(one.bound, many.bound);
  EXPECT_EQ(one.boxes, many.boxes);
  const Answer row = evaluate(problem, many.best.theta_r, {method.choice});
  const ProofCertificate proof = recorder.certificate(row, many.bound, options.gap);
  const Verification verified = verify(problem, proof, kThreads);
  EXPECT_EQ(verified.rejection, "");
  EXPECT_EQ(verified.boxes, many.boxes);
}

class ThreadsInSearchOfTrajectories : public testing::TestWithParam<SearchEntry> {};

INSTANTIATE_TEST_SUITE_P(All, ThreadsInSearchOfTrajectories,
                         testing::ValuesIn(trajectory_searches().begin(),
                                           trajectory_searches().end()),
                         [](const auto& entry) { return std::string(entry.param.name); });

/// A posture, a trajectory, and one with dependent joints.
TEST_P(ThreadsInSearchOfTrajectories, FindsTheSame) {
  for (const char* name : {"uvms/valve", "uvms/valve_trajectory", "mobile/trajectory"}) {
    const Problem problem = load_problem(name);
    const auto objective =
        make_trajectory_objective(problem, Wrench::kPure, trajectory_solvers().front().make);
    SearchOptions options;
    // slp's local searches side by side need most.
    const std::string_view search = GetParam().name;
    options.budget = search == "slp" ? 300 : search == "joint_nlp" ? 100 : 20;
    options.start = problem.theta_r_default.replicate(knots_of(problem), 1);
    options.threads = 1;
    const SearchResult one = GetParam().make()->maximize(*objective, options);
    options.threads = kThreads;
    const SearchResult many = GetParam().make()->maximize(*objective, options);
    EXPECT_EQ(one.value, many.value) << name;
    EXPECT_EQ(one.theta_r, many.theta_r) << name;
    EXPECT_EQ(one.evaluations, many.evaluations) << name;
  }
}

TEST(Threads, BatchesOfEvaluationsShareNothing) {
  const Problem problem = load_problem("planar/two_arms");
  const Case c{problem.name};
  const auto objective =
      make_capability_objective(problem, c.wrench, resolve(problem, c).make_measure, true);
  const auto values = [&](int threads) {
    const SearchOptions options;
    SearchRun run(options);
    const auto point = [&](long i) {
      Random random(1, static_cast<std::uint64_t>(i));
      return anywhere(problem, random);
    };
    const std::vector<double> result = evaluate_all(*objective, 1000, point, threads, run);
    return result;
  };
  EXPECT_EQ(values(1), values(kThreads));
}

TEST(Threads, RowsOfPosturesAreThoseOfOneThread) {
  const Problem problem = load_problem("planar/force");
  Random random(2);
  Evaluations::Rows rows(1000, problem.redundancy());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) rows.row(i) = anywhere(problem, random);
  Options options;
  options.threads = 1;
  const Evaluations one = evaluate_each(problem, rows, options, true);
  options.threads = kThreads;
  long finished = 0;
  options.progress = [&finished](long count) { finished = count; };  // one thread at a time
  const Evaluations many = evaluate_each(problem, rows, options, true);
  EXPECT_EQ(finished, rows.rows());
  EXPECT_EQ(many.status, one.status);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    if (one.status[static_cast<std::size_t>(i)] != Status::kOptimal) continue;
    EXPECT_EQ(many.beta[i], one.beta[i]);
    EXPECT_EQ(Eigen::VectorXd(many.gradient.row(i)), Eigen::VectorXd(one.gradient.row(i)));
  }
}

TEST(Threads, ProblemsAreLoadedAtOnce) {
  const std::vector<std::string> names = shipped_problems();
  std::vector<std::vector<Problem>> loaded(kThreads);
  at_once([&](int t) {
    for (const std::string& name : names)
      loaded[static_cast<std::size_t>(t)].push_back(load_problem(name));
  });
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Problem alone = load_problem(names[i]);
    for (const std::vector<Problem>& of_thread : loaded) {
      EXPECT_EQ(of_thread[i].theta_r_default, alone.theta_r_default);
      EXPECT_EQ(of_thread[i].robot.actuation.B, alone.robot.actuation.B);
      EXPECT_EQ(of_thread[i].robot.links.size(), alone.robot.links.size());
    }
  }
}

/// A robot and its collision shapes are shared; each thread has a model of its own.
TEST(Threads, ShareARobot) {
  for (const char* name : {"uvms/valve", "dual_arm/two_arms", "mobile/push"}) {
    const Problem problem = load_problem(name);
    std::vector<std::vector<Eigen::VectorXd>> seen(kThreads);
    at_once([&](int t) {
      PostureEvaluator model(problem);
      Random random(1);
      for (int i = 0; i < 100; ++i) {
        const Posture& posture = model.evaluate(anywhere(problem, random));
        Eigen::VectorXd row(posture.tau_d.size() + 1);
        row << posture.tau_d, static_cast<double>(posture.status);
        seen[static_cast<std::size_t>(t)].push_back(row);
      }
    });
    for (const auto& rows : seen) EXPECT_EQ(rows, seen[0]) << name;
  }
}

/// Ipopt, GLPK and Clp among them. Every other time with a new solver, so that some begin and end
/// while others run.
TEST(Threads, EveryLowerLevelSolverSupportsSeveralAtOnce) {
  const Problem problem = load_problem("uvms/valve");
  PostureEvaluator model(problem, false);
  for (const WrenchSolverEntry& entry : wrench_solvers()) {
    WrenchProgram program = make_wrench_program(problem, Wrench::kPure);
    set_posture(model.evaluate(problem.theta_r_default), program);
    std::vector<double> beta(kThreads, 0);
    at_once([&](int t) {
      std::unique_ptr<WrenchSolver> solver;
      Capability capability;
      for (int i = 0; i < 20; ++i) {
        if (i % 2 == 0) solver = entry.make();
        solver->solve(program, true, capability);
      }
      beta[static_cast<std::size_t>(t)] = capability.beta;
    });
    for (const double value : beta) EXPECT_EQ(value, beta[0]) << entry.name;
    // The axis of the shoulder carries 9 N m.
    EXPECT_NEAR(beta[0], 9, 1e-4) << entry.name;
  }
}

/// y' = -y.
class Decay : public Ode {
 public:
  const Eigen::VectorXd& initial() const override { return start_; }
  bool derivative(double, const Eigen::VectorXd& y, Eigen::VectorXd& y_dot) override {
    y_dot = -y;
    return true;
  }

 private:
  Eigen::VectorXd start_ = Eigen::VectorXd::Ones(3);
};

TEST(Threads, EveryIntegratorSupportsSeveralAtOnce) {
  for (const IntegratorEntry& entry : integrators()) {
    at_once([&](int) {
      Decay decay;
      OdeSolution trajectory;
      const double times[] = {0, 0.5, 1};
      EXPECT_EQ(entry.make()->integrate(decay, {}, times, trajectory), Status::kReached);
      EXPECT_NEAR(trajectory.y.back()[0], std::exp(-1), 1e-5) << entry.name;
    });
  }
}

}  // namespace
}  // namespace maxwrench
