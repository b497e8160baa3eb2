#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>

#include "maxwrench/evaluations.h"
#include "maxwrench/load.h"
#include "solvers/solve/format.h"
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
  EXPECT_EQ(Eigen::VectorXd(each.gradient.row(i)), stacked(one.trajectory.gradient)) << name;
}

/// Each row has the numbers of a call of its own, bit for bit, at any number of threads.
TEST(EvaluateEach, EqualsSingleCalls) {
  for (const char* name : {"planar/force", "uvms/valve", "fixed/push", "dual_arm/two_arms"}) {
    const Problem task = load_problem(name);
    const Evaluations::Rows rows = random_rows(task, samples(100));
    Options options;
    options.threads = 1;
    const Evaluations one = evaluate_each(task, rows, options);
    options.threads = 3;
    const Evaluations three = evaluate_each(task, rows, options);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      expect_row(one, i, evaluate(task, rows.row(i), options), name);
      expect_row(three, i, evaluate(task, rows.row(i), options), name);
    }
  }
}

TEST(EvaluateEach, OtherMeasuresAndWrenches) {
  const Problem task = load_problem("planar/force");
  const Evaluations::Rows rows = random_rows(task, 20);
  for (const auto& [measure, wrench] :
       {std::pair{"ellipsoid", Wrench::kPure}, {"l2_polytope", Wrench::kAny}}) {
    Options options;
    options.measure = measure;
    options.wrench = wrench;
    const Evaluations each = evaluate_each(task, rows, options);
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
