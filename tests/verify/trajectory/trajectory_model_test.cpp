#include "verify/trajectory/trajectory_model.h"

#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "maxwrench/trajectory.h"
#include "solvers/certify/trajectory/edge_program.h"
#include "tests/support/trajectory_proofs.h"
#include "verify/trajectory/provable.h"

namespace maxwrench {
namespace {

/// tau_d and J'c of `lib` at a time.
struct ModelInstant {
  Eigen::VectorXd tau_d, along_c;
};

ModelInstant by_lib(const Problem& problem, const std::vector<Instant>& instants, int at) {
  const Instant& here = instants[static_cast<std::size_t>(at)];
  Vector6d c = problem.c;
  if (problem.motion->c_turns) {
    const Eigen::Matrix3d turn = here.end_effector.R * instants.front().end_effector.R.transpose();
    c << turn * problem.c.head<3>(), turn * problem.c.tail<3>();
  }
  return {here.tau_d, here.J.transpose() * c};
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
    const int parts = 24, intervals = model.curve().intervals();
    const std::vector<Instant> instants = instants_by_lib(problem, knots, parts);
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
        const ModelInstant expected = by_lib(problem, instants, interval * parts + part);
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
            const double rounding = problem.dependent.empty() ? 1e-8 : 1e-7;
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
