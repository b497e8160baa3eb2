#include "solvers/search/joint_program.h"

#include <gtest/gtest.h>

#include "lib/math/random.h"
#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"

namespace maxwrench {
namespace {

struct Setting {
  const char* problem;
  Scheme scheme;
  Wrench wrench;
};

class JointProgramOf : public testing::TestWithParam<Setting> {
 protected:
  JointProgramOf() : problem_(load_problem(GetParam().problem)) {
    problem_.motion->scheme = GetParam().scheme;
    trajectories_ = std::make_unique<TrajectoryEvaluator>(
        problem_, GetParam().wrench, find_trajectory_solver("ipm").make, false);
    const Eigen::MatrixXd knots =
        problem_.theta_r_default.transpose().replicate(trajectories_->knots(), 1);
    value_ = trajectories_->evaluate_elastic(knots, nullptr);
    const auto limits = [&](const Eigen::VectorXd& limit) -> Eigen::VectorXd {
      return limit.replicate(trajectories_->knots(), 1);
    };
    program_ = std::make_unique<JointProgram>(*trajectories_, limits(problem_.theta_r_min),
                                              limits(problem_.theta_r_max));
  }

  Problem problem_;
  std::unique_ptr<TrajectoryEvaluator> trajectories_;
  std::unique_ptr<JointProgram> program_;
  double value_ = 0;
};
INSTANTIATE_TEST_SUITE_P(
    Tasks, JointProgramOf,
    testing::Values(Setting{"planar/trajectory", Scheme::kSpline, Wrench::kPure},
                    Setting{"uvms/valve_trajectory", Scheme::kSpline, Wrench::kPure},
                    Setting{"uvms/valve_trajectory", Scheme::kEnds, Wrench::kAny},
                    Setting{"mobile/trajectory", Scheme::kSpline, Wrench::kPure},
                    Setting{"mobile/trajectory", Scheme::kEnds, Wrench::kAny},
                    Setting{"uvms/valve_impulse", Scheme::kSpline, Wrench::kPure},
                    Setting{"uvms/valve_impulse", Scheme::kBackward, Wrench::kPure}));

/// The answer of the lower level keeps all rows and limits, and the objective is its value.
TEST_P(JointProgramOf, BeginsAtTheTrajectory) {
  const Eigen::VectorXd& X = program_->start();
  EXPECT_NEAR(program_->objective().dot(X), value_, 1e-7);
  constexpr double kRounding = 1e-6;
  EXPECT_LE((program_->rows() - program_->row_max()).maxCoeff(), kRounding);
  EXPECT_LE((program_->row_min() - program_->rows()).maxCoeff(), kRounding);
  EXPECT_LE((X - program_->upper()).maxCoeff(), kRounding);
  EXPECT_LE((program_->lower() - X).maxCoeff(), kRounding);
}

TEST_P(JointProgramOf, DerivativeAgreesWithCentralDifferences) {
  Random random(1);
  Eigen::VectorXd X = program_->start();
  for (double& value : X) value += random.uniform(-0.01, 0.01);
  program_->evaluate(X);
  const Eigen::SparseMatrix<double> jacobian = program_->jacobian();
  for (int sample = 0; sample < 20; ++sample) {
    Eigen::VectorXd direction(X.size());
    for (double& value : direction) value = random.uniform(-1, 1);
    constexpr double kStep = 1e-5;
    program_->evaluate(X + kStep * direction);
    const Eigen::VectorXd ahead = program_->rows();
    program_->evaluate(X - kStep * direction);
    const Eigen::VectorXd slope = (ahead - program_->rows()) / (2 * kStep);
    const Eigen::VectorXd exact = jacobian * direction;
    EXPECT_LE((slope - exact).lpNorm<Eigen::Infinity>(),
              1e-6 * (1 + exact.lpNorm<Eigen::Infinity>()));
  }
}

}  // namespace
}  // namespace maxwrench
