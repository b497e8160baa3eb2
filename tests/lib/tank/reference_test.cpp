#include "lib/tank/reference.h"

#include <gtest/gtest.h>

#include "lib/robot/kinematics.h"
#include "lib/tank/ode.h"
#include "lib/trajectory/motion_evaluator.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/trajectory.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using Eigen::MatrixXd;

/// Knots that differ, and a script of their instants with made-up efforts.
struct MadeScript {
  explicit MadeScript(const char* name, Interpolation interpolation)
      : problem(load_problem(name)), knots(problem.motion->k, problem.redundancy()) {
    Random random(3);
    for (int i = 0; i < knots.rows(); ++i) {
      for (int j = 0; j < knots.cols(); ++j) {
        knots(i, j) = problem.theta_r_default[j] + 0.1 * random.uniform(-1, 1);
      }
    }
    MotionEvaluator motion(problem, make_dense_spline(*problem.motion, 5));
    motion.evaluate(knots, script.instants);
    script.path = problem.motion->path;
    script.interpolation = interpolation;
    int i = 0;
    for (Instant& instant : script.instants) {
      instant.u = Eigen::VectorXd::Constant(problem.robot.actuators(), i++);
      instant.h =
          i * (problem.motion->c_turns ? rotated(instant.end_effector.R, problem.c) : problem.c);
    }
  }
  Problem problem;
  MatrixXd knots;
  TankScript script;
};

/// Against the spline's own rows at instants of another spacing.
TEST(ScriptReader, JoinsTheSplineExactly) {
  const MadeScript made("uvms/valve_trajectory", Interpolation::kSpline);
  const ScriptReader reader(made.problem, made.script);
  const SchemeMaps maps = make_dense_spline(*made.problem.motion, 7);
  Reference reference;
  for (int i = 0; i < maps.instants(); ++i) {
    reader.read(maps.t[static_cast<std::size_t>(i)], reference);
    EXPECT_LT((reference.theta_r.transpose() - maps.P.row(i) * made.knots).norm(), 1e-12);
    EXPECT_LT((reference.rate.transpose() - maps.V.row(i) * made.knots).norm(), 1e-11);
    EXPECT_LT((reference.acceleration.transpose() - maps.A.row(i) * made.knots).norm(), 1e-9);
  }
}

TEST(ScriptReader, JoinsLinearly) {
  const MadeScript made("uvms/valve_trajectory", Interpolation::kLinear);
  const ScriptReader reader(made.problem, made.script);
  const Instant &a = made.script.instants[3], &b = made.script.instants[4];
  Reference reference;
  reader.read(0.75 * a.t + 0.25 * b.t, reference);
  for (int i = 0; i < made.problem.redundancy(); ++i) {
    const int joint = made.problem.redundant[static_cast<std::size_t>(i)];
    EXPECT_NEAR(reference.theta_r[i], 0.75 * a.q[joint] + 0.25 * b.q[joint], 1e-14);
    EXPECT_NEAR(reference.rate[i], (b.q[joint] - a.q[joint]) / (b.t - a.t), 1e-11);
  }
  EXPECT_NEAR(reference.u[0], 3.25, 1e-12);
  EXPECT_NEAR(reference.c.dot(reference.h), 4.25, 1e-12);  // h begins with one
  for (const double beyond : {-1.0, 9.0}) {
    reader.read(beyond, reference);
    EXPECT_NEAR(reference.u[0], beyond < 0 ? 0 : 45, 1e-12);
  }
}

/// c turns with the end effector: so do wrenches between two instants.
TEST(ScriptReader, WrenchesTurnAsTheDirectionDoes) {
  const MadeScript made("uvms/jet_trajectory", Interpolation::kSpline);
  const ScriptReader reader(made.problem, made.script);
  Reference reference;
  for (const double t : {0.0, 2.13, 5.01, 9.9}) {
    reader.read(t, reference);
    EXPECT_LT((reference.c - rotated(reference.x.pose.R, made.problem.c)).norm(), 1e-12);
    EXPECT_LT((reference.h - reference.c.dot(reference.h) * reference.c).norm(), 1e-9);
  }
}

/// What the cell gives back: with the relative twist s = J v - x_0_dot, h_e's = d/dt of d'K d/2 +
/// s'D s, d the displacement from the moving cell. Derivatives of small turns, by differences.
TEST(TankOde, TheMovingCellIsASpringAndADamper) {
  const Problem problem = load_problem("uvms/jet_trajectory");
  const TankOptions options;
  MotionEvaluator evaluator(problem, make_dense_spline(*problem.motion, 5));
  std::vector<Instant> instants;
  evaluator.evaluate(problem.theta_r_default.transpose().replicate(problem.motion->k, 1), instants);
  const Instant& at = instants[17];
  Posture posture;
  posture.base = at.base;
  posture.q = at.q;
  TankOde ode(problem, posture, options);
  ode.hold_along(problem.motion->path);
  Random random(2);
  Motion motion{at.base, at.q, at.v};
  motion.base.p += random_vector(random, 1e-5);
  for (double& rate : motion.v) rate += 1e-3 * random.normal();
  Vector6d K, D;
  K << Eigen::Vector3d::Constant(options.cell.stiffness_linear),
      Eigen::Vector3d::Constant(options.cell.stiffness_angular);
  D << Eigen::Vector3d::Constant(options.cell.damping_linear),
      Eigen::Vector3d::Constant(options.cell.damping_angular);
  const auto stored = [&](double dt) {
    const Vector6d d = ode.displacement(at.t + dt, advanced(problem.robot, motion, dt));
    return d.dot(K.cwiseProduct(d)) / 2;
  };
  const double dt = 1e-4, power = (stored(dt) - stored(-dt)) / (2 * dt);
  const Vector6d s = ode.twist(motion) - problem.motion->path.at(at.t).twist;
  EXPECT_GT(problem.motion->path.at(at.t).twist.norm(), 0.05);
  EXPECT_NEAR(ode.wrench(at.t, motion).dot(s), power + s.dot(D.cwiseProduct(s)),
              1e-4 * (std::abs(power) + s.dot(D.cwiseProduct(s))));
}

TEST(ScriptReader, RejectsAScriptWithoutEfforts) {
  MadeScript made("uvms/valve_trajectory", Interpolation::kSpline);
  made.script.instants[2].u.resize(0);
  EXPECT_THROW(ScriptReader(made.problem, made.script), std::invalid_argument);
  made.script.instants.resize(1);
  EXPECT_THROW(ScriptReader(made.problem, made.script), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
