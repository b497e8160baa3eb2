#include "verify/trajectory/trajectory_model.h"

#include <gtest/gtest.h>

#include "lib/trajectory/motion_evaluator.h"
#include "maxwrench/load.h"
#include "maxwrench/trajectory.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// The knots of the default posture plus a random motion within the limits.
Eigen::MatrixXd moving_knots(const Problem& problem, Random& random) {
  const Eigen::VectorXd start =
      problem.motion->impulse ? problem.motion->theta_0 : problem.theta_r_default;
  Eigen::MatrixXd knots = constant_knots(problem, start);
  for (double& x : knots.reshaped()) x += random.uniform(-0.3, 0.3);
  return knots;
}

/// tau_d and J'c of `lib` at a time.
struct ModelInstant {
  Eigen::VectorXd tau_d, along_c;
};

class LibModel {
 public:
  LibModel(const Problem& problem, const Eigen::MatrixXd& knots)
      : problem_(problem), Q_(all_knots(*problem.motion, knots)) {}

  /// By a spline with so many instants that one is at x of an interval.
  ModelInstant at(int interval, int part, int parts) {
    MotionEvaluator motion(problem_, make_dense_spline(*problem_.motion, parts));
    std::vector<Instant> instants;
    motion.evaluate(Q_, instants);
    const Instant& here = instants[static_cast<std::size_t>(interval * parts + part)];
    Vector6d c = problem_.c;
    if (problem_.motion->c_turns) {
      const Eigen::Matrix3d turn =
          here.end_effector.R * instants.front().end_effector.R.transpose();
      c << turn * problem_.c.head<3>(), turn * problem_.c.tail<3>();
    }
    return {here.tau_d, here.J.transpose() * c};
  }

 private:
  const Problem& problem_;
  Eigen::MatrixXd Q_;
};

void expect_holds(const Narrow& interval, double x, double rounding, const char* what) {
  EXPECT_LE(interval.low - rounding, x) << what;
  EXPECT_GE(interval.high + rounding, x) << what;
}

constexpr const char* kProvable[] = {"planar/trajectory",   "uvms/valve_trajectory",
                                     "uvms/jet_trajectory", "uvms/valve_impulse",
                                     "uvms/lift_impulse",   "uvms/valve_trajectory_fast"};

/// The dynamics of `lib` work with recursions of twists in base axes, these with rates of momentum
/// in the world. On a slice, the quadratic with f_0 and f_1 at the middle and f_2 over the slice
/// must hold the values of `lib` at other instants of the slice.
TEST(TrajectoryModel, HoldsTheLoadsOfTheOtherDynamics) {
  Random random(1);
  for (const char* name : kProvable) {
    Problem problem = load_problem(name);
    const bool floats = problem.robot.base_axes.size() == 6;
    if (floats) problem.robot.current = {0.2, -0.3, 0.1};
    const Eigen::MatrixXd knots = moving_knots(problem, random);
    const TrajectoryModel model(problem, knots);
    LibModel lib(problem, knots);
    const int parts = 24, intervals = model.curve().intervals();
    const double H = problem.motion->T / intervals;
    for (int sample = 0; sample < 12; ++sample) {
      const int interval = sample % intervals, first = 4 * (sample % 6);
      const double from = first / 24.0, to = (first + 4) / 24.0, middle = (from + to) / 2;
      const MotionLoads<1> at = model.loads<3>(interval, Narrow(middle));
      const MotionLoads<2> over = model.loads<4>(interval, Narrow(from, to));
      for (int part = first; part <= first + 4; ++part) {
        if (problem.motion->impulse && interval == 0 && part == 0) continue;  // at rest there
        const ModelInstant expected = lib.at(interval, part, parts);
        const Narrow s = Narrow((part / 24.0 - middle) * H);
        for (Eigen::Index i = 0; i < expected.tau_d.size(); ++i) {
          const auto row = static_cast<std::size_t>(i);
          const auto value = [&](const Jet<1>& y, const Jet<2>& y_over) {
            return y.c[0] + s * (y.c[1] + s * y_over.c[2]);
          };
          expect_holds(value(at.tau_d[row], over.tau_d[row]), expected.tau_d[i], 1e-9, name);
          expect_holds(value(at.along_c[row], over.along_c[row]), expected.along_c[i], 1e-12, name);
          expect_holds(over.tau_d[row].c[0], expected.tau_d[i], 1e-9, name);
          if (2 * part == 2 * first + 4) {  // at the middle it is tight
            EXPECT_NEAR(at.tau_d[row].c[0].low, expected.tau_d[i], 1e-8) << name;
            EXPECT_NEAR(at.tau_d[row].c[0].high, expected.tau_d[i], 1e-8) << name;
          }
        }
      }
    }
  }
}

/// A planar vehicle that tilts is off its axes: the path turns about x.
TEST(TrajectoryModel, KnowsTheFreeAxes) {
  Problem problem = load_problem("planar/trajectory");
  const Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
  for (const Jet<1>& off : TrajectoryModel(problem, knots).loads<3>(1, Narrow(0.5)).off_axes) {
    EXPECT_LT(off.c[0].magnitude(), 1e-12);
  }
  problem.motion->path = Path::screw(problem.pose, Eigen::Vector3d::UnitX(), problem.pose.p, 0.1,
                                     Eigen::Vector3d::Zero(), Timing::kCubic, problem.motion->T);
  double most = 0;
  for (const Jet<1>& off : TrajectoryModel(problem, knots).loads<3>(6, Narrow(1.0)).off_axes) {
    most = std::max(most, off.c[0].magnitude());
  }
  EXPECT_NEAR(most, std::sin(0.1), 0.02);
}

TEST(TrajectoryModel, RejectsOtherTasks) {
  for (const char* name : {"planar/force", "mobile/trajectory"}) {
    EXPECT_THROW(require_provable(load_problem(name)), std::invalid_argument) << name;
  }
  Problem problem = load_problem("planar/trajectory");
  problem.motion->path = Path::spline({0, 5, 10}, {problem.pose, problem.pose, problem.pose});
  EXPECT_THROW(require_provable(problem), std::invalid_argument);
  problem = load_problem("planar/trajectory");
  EXPECT_NO_THROW(require_provable(problem));
  problem.motion->payload = CarriedBody();
  EXPECT_THROW(require_provable(problem), std::invalid_argument);
  problem.motion->payload.reset();
  problem.motion->table = WrenchTable();
  EXPECT_THROW(require_provable(problem), std::invalid_argument);
  problem.motion->table.reset();
  problem.motion->transfer = true;
  EXPECT_THROW(require_provable(problem), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
