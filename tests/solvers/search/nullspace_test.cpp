#include <gtest/gtest.h>

#include <cmath>

#include "lib/posture/redundancy.h"
#include "lib/robot/kinematics.h"
#include "maxwrench/load.h"
#include "maxwrench/measure.h"
#include "maxwrench/wrench_program.h"
#include "solvers/integrator/makers.h"
#include "solvers/search/makers.h"
#include "solvers/solve/method.h"
#include "tests/support/known.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using Eigen::Vector2d;

std::unique_ptr<Objective> objective_of(const Problem& problem, const char* measure) {
  const Case c{problem.name, measure, Wrench::kPure};
  return make_capability_objective(problem, c.wrench, resolve(problem, c).make_measure);
}

/// eq:NullSpace in full coordinates: y = [theta_r; base position; base rotation by columns] follows
/// theta_dot = A_r (A_r'A_r)^-1 d f/d theta_r, the base by integrating its twist in base axes.
class FullFlow : public Ode {
 public:
  FullFlow(const Problem& problem, Objective& objective)
      : problem_(problem), objective_(objective), model_(problem), y_(problem.redundancy() + 12) {
    const Posture& posture = model_.evaluate(problem.theta_r_default);
    y_ << problem.theta_r_default, posture.base.p, posture.base.R.reshaped();
  }
  const Eigen::VectorXd& initial() const override { return y_; }
  bool derivative(double, const Eigen::VectorXd& y, Eigen::VectorXd& y_dot) override {
    const Eigen::VectorXd theta_r = y.head(problem_.redundancy());
    Eigen::VectorXd gradient;
    if (objective_.evaluate(theta_r, &gradient) == -kInfinity) return false;
    Eigen::MatrixXd A_r;
    null_motion(problem_, model_.evaluate(theta_r), A_r);
    const Eigen::VectorXd theta_r_dot = (A_r.transpose() * A_r).ldlt().solve(gradient);
    Vector6d twist = Vector6d::Zero();
    const std::vector<int>& axes = problem_.robot.base_axes;
    for (std::size_t i = 0; i < axes.size(); ++i)
      twist[axes[i]] = A_r.row(static_cast<Eigen::Index>(i)).dot(theta_r_dot);
    const Eigen::Matrix3d R = y.tail<9>().reshaped(3, 3);
    Eigen::Matrix3d R_dot;
    for (int i = 0; i < 3; ++i) R_dot.col(i) = R * twist.tail<3>().cross(Eigen::Vector3d::Unit(i));
    y_dot.resize(y.size());
    y_dot << theta_r_dot, R * twist.head<3>(), R_dot.reshaped();
    return true;
  }
  /// The end effector by forward kinematics from the integrated base.
  Pose<double> end_effector(const Eigen::VectorXd& y) {
    const Posture& posture = model_.evaluate(y.head(problem_.redundancy()));
    const EndEffector& e = problem_.robot.end_effectors[problem_.end_effector];
    const Pose<double> base{y.tail<9>().reshaped(3, 3), y.segment<3>(problem_.redundancy())};
    return base * posture.links[e.link] * e.placement;
  }

 private:
  const Problem& problem_;
  Objective& objective_;
  PostureEvaluator model_;
  Eigen::VectorXd y_;
};

TEST(Nullspace, SLOW_FlowKeepsTheEndEffectorAndRaisesBeta) {
  for (const char* name : {"planar/force", "uvms/valve", "uvms/lift"}) {
    SCOPED_TRACE(name);
    const Problem problem = load_problem(name);
    const auto objective = objective_of(problem, "ellipsoid");  // smooth
    FullFlow flow(problem, *objective);
    Eigen::VectorXd v;
    ASSERT_TRUE(flow.derivative(0, flow.initial(), v));
    const double unit = 0.05 / v.head(problem.redundancy()).norm();
    OdeSolution trajectory;
    make_cvode()->integrate(flow, {}, std::array{0.0, unit, 2 * unit, 3 * unit, 4 * unit},
                            trajectory);
    ASSERT_GE(trajectory.y.size(), 3U) << trajectory.reason.c_str();
    double beta = -kInfinity;
    for (const Eigen::VectorXd& y : trajectory.y) {
      const double next = objective->evaluate(y.head(problem.redundancy()));
      if (next == -kInfinity && trajectory.status != Status::kReached) {
        // The flow ended at a collision. CVODE corrects a state once more after it has seen its
        // derivative, so the last one may lie just behind; shortly before it beta has risen.
        ASSERT_EQ(&y, &trajectory.y.back());
        const Eigen::VectorXd before = *(&y - 1);
        EXPECT_GT(objective->evaluate((before + 0.99 * (y - before)).head(problem.redundancy())),
                  beta);
        break;
      }
      EXPECT_GT(next, beta);
      beta = next;
      const Pose<double> tool = flow.end_effector(y);
      EXPECT_LT((tool.p - problem.pose.p).norm(), 1e-5);
      EXPECT_LT((tool.R - problem.pose.R).norm(), 1e-5);
    }
  }
}

/// A measure that counts what it evaluates.
class Counting : public Measure {
 public:
  Counting(std::unique_ptr<Measure> measure, long& count)
      : measure_(std::move(measure)), count_(count) {}
  void evaluate_well_formed(const Posture& posture, const WrenchProgram& program, bool efforts,
                            Capability& capability) override {
    ++count_;
    measure_->evaluate(posture, program, efforts, capability);
  }

 private:
  std::unique_ptr<Measure> measure_;
  long& count_;
};

TEST(Nullspace, BudgetCountsAllEvaluations) {
  // The robot has one IK solution and no posture is invalid: the measure is asked once an
  // evaluation.
  const Problem problem = load_problem("planar/force");
  const Case c{problem.name, "ellipsoid", Wrench::kPure};
  long count = 0;
  const MeasureMaker make = resolve(problem, c).make_measure;
  const MeasureMaker counting = [&]() -> std::unique_ptr<Measure> {
    return std::make_unique<Counting>(make(), count);
  };
  const auto objective = make_capability_objective(problem, c.wrench, counting, false);
  Eigen::MatrixXd M;
  objective->evaluate(problem.theta_r_default);
  objective->metric(problem.theta_r_default, M);
  EXPECT_EQ(count, 1);
  objective->metric(problem.theta_r_default + Eigen::VectorXd::Constant(M.rows(), 0.1), M);
  EXPECT_EQ(count, 2);
  count = 0;
  SearchOptions options;
  options.start = problem.theta_r_default;
  const SearchResult result = make_nullspace()->maximize(*objective, options);
  EXPECT_EQ(count, result.evaluations);
  EXPECT_GT(count, 10);
}

TEST(Nullspace, EndsWhereTheSmoothMeasureIsStationary) {
  const Problem problem = load_problem("planar/force");
  const auto objective = objective_of(problem, "ellipsoid");
  SearchOptions options;
  options.start = problem.theta_r_default;
  const SearchResult result = make_nullspace()->maximize(*objective, options);
  ASSERT_EQ(result.status, Status::kBestFound);
  EXPECT_GT(result.value, objective->evaluate(problem.theta_r_default));
  Eigen::VectorXd gradient;
  objective->evaluate(result.theta_r, &gradient);
  for (int i = 0; i < gradient.size(); ++i) {
    const bool at_upper = result.theta_r[i] == problem.theta_r_max[i] && gradient[i] > 0;
    const bool at_lower = result.theta_r[i] == problem.theta_r_min[i] && gradient[i] < 0;
    if (at_upper || at_lower) continue;
    EXPECT_NEAR(gradient[i], 0, 1e-3);
  }
}

TEST(Nullspace, SlidesAlongBoundsAndLeavesThem) {
  // Uphill to (1, 0.2) from (-1, -1): first against x1 = 0, which the pull of x0 - 1 then leaves.
  Known valley(
      [](const Eigen::VectorXd& x) {
        return -std::pow(x[0] - 1, 2) - 4 * std::pow(x[1] - 0.6 * x[0] + 0.4, 2);
      },
      Vector2d(-1, 0), Vector2d(2, 1));
  SearchOptions options;
  options.start = Vector2d(-1, 0.5);
  const SearchResult result = make_nullspace()->maximize(valley, options);
  EXPECT_NEAR(result.value, 0, 1e-6);
  EXPECT_LT((result.theta_r - Vector2d(1, 0.2)).norm(), 1e-3);
  // A corner.
  Known slope([](const Eigen::VectorXd& x) { return x[0] - 2 * x[1]; }, Vector2d(-1, -1),
              Vector2d(3, 1));
  EXPECT_EQ(make_nullspace()->maximize(slope, {}).theta_r, Vector2d(3, -1));
}

TEST(Nullspace, StopsAtPosturesWithoutAValue) {
  Known cliff([](const Eigen::VectorXd& x) { return x[0] > 0.5 ? -kInfinity : x[0]; },
              Eigen::VectorXd::Constant(1, -1), Eigen::VectorXd::Constant(1, 1));
  const SearchResult result = make_nullspace()->maximize(cliff, {});
  EXPECT_EQ(result.status, Status::kBestFound);
  EXPECT_LE(result.value, 0.5);
  EXPECT_GT(result.value, 0.4);
}

TEST(Nullspace, OtherSeedsStartElsewhere) {
  // Two hills; the start lies on the lower one.
  Known multimodal(
      [](const Eigen::VectorXd& x) {
        return std::exp(-std::pow(x[0] + 1, 2) * 4) + 2 * std::exp(-std::pow(x[0] - 1, 2) * 4);
      },
      Eigen::VectorXd::Constant(1, -2), Eigen::VectorXd::Constant(1, 2));
  SearchOptions options;
  options.start = Eigen::VectorXd::Constant(1, -0.9);
  EXPECT_NEAR(make_nullspace()->maximize(multimodal, options).value, 1, 1e-3);
  int found = 0;
  for (options.seed = 2; options.seed <= 11; ++options.seed)
    found += make_nullspace()->maximize(multimodal, options).value > 1.99 ? 1 : 0;
  EXPECT_GE(found, 2);
  EXPECT_LE(found, 8);
}

}  // namespace
}  // namespace maxwrench
