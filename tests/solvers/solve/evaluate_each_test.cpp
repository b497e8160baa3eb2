#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "maxwrench/evaluations.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "solvers/solve/format.h"
#include "solvers/solve/method.h"
#include "tests/support/refusals.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

Evaluations::Rows random_rows(const Problem& task, Eigen::Index count) {
  Random random(7);
  Evaluations::Rows rows(count, task.redundancy());
  for (Eigen::Index i = 0; i < count; ++i) rows.row(i) = random_theta_r(task, random);
  return rows;
}

void expect_row(const Evaluations& each, Eigen::Index i, const Answer& one, const char* name) {
  ASSERT_EQ(each.status[static_cast<std::size_t>(i)], one.status) << name << " row " << i;
  EXPECT_EQ(Eigen::VectorXd(each.q.row(i)), one.posture.q) << name << " row " << i;
  EXPECT_EQ(Eigen::Vector3d(each.base.row(i).head<3>()), one.posture.base.p) << name;
  EXPECT_EQ(Eigen::Vector3d(each.base.row(i).tail<3>()), rpy(one.posture.base.R)) << name;
  if (!one.has_value()) {
    EXPECT_TRUE(std::isnan(each.beta[i]));
    EXPECT_TRUE(std::isnan(each.u(i, 0)));
    return;
  }
  EXPECT_EQ(each.beta[i], one.beta()) << name << " row " << i;
  EXPECT_EQ(Eigen::VectorXd(each.u.row(i)), one.capability.u) << name << " row " << i;
  EXPECT_EQ(Eigen::VectorXd(each.h.row(i)), one.capability.h) << name << " row " << i;
  if (each.gradient.size() == 0) return;
  EXPECT_EQ(Eigen::VectorXd(each.gradient.row(i)), stacked(one.trajectory.gradient)) << name;
}

/// Each row has the numbers of a call of its own, bit for bit, at any number of threads.
TEST(EvaluateEach, EqualsSingleCalls) {
  for (const char* name : {"planar/force", "uvms/valve", "fixed/push", "dual_arm/two_arms"}) {
    const Problem task = load_problem(name);
    const Evaluations::Rows rows = random_rows(task, samples(100));
    Options options;
    options.threads = 1;
    const Evaluations one = evaluate_each(task, rows, options, true);
    options.threads = 3;
    const Evaluations three = evaluate_each(task, rows, options, true);
    EXPECT_EQ(one.gradient.rows(), rows.rows());
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      expect_row(one, i, evaluate(task, rows.row(i), options), name);
      expect_row(three, i, evaluate(task, rows.row(i), options), name);
    }
  }
}

/// Also with solvers that start where they ended, and where the efforts of an optimum are not
/// unique: the other rows do not matter.
TEST(EvaluateEach, EqualsSingleCallsWithEverySolver) {
  const Problem task = load_problem("uvms/valve");
  const Evaluations::Rows rows = random_rows(task, samples(100));
  for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
    for (const std::string& solver : supported_solvers(task, "linf_polytope", wrench)) {
      Options options;
      options.wrench = wrench;
      options.solver = solver;
      const Evaluations each = evaluate_each(task, rows, options, true);
      for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        expect_row(each, i, evaluate(task, rows.row(i), options), solver.c_str());
      }
    }
  }
}

/// A value measure calls its function 14 times n for a gradient.
TEST(EvaluateEach, ComputesGradientsOnRequestOnly) {
  const Problem task = load_problem("planar/force");
  static std::atomic<long> calls;
  add_measure({"own_counted", "", false, false, "-", [](const Problem&, auto) {
                 return make_value_measure([](const Posture& posture, const WrenchProgram&) {
                   ++calls;
                   return posture.theta_r[0];
                 });
               }});
  Options options;
  options.measure = "own_counted";
  for (const bool gradients : {false, true}) {
    calls = 0;
    const Evaluations each = evaluate_each(task, random_rows(task, 100), options, gradients);
    const long valid = std::count(each.status.begin(), each.status.end(), Status::kOptimal);
    ASSERT_GT(valid, 0);
    EXPECT_EQ(calls, valid * (gradients ? 1 + 14 * task.robot.velocities() : 1));
    EXPECT_EQ(each.gradient.rows(), gradients ? 100 : 0);
  }
}

/// From any thread, but in order, and to the end.
TEST(EvaluateEach, ReportsGrowingNumbers) {
  const Problem task = load_problem("planar/force");
  std::vector<long> seen;
  Options options;
  options.threads = 4;
  options.progress = [&seen](long rows) { seen.push_back(rows); };
  evaluate_each(task, random_rows(task, 2000), options);
  ASSERT_FALSE(seen.empty());
  for (std::size_t i = 1; i < seen.size(); ++i) EXPECT_GT(seen[i], seen[i - 1]);
  EXPECT_EQ(seen.back(), 2000);
}

TEST(EvaluateEach, OtherMeasuresAndWrenches) {
  const Problem task = load_problem("planar/force");
  const Evaluations::Rows rows = random_rows(task, 20);
  for (const auto& [measure, wrench] :
       {std::pair{"ellipsoid", Wrench::kPure}, {"l2_polytope", Wrench::kAny}}) {
    Options options;
    options.measure = measure;
    options.wrench = wrench;
    const Evaluations each = evaluate_each(task, rows, options, true);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      expect_row(each, i, evaluate(task, rows.row(i), options), measure);
    }
  }
}

TEST(EvaluateEach, NoRowsAndInterruptions) {
  const Problem task = load_problem("planar/force");
  EXPECT_EQ(evaluate_each(task, Evaluations::Rows(0, 2)).beta.size(), 0);
  std::atomic<long> asked = 0;
  Options options;
  options.interrupted = [&asked] { return ++asked > 10; };
  options.threads = 1;
  const Evaluations each = evaluate_each(task, random_rows(task, 100), options);
  EXPECT_NE(each.status[9], Status::kBudgetExhausted);
  EXPECT_EQ(each.status[10], Status::kBudgetExhausted);
  EXPECT_EQ(each.status[99], Status::kBudgetExhausted);
}

/// Postures by all joints, of which some exceed limits or collide.
TEST(EvaluateEachPosture, EqualsSingleCalls) {
  const Problem task = load_problem("fixed/push");
  Random random(3);
  Evaluations::Rows q(samples(200), static_cast<Eigen::Index>(task.robot.joints.size()));
  for (Eigen::Index j = 0; j < q.cols(); ++j) {
    const Joint& joint = task.robot.joints[static_cast<std::size_t>(j)];
    for (Eigen::Index i = 0; i < q.rows(); ++i) {
      q(i, j) = joint.q_min + random.uniform() * 1.02 * (joint.q_max - joint.q_min);
    }
  }
  for (const int threads : {1, 3}) {
    Options options;
    options.threads = threads;
    const Evaluations each = evaluate_each_posture(task, q, options);
    EXPECT_EQ(each.gradient.size(), 0);
    for (Eigen::Index i = 0; i < q.rows(); ++i) {
      expect_row(each, i, evaluate_posture(task, q.row(i), options), "joints");
    }
  }
}

TEST(EvaluateEachPosture, RejectsWhatASingleCallRejects) {
  const Problem task = load_problem("fixed/push");
  EXPECT_EQ(evaluate_each_posture(task, Evaluations::Rows(0, 7)).beta.size(), 0);
  expect_rejected("joints", [&] { evaluate_each_posture(task, Evaluations::Rows::Zero(2, 6)); });
  expect_rejected("joints", [&] { evaluate_each_posture(task, Evaluations::Rows(0, 6)); });
  expect_rejected("joints",
                  [&] { evaluate_each_posture(task, Evaluations::Rows::Constant(2, 7, NAN)); });
  Options options;
  options.measure = "magic";
  expect_rejected("measure",
                  [&] { evaluate_each_posture(task, Evaluations::Rows::Zero(2, 7), options); });
}

TEST(EvaluateEach, RejectsWhatEvaluateRejects) {
  const Problem task = load_problem("planar/force");
  EXPECT_THROW(evaluate_each(task, Evaluations::Rows::Zero(2, 3)), std::invalid_argument);
  EXPECT_THROW(evaluate_each(task, Evaluations::Rows::Constant(2, 2, NAN)), std::invalid_argument);
  EXPECT_THROW(evaluate_each(load_problem("planar/trajectory"), Evaluations::Rows::Zero(2, 2)),
               std::invalid_argument);
  Options options;
  options.threads = -1;
  EXPECT_THROW(evaluate_each(task, Evaluations::Rows::Zero(2, 2), options), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
