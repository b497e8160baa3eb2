#include "verify/trajectory/trajectory_model.h"

#include <gtest/gtest.h>

#include "lib/trajectory/motion_evaluator.h"
#include "maxwrench/load.h"
#include "maxwrench/trajectory.h"
#include "solvers/certify/trajectory/edge_program.h"
#include "tests/support/support.h"
#include "verify/trajectory/provable.h"

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

constexpr const char* kProvable[] = {
    "planar/trajectory", "uvms/valve_trajectory",      "uvms/jet_trajectory", "uvms/valve_impulse",
    "uvms/lift_impulse", "uvms/valve_trajectory_fast", "mobile/trajectory"};

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
    const TrajectoryModel model(problem, knots, dependent_places(problem, knots));
    ASSERT_EQ(model.lost().reason, "") << name;
    LibModel lib(problem, knots);
    const int parts = 24, intervals = model.curve().intervals();
    const double H = problem.motion->T / intervals;
    // Dependent joints are enclosed on narrower slices only, and not on each of these.
    const int wide = problem.dependent.empty() ? 4 : 2;
    int open = 0;
    for (int sample = 0; sample < 12; ++sample) {
      const int interval = sample % intervals, first = 4 * (sample % 6);
      const double from = first / 24.0, to = (first + wide) / 24.0, middle = (from + to) / 2;
      const MotionLoads<1> at = model.loads<3>(interval, Narrow(middle)).value();
      const std::optional<MotionLoads<2>> on_slice = model.loads<4>(interval, Narrow(from, to));
      if (!on_slice) ++open;
      if (!on_slice) continue;
      const MotionLoads<2>& over = *on_slice;
      for (int part = first; part <= first + wide; ++part) {
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
          if (2 * part == 2 * first + wide) {  // at the middle it is tight
            // Rates of dependent joints have the rounding of several matrices in turn.
            const double rounding = problem.dependent.empty() ? 1e-8 : 1e-6;
            EXPECT_NEAR(at.tau_d[row].c[0].low, expected.tau_d[i], rounding) << name;
            EXPECT_NEAR(at.tau_d[row].c[0].high, expected.tau_d[i], rounding) << name;
          }
        }
      }
    }
    EXPECT_LE(open, problem.dependent.empty() ? 0 : 6) << name;
  }
}

/// A planar vehicle that tilts is off its axes: the path turns about x.
TEST(TrajectoryModel, KnowsTheFreeAxes) {
  Problem problem = load_problem("planar/trajectory");
  const Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
  const auto at_rest = TrajectoryModel(problem, knots).loads<3>(1, Narrow(0.5)).value();
  for (const Jet<1>& off : at_rest.off_axes) {
    EXPECT_LT(off.c[0].magnitude(), 1e-12);
  }
  problem.motion->path = Path::screw(problem.pose, Eigen::Vector3d::UnitX(), problem.pose.p, 0.1,
                                     Eigen::Vector3d::Zero(), Timing::kCubic, problem.motion->T);
  double most = 0;
  const auto turned = TrajectoryModel(problem, knots).loads<3>(6, Narrow(1.0)).value();
  for (const Jet<1>& off : turned.off_axes) {
    most = std::max(most, off.c[0].magnitude());
  }
  EXPECT_NEAR(most, std::sin(0.1), 0.02);
}

/// The positions and rates of the dependent joints hold those of `lib` at other instants of a
/// slice, and are tight at a point.
TEST(TrajectoryModel, EnclosesDependentJoints) {
  const Problem problem = load_problem("mobile/trajectory");
  Random random(4);
  const Eigen::MatrixXd knots = moving_knots(problem, random);
  const TrajectoryModel model(problem, knots, dependent_places(problem, knots));
  ASSERT_EQ(model.lost().reason, "");
  const int parts = 24;
  const auto axes = static_cast<Eigen::Index>(problem.robot.base_axes.size());
  MotionEvaluator motion(problem, make_dense_spline(*problem.motion, parts));
  std::vector<Instant> instants;
  motion.evaluate(all_knots(*problem.motion, knots), instants);
  int open = 0;
  for (int interval = 0; interval < model.curve().intervals(); ++interval) {
    for (int part = 0; part <= parts; ++part) {
      const Instant& here = instants[static_cast<std::size_t>(interval * parts + part)];
      const double x = part / double{parts};
      const std::vector<Jet<3>> at = model.dependent(interval, Narrow(x)).value();
      const Narrow around(std::max(0.0, x - 0.01), std::min(1.0, x + 0.02));
      const std::optional<std::vector<Jet<3>>> on_slice = model.dependent(interval, around);
      if (!on_slice) ++open;
      if (!on_slice) continue;
      const std::vector<Jet<3>>& over = *on_slice;
      for (std::size_t k = 0; k < problem.dependent.size(); ++k) {
        const Eigen::Index joint = problem.dependent[k];
        expect_holds(over[k].c[0], here.q[joint], 1e-11, "position");
        expect_holds(over[k].c[1], here.v[axes + joint], 1e-11, "rate");
        expect_holds(over[k].c[2], here.v_dot[axes + joint] / 2, 1e-9, "bend");
        EXPECT_NEAR(at[k].c[0].low, here.q[joint], 1e-10);
        EXPECT_NEAR(at[k].c[0].high, here.q[joint], 1e-10);
        EXPECT_NEAR(at[k].c[1].high, here.v[axes + joint], 1e-9);
        EXPECT_LT(over[k].c[0].high - over[k].c[0].low, 0.1);
      }
    }
  }
  EXPECT_LE(open, model.curve().intervals() * parts / 20);
}

/// Dependent joints that rest, whose boxes in time are as narrow as they begin.
TEST(TrajectoryModel, EnclosesDependentJointsAtRest) {
  const Problem problem = load_problem(MAXWRENCH_SOURCE_DIR "/examples/tasks/rover_impulse.toml");
  const Eigen::MatrixXd knots = constant_knots(problem, problem.motion->theta_0);
  const Eigen::MatrixXd places = dependent_places(problem, knots);
  const TrajectoryModel model(problem, knots, places);
  EXPECT_EQ(model.lost().reason, "");
  const std::vector<double> moved = model.moved_from_middle(0, 0, 1);
  for (const int joint : problem.dependent) EXPECT_LT(moved[static_cast<std::size_t>(joint)], 1e-9);
}

/// Between two places, no joint is farther from the middle than it may be.
TEST(TrajectoryModel, KnowsHowFarJointsMove) {
  const Problem problem = load_problem("mobile/trajectory");
  Random random(6);
  const Eigen::MatrixXd knots = moving_knots(problem, random);
  const TrajectoryModel model(problem, knots, dependent_places(problem, knots));
  ASSERT_EQ(model.lost().reason, "");
  MotionEvaluator motion(problem, make_dense_spline(*problem.motion, 24));
  std::vector<Instant> instants;
  motion.evaluate(all_knots(*problem.motion, knots), instants);
  double most = 0;
  for (int interval = 0; interval < model.curve().intervals(); ++interval) {
    const std::vector<double> moved = model.moved_from_middle(interval, 0.25, 0.5);
    const Instant& middle = instants[static_cast<std::size_t>(interval * 24 + 9)];
    for (int part = 6; part <= 12; ++part) {
      const Instant& here = instants[static_cast<std::size_t>(interval * 24 + part)];
      for (std::size_t joint = 0; joint < moved.size(); ++joint) {
        const double from = middle.q[static_cast<Eigen::Index>(joint)];
        const double to = here.q[static_cast<Eigen::Index>(joint)];
        EXPECT_LE(std::abs(to - from), moved[joint] + 1e-11) << joint;
        most = std::max(most, std::abs(to - from));
      }
    }
  }
  EXPECT_GT(most, 1e-3);
}

/// No tube: places of another size, not numbers, or a pose that the arm does not reach.
TEST(TrajectoryModel, LosesDependentJointsThatHaveNoSolution) {
  Problem problem = load_problem("mobile/trajectory");
  const Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
  const Eigen::MatrixXd places = dependent_places(problem, knots);
  EXPECT_EQ(TrajectoryModel(problem, knots, places).lost().reason, "");
  for (const Eigen::MatrixXd& wrong :
       {Eigen::MatrixXd(), Eigen::MatrixXd(places.leftCols(places.cols() - 1)),
        Eigen::MatrixXd(places.topRows(2)), Eigen::MatrixXd(places * NAN)}) {
    EXPECT_NE(TrajectoryModel(problem, knots, wrong).lost().reason, "");
  }
  for (Joint& joint : problem.robot.joints) joint.placement.p *= 0.2;  // too short for the pose
  const TrajectoryModel model(problem, knots, places);
  EXPECT_NE(model.lost().reason, "");
  EXPECT_FALSE(model.dependent(0, Narrow(0.5)));
  EXPECT_FALSE(model.loads<3>(0, Narrow(0.5)));
}

TEST(TrajectoryModel, RejectsOtherTasks) {
  EXPECT_THROW(require_provable(load_problem("planar/force")), std::invalid_argument);
  Problem problem = load_problem("mobile/trajectory");
  EXPECT_NO_THROW(require_provable(problem));
  problem.robot.base_axes = {0, 1, 2, 5};  // two equations for three joints
  EXPECT_THROW(require_provable(problem), std::invalid_argument);
  problem = load_problem("mobile/trajectory");
  problem.robot.joints.back().gear = Gear{problem.dependent.front(), 1, 0};
  EXPECT_THROW(require_provable(problem), std::invalid_argument);
  problem = load_problem("planar/trajectory");
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
