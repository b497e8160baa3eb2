#include "verify/model.h"

#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "solvers/certify/bound/exact_posture.h"
#include "tests/support/support.h"
#include "verify/box_forms.h"

namespace maxwrench {
namespace {

/// The project's kinematics round products of constants to double, so they may be off by that.
constexpr long double kConstants = 4e-15L;

class FormModelOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Shipped, FormModelOf,
                         testing::Values("planar/force", "uvms/lift", "uvms/valve"));

Narrow value_of(const FormModel& model, const Form& form, const Eigen::VectorXd& q) {
  return BoxForms::at_point(model.shape(), FormRow(form, model.far()), q);
}

void expect_holds(const Narrow& x, long double value) {
  EXPECT_LE(x.low, value + kConstants * (1 + std::abs(value)));
  EXPECT_GE(x.high, value - kConstants * (1 + std::abs(value)));
  EXPECT_LT(x.high - x.low, 1e-12 * (1 + x.magnitude()));
}

void expect_kinematics(const Problem& problem) {
  const FormModel model(problem);
  const std::vector<Form> tau_d = model.tau_d(), a = model.exerted(problem.c);
  ExactPosture exact(problem);
  Random random(1);
  for (int sample = 0; sample < 50; ++sample) {
    const Eigen::VectorXd q = random_theta_r(problem, random);
    exact.set(q.cast<Extended>());
    const ExtendedVector Jc = exact.J().transpose() * problem.c.cast<Extended>();
    for (std::size_t i = 0; i < tau_d.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      expect_holds(value_of(model, tau_d[i], q), exact.tau_d()[row]);
      expect_holds(value_of(model, a[i], q), Jc[row]);
    }
  }
}

TEST_P(FormModelOf, ContainsTheKinematics) { expect_kinematics(load_problem(GetParam())); }

/// J_b y = c and J_b K_i' = J_i; and what is left of tau_d when the base exerts nothing.
void expect_motions_carried(const Problem& problem) {
  const FormModel model(problem);
  const std::vector<int>& axes = problem.robot.base_axes;
  const auto b = static_cast<Eigen::Index>(axes.size());
  Random random(2);
  const Eigen::VectorXd q = random_theta_r(problem, random);
  ExactPosture exact(problem);
  exact.set(q.cast<Extended>());
  const Matrix6X<double> J = exact.J().cast<double>();
  const Eigen::VectorXd tau_d = exact.tau_d().cast<double>();
  const auto middle = [&](const Form& form) {
    const Narrow x = value_of(model, form, q);
    return (x.low + x.high) / 2;
  };
  const auto at_base = [&](const std::array<FormVector, 2>& twist) {
    Eigen::VectorXd y(b);
    for (Eigen::Index i = 0; i < b; ++i) {
      const int axis = axes[static_cast<std::size_t>(i)];
      y[i] = middle(twist[static_cast<std::size_t>(axis / 3)][static_cast<std::size_t>(axis % 3)]);
    }
    return y;
  };
  const Eigen::VectorXd y = at_base(model.carrying());
  EXPECT_LT((J.leftCols(b) * y - problem.c).norm(), 1e-13);
  EXPECT_NEAR(middle(model.weight_along_c()), -y.dot(tau_d.head(b)), 1e-12);
  for (std::size_t i = 0; i < problem.robot.joints.size(); ++i) {
    const auto joint = static_cast<Eigen::Index>(i);
    const Eigen::VectorXd K = at_base(model.screw(i));
    EXPECT_LT((J.leftCols(b) * K - J.col(b + joint)).norm(), 1e-13);
    EXPECT_NEAR(middle(model.weight_at(i)), tau_d[b + joint] - K.dot(tau_d.head(b)), 1e-12);
  }
}

TEST_P(FormModelOf, CarriesMotionsToTheBase) { expect_motions_carried(load_problem(GetParam())); }

/// Joints 2, 4 and 5 do not move the end effector, and so have no part in wrenches at it.
Problem with_side_ik_solutions(Random& random) {
  Problem problem = random_problem(random, 6);
  std::vector<Joint>& joints = problem.robot.joints;
  joints[2].parent = 1;  // on the link of joint 0
  joints[2].q_min = 0.4;
  joints[3].parent = 2;  // on that of joint 1
  joints[4].parent = 3;  // on that of joint 2
  joints[5].parent = 0;
  problem.robot.end_effectors[0].link = 4;
  problem.redundant = {0, 1, 3};
  for (Eigen::VectorXd* each :
       {&problem.theta_r_min, &problem.theta_r_max, &problem.theta_r_default}) {
    each->conservativeResize(3);
  }
  return problem;
}

TEST(FormModel, KnowsAnyTree) {
  Random random(4);
  for (int sample = 0; sample < 5; ++sample) {
    for (const Problem& problem : {random_problem(random, 4), with_side_ik_solutions(random)}) {
      expect_kinematics(problem);
      expect_motions_carried(problem);
    }
  }
}

TEST_P(FormModelOf, TurnsVectorsWithoutShrinkingThem) {
  const Problem problem = load_problem(GetParam());
  EXPECT_LT(FormModel(problem).shrinking(), 1e-14L);
}

/// In any direction, no value is beyond the control points of the box around it.
TEST_P(FormModelOf, HasItsValuesBetweenControlPoints) {
  const Problem problem = load_problem(GetParam());
  const FormModel model(problem);
  const std::vector<Form> rows = model.tau_d();
  BoxForms box(model.shape());
  Random random(3);
  for (int sample = 0; sample < 200; ++sample) {
    const Eigen::VectorXd a = random_theta_r(problem, random), b = random_theta_r(problem, random);
    const double part = random.uniform(0, 1);
    const Eigen::VectorXd from = a,
                          to = a + part * part * 2.9 * (b - a) / (b - a).cwiseAbs().maxCoeff();
    const Eigen::VectorXd lower = from.cwiseMin(to), upper = from.cwiseMax(to);
    ASSERT_TRUE(box.set(lower, upper));
    Eigen::VectorXd q = lower;
    for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = random.uniform(lower[i], upper[i]);
    std::vector<Narrow> points(static_cast<std::size_t>(model.shape().size));
    Narrow value;
    for (const Form& row : rows) {
      const double factor = random.uniform(-1, 1);
      const FormRow each(row, model.far());
      add_to(points, each, factor);
      value += factor * BoxForms::at_point(model.shape(), each, q);
    }
    box.over_box(points);
    double least = kInfinity, most = -kInfinity;
    for (const Narrow& x : points) {
      least = std::min(least, x.low);
      most = std::max(most, x.high);
    }
    EXPECT_LE(least, value.high);
    EXPECT_GE(most, value.low);
  }
}

TEST(FormModel, RejectsTasksInTime) {
  const Problem problem = load_problem("uvms/valve_trajectory");
  EXPECT_THROW(FormModel{problem}, std::invalid_argument);
}

TEST(BoxForms, RejectsHalfATurn) {
  const FormShape shape({3}, {0});
  BoxForms box(shape);
  EXPECT_TRUE(box.set(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(1, 3)));
  EXPECT_FALSE(box.set(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(1, 3.2)));
  EXPECT_FALSE(box.set(Eigen::VectorXd::Constant(1, 1e15), Eigen::VectorXd::Constant(1, 1e15 + 3)));
}

}  // namespace
}  // namespace maxwrench
