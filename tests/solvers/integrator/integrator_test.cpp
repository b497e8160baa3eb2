#include "maxwrench/integrator.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "maxwrench/strategies.h"
#include "tests/support/refusals.h"

namespace maxwrench {
namespace {

/// A problem from functions; counts the evaluations.
class Given : public Ode {
 public:
  using Function = std::function<Eigen::VectorXd(double, const Eigen::VectorXd&)>;

  Given(Eigen::VectorXd start, Function f) : start_(std::move(start)), f_(std::move(f)) {}
  const Eigen::VectorXd& initial() const override { return start_; }
  bool derivative(double t, const Eigen::VectorXd& y, Eigen::VectorXd& y_dot) override {
    ++evaluations;
    y_dot = f_(t, y);
    return y_dot.allFinite();
  }
  bool jacobian(double, const Eigen::VectorXd&, Eigen::MatrixXd& df_dy) override {
    ++jacobians;
    df_dy = jacobian_matrix;
    return df_dy.size() > 0;
  }
  int roots() const override { return static_cast<int>(levels.size()); }
  void root(double, const Eigen::VectorXd& y, Eigen::VectorXd& g) override {
    for (Eigen::Index i = 0; i < levels.size(); ++i) g[i] = y[0] - levels[i];
  }

  long evaluations = 0, jacobians = 0;
  Eigen::MatrixXd jacobian_matrix;  ///< constant, empty: none
  Eigen::VectorXd levels;           ///< of y_0 where the integration ends

 private:
  Eigen::VectorXd start_;
  Function f_;
};

Eigen::VectorXd one(double value) { return Eigen::VectorXd::Constant(1, value); }
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class IntegratorTest : public testing::TestWithParam<IntegratorEntry> {
 protected:
  Status integrate(Ode& ode, std::initializer_list<double> times) {
    return GetParam().make()->integrate(ode, options, std::vector<double>(times), trajectory);
  }
  IntegratorOptions options;
  OdeSolution trajectory;
};

INSTANTIATE_TEST_SUITE_P(All, IntegratorTest,
                         testing::ValuesIn(integrators().begin(), integrators().end()),
                         [](const auto& each) { return std::string(each.param.name); });

TEST_P(IntegratorTest, FollowsALinearSystemToAllTimes) {
  // y'' = -y from (1, 0): y = (cos t, -sin t).
  Given circle(Eigen::Vector2d(1, 0),
               [](double, const auto& y) { return Eigen::Vector2d(y[1], -y[0]); });
  ASSERT_EQ(integrate(circle, {0, 0.5, 1, 10}), Status::kReached) << trajectory.reason.c_str();
  ASSERT_EQ(trajectory.t, (std::vector<double>{0, 0.5, 1, 10}));
  for (std::size_t i = 0; i < 4; ++i) {
    const double t = trajectory.t[i];
    EXPECT_NEAR(trajectory.y[i][0], std::cos(t), 1e-5);
    EXPECT_NEAR(trajectory.y[i][1], -std::sin(t), 1e-5);
  }
  EXPECT_EQ(trajectory.root, -1);
}

TEST_P(IntegratorTest, DependsOnTimeAndStartsWhereItIsTold) {
  // y' = 2 t from y(3) = 9: y = t^2.
  Given square(one(9), [](double t, const auto&) { return one(2 * t); });
  ASSERT_EQ(integrate(square, {3, 5}), Status::kReached);
  EXPECT_NEAR(trajectory.y.back()[0], 25, 1e-5);
}

TEST_P(IntegratorTest, TightensWithTheTolerance) {
  // The logistic curve y' = y (1 - y) from 1/2: y = 1/(1 + exp(-t)).
  const double exact = 1 / (1 + std::exp(-4.0));
  for (const double tolerance : {1e-4, 1e-7, 1e-10}) {
    Given logistic(one(0.5), [](double, const auto& y) { return one(y[0] * (1 - y[0])); });
    options.relative_tolerance = options.absolute_tolerance = tolerance;
    ASSERT_EQ(integrate(logistic, {0, 4}), Status::kReached);
    EXPECT_NEAR(trajectory.y.back()[0], exact, 100 * tolerance);
  }
}

TEST_P(IntegratorTest, StiffSystemsTakeFewEvaluations) {
  if (!GetParam().stiff) GTEST_SKIP() << "not made for stiff systems";
  // y' = -1e5 (y - cos t) falls onto cos t at once; an explicit rule would need 1e5 steps.
  const auto f = [](double t, const Eigen::VectorXd& y) {
    return one(-1e5 * (y[0] - std::cos(t)));
  };
  Given plain(one(0), f), helped(one(0), f);
  helped.jacobian_matrix = Eigen::MatrixXd::Constant(1, 1, -1e5);
  for (Given* stiff : {&plain, &helped}) {
    ASSERT_EQ(integrate(*stiff, {0, 2}), Status::kReached);
    EXPECT_NEAR(trajectory.y.back()[0], std::cos(2.0), 1e-4);
    EXPECT_LT(stiff->evaluations, 3000);
  }
  if (GetParam().name == std::string("cvode")) {
    EXPECT_GT(helped.jacobians, 0);
  }
}

TEST_P(IntegratorTest, EndsAtARoot) {
  // y = 2 - t passes 1.5 at t = 0.5; the level 9 is never met.
  Given falling(one(2), [](double, const auto&) { return one(-1); });
  falling.levels = Eigen::Vector2d(9, 1.5);
  ASSERT_EQ(integrate(falling, {0, 0.25, 3}), Status::kReached);
  EXPECT_EQ(trajectory.root, 1);
  ASSERT_EQ(trajectory.t.size(), 3U);
  EXPECT_NEAR(trajectory.t.back(), 0.5, 1e-9);
  EXPECT_NEAR(trajectory.y.back()[0], 1.5, 1e-9);
}

TEST_P(IntegratorTest, LeavesARootWhereItBegins) {
  // y = 2 + t leaves 2 at once and passes 2.5 at t = 0.5.
  Given rising(one(2), [](double, const auto&) { return one(1); });
  rising.levels = Eigen::Vector2d(2, 2.5);
  ASSERT_EQ(integrate(rising, {0, 0.25, 3}), Status::kReached);
  EXPECT_EQ(trajectory.root, 1);
  EXPECT_NEAR(trajectory.t.back(), 0.5, 1e-9);
}

TEST_P(IntegratorTest, EndsWhereThereIsNoValue) {
  // y' = 1, but beyond y = 1 there is none.
  Given wall(one(0), [](double, const auto& y) { return one(y[0] > 1 ? kNan : 1); });
  EXPECT_NE(integrate(wall, {0, 0.5, 3}), Status::kReached);  // some try until no step is left
  EXPECT_FALSE(trajectory.reason.empty());
  EXPECT_LE(trajectory.y.back()[0], 1 + 1e-9);
  if (GetParam().name != std::string("arkode")) {  // which does not try a shorter step
    EXPECT_GE(trajectory.t.back(), 0.5 - 1e-9);
  }
  EXPECT_NEAR(trajectory.y.back()[0], trajectory.t.back(), 1e-9);
  Given nowhere(one(0), [](double, const auto&) { return one(kNan); });
  EXPECT_EQ(integrate(nowhere, {0, 1}), Status::kNumericalError);
  EXPECT_FALSE(trajectory.reason.empty());
  EXPECT_EQ(trajectory.t, (std::vector<double>{0}));
}

TEST_P(IntegratorTest, EndsWithItsSteps) {
  Given fast(Eigen::Vector2d(1, 0),
             [](double, const auto& y) { return Eigen::Vector2d(1e3 * y[1], -1e3 * y[0]); });
  options.max_steps = 50;
  EXPECT_EQ(integrate(fast, {0, 0.001, 100}), Status::kBudgetExhausted);
  EXPECT_FALSE(trajectory.reason.empty());
  EXPECT_LT(trajectory.t.back(), 100);
}

/// Grows at unit speed from zero and throws in one of its functions once it is past 0.5.
class Thrower : public Ode {
 public:
  enum class In { kDerivative, kJacobian, kRootFunction };
  explicit Thrower(In in) : in_(in) {}
  const Eigen::VectorXd& initial() const override { return start_; }
  bool derivative(double, const Eigen::VectorXd& y, Eigen::VectorXd& y_dot) override {
    check(In::kDerivative, y);
    y_dot = one(1);
    return true;
  }
  bool jacobian(double, const Eigen::VectorXd& y, Eigen::MatrixXd& df_dy) override {
    if (calls_++ > 0) check(In::kJacobian, one(1));
    df_dy.setZero(y.size(), y.size());
    return true;
  }
  int roots() const override { return 1; }
  void root(double, const Eigen::VectorXd& y, Eigen::VectorXd& g) override {
    check(In::kRootFunction, y);
    g[0] = 2 - y[0];
  }

 private:
  void check(In in, const Eigen::VectorXd& y) const {
    if (in == in_ && y[0] > 0.5) throw std::domain_error("past one half");
  }
  In in_;
  Eigen::VectorXd start_ = one(0);
  int calls_ = 0;  // of the Jacobian: the first one asks whether there is any
};

TEST_P(IntegratorTest, ExceptionsPassThrough) {
  for (const auto in : {Thrower::In::kDerivative, Thrower::In::kRootFunction}) {
    Thrower ode(in);
    EXPECT_THROW(integrate(ode, {0, 1}), std::domain_error);
  }
  Thrower ode(Thrower::In::kJacobian);
  if (std::string_view(GetParam().name) == "cvode") {  // alone uses it
    EXPECT_THROW(integrate(ode, {0, 1}), std::domain_error);
  } else {
    EXPECT_EQ(integrate(ode, {0, 1}), Status::kReached);
  }
}

TEST_P(IntegratorTest, RejectsTimesThatDoNotIncrease) {
  Given still(one(0), [](double, const auto&) { return one(0); });
  EXPECT_THROW(integrate(still, {0}), std::invalid_argument);
  EXPECT_THROW(integrate(still, {0, 0}), std::invalid_argument);
  EXPECT_THROW(integrate(still, {0, 1, 0.5}), std::invalid_argument);
}

TEST_P(IntegratorTest, RejectsOptionsOfNoIntegration) {
  Given still(one(0), [](double, const auto&) { return one(0); });
  for (double IntegratorOptions::*option :
       {&IntegratorOptions::relative_tolerance, &IntegratorOptions::absolute_tolerance,
        &IntegratorOptions::step}) {
    for (const double value : {-1.0, kNan, kInfinity}) {
      options = {};
      options.*option = value;
      expect_rejected("integrator ", [&] { integrate(still, {0, 1}); });
    }
  }
  options = {};
  options.max_steps = 0;
  expect_rejected("integrator max_steps", [&] { integrate(still, {0, 1}); });
}

TEST(Ode, ResidualIsThatOfTheExplicitForm) {
  Given square(one(2), [](double t, const auto& y) { return one(t * y[0]); });
  Eigen::VectorXd F;
  ASSERT_TRUE(square.residual(3, one(2), one(10), F));
  EXPECT_EQ(F, one(4));  // 10 - 3 * 2
}

}  // namespace
}  // namespace maxwrench
