#include "solvers/certify/trajectory/instant_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/math/random.h"
#include "lib/robot/dynamics.h"
#include "lib/trajectory/robot_motion.h"
#include "maxwrench/load.h"
#include "solvers/certify/bound/multi_affine.h"
#include "solvers/certify/trajectory/instant_loads.h"
#include "solvers/certify/trajectory/quadratic_loads.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

PlanInstant plan_instant(const std::string& name, int instant) {
  const Problem problem = load_problem(name);
  const SchemeMaps maps = make_scheme(*problem.motion);
  PlanInstant at{problem, maps.x[static_cast<std::size_t>(instant)],
                 ranges_at(problem, maps, instant), true};
  at.task.motion.reset();
  at.task.pose = at.x.pose;
  at.task.theta_r_min = at.ranges.place.low;
  at.task.theta_r_max = at.ranges.place.high;
  return at;
}

Eigen::VectorXd drawn(Random& random, const Eigen::VectorXd& low, const Eigen::VectorXd& high) {
  return Eigen::VectorXd::NullaryExpr(
      low.size(), [&](Eigen::Index i) { return random.uniform(low[i], high[i]); });
}

/// A box of x with sides of random shares of the ranges.
struct DrawnBox {
  DrawnBox(Random& random, const PlanInstant& at) : lower(at.lower()), upper(at.upper()) {
    const Eigen::VectorXd a = drawn(random, lower, upper);
    const double share = std::pow(10, random.uniform(-3, 0));
    const Eigen::VectorXd half = share * (upper - lower) / 2;
    lower = lower.cwiseMax(a - half);
    upper = upper.cwiseMin(a + half);
  }
  Eigen::VectorXd lower, upper;
};

/// The robot at an instant, by the dynamics of the project.
class MovingRobot {
 public:
  explicit MovingRobot(const PlanInstant& at)
      : at_(at), motion_(at.task), dynamics_(at.task.robot) {}

  void set(const Eigen::VectorXd& x, const Eigen::VectorXd& bend) {
    const Eigen::Index r = bend.size();
    const Eigen::VectorXd rate =
        x.size() > r ? Eigen::VectorXd(x.tail(r)) : Eigen::VectorXd(Eigen::VectorXd::Zero(r));
    motion_.set(at_.x, x.head(r), rate, bend);
    dynamics_.set_configuration(motion_.base().R, motion_.q());
    dynamics_.inverse(motion_.v(), motion_.v_dot(), tau);
    dynamics_.gravity(gravity);
    dynamics_.kinematics().jacobian(
        at_.task.robot.end_effectors[static_cast<std::size_t>(at_.task.end_effector)],
        motion_.base().R, J_);
  }
  /// The largest t with tau + t J'c in {B u}, by all facets; -infinity: there is none.
  double value() const {
    const Zonotope& set = at_.task.robot.actuation;
    const Eigen::VectorXd offset = set.N.transpose() * tau;
    const Eigen::VectorXd slope = set.N.transpose() * (J_.transpose() * at_.task.c);
    double low = -kInfinity, high = kInfinity;
    for (Eigen::Index j = 0; j < slope.size(); ++j) {
      const double a = (set.b_min[j] - offset[j]) / slope[j];
      const double b = (set.b_max[j] - offset[j]) / slope[j];
      if (std::abs(slope[j]) < 1e-12) {
        if (offset[j] < set.b_min[j] || offset[j] > set.b_max[j]) return -kInfinity;
        continue;
      }
      low = std::max(low, std::min(a, b));
      high = std::min(high, std::max(a, b));
    }
    return low <= high ? high : -kInfinity;
  }

  Eigen::VectorXd tau, gravity;

 private:
  const PlanInstant& at_;
  RobotMotion<double> motion_;
  Dynamics dynamics_;
  Matrix6Xd J_;
};

/// The sum of linear and quadratic terms is what the dynamics of the project add to weight.
TEST(InstantLoads, AgreeWithTheDynamics) {
  for (const auto& [name, instant] : {std::pair{"uvms/valve_trajectory", 10},
                                      {"uvms/jet_trajectory", 14},
                                      {"uvms/valve_impulse", 48},
                                      {"planar/trajectory", 8}}) {
    const PlanInstant at = plan_instant(name, instant);
    InstantLoads<double> loads(at.task, at.x);
    MovingRobot robot(at);
    Random random(3);
    for (int sample = 0; sample < 50; ++sample) {
      const Eigen::VectorXd x = drawn(random, at.lower(), at.upper());
      const Eigen::VectorXd bend = drawn(random, at.ranges.bend.low, at.ranges.bend.high);
      robot.set(x, bend);
      loads.set(x.head(bend.size()));
      Eigen::VectorXd both, linear, quadratic;
      const Eigen::VectorXd rate = x.tail(bend.size());
      loads.evaluate({true, true, true}, rate, bend, both);
      EXPECT_LT((both + robot.gravity - robot.tau).lpNorm<Eigen::Infinity>(), 1e-11) << name;
      loads.evaluate({true, true, false}, rate, bend, linear);
      loads.evaluate({true, false, true}, rate, bend, quadratic);
      EXPECT_LT((both - linear - quadratic).lpNorm<Eigen::Infinity>(), 1e-11) << name;
    }
  }
}

/// The terms at random points of boxes, small and large, are enclosed.
TEST(QuadraticLoads, EncloseRandomPoints) {
  const PlanInstant at = plan_instant("uvms/valve_trajectory", 10);
  const Eigen::Index r = at.task.redundancy();
  QuadraticLoads enclosed(at);
  InstantLoads<Extended> loads(at.task, at.x);
  const ExtendedVector none = ExtendedVector::Zero(r);
  Random random(5);
  for (int box = 0; box < samples(200); ++box) {
    const DrawnBox in(random, at);
    enclosed.enclose(in.lower, in.upper);
    for (int point = 0; point < 50; ++point) {
      const Eigen::VectorXd x = drawn(random, in.lower, in.upper);
      ExtendedVector delta;
      loads.set(x.head(r).cast<Extended>());
      loads.evaluate({true, false, true}, x.tail(r).cast<Extended>(), none, delta);
      Eigen::VectorXd s = x;
      for (Eigen::Index j = 0; j < r; ++j) s[j] = std::sin(x[j] - (in.lower[j] + in.upper[j]) / 2);
      const Eigen::VectorXd rest =
          delta.cast<double>() - enclosed.constant() - enclosed.slopes() * s;
      EXPECT_TRUE((rest.array() >= enclosed.low().array() - 1e-12).all());
      EXPECT_TRUE((rest.array() <= enclosed.high().array() + 1e-12).all());
    }
  }
}

/// No random posture, rate and acceleration in a box has a value above the bound of the box.
TEST(InstantBound, SLOW_IsAboveRandomMotions) {
  for (const auto& [name, instant] : {std::pair{"uvms/valve_trajectory", 0},
                                      {"uvms/valve_trajectory", 12},
                                      {"uvms/valve_impulse", 48},
                                      {"planar/trajectory", 8}}) {
    PlanInstant at = plan_instant(name, instant);
    at.knot = false;  // collisions do not matter
    const auto bound = make_instant_bound(at);
    MovingRobot robot(at);
    Random random(7);
    int feasible = 0, bounded = 0;
    for (int box = 0; box < samples(500); ++box) {
      const DrawnBox in(random, at);
      BoxProof proof;
      const double low = random.uniform(-5, 5);
      bound->evaluate(in.lower, in.upper, low, bound->ceiling(), proof);
      bounded += proof.high < bound->ceiling() ? 1 : 0;
      for (int point = 0; point < 200; ++point) {
        const Eigen::VectorXd x = drawn(random, in.lower, in.upper);
        robot.set(x, drawn(random, at.ranges.bend.low, at.ranges.bend.high));
        const double value = robot.value();
        feasible += std::isfinite(value) ? 1 : 0;
        ASSERT_LE(value, std::max(low, proof.high) + 1e-9) << name;
      }
    }
    EXPECT_GT(feasible, samples(1000)) << name;
    EXPECT_GT(bounded, samples(100)) << name;
  }
}

/// On a small box about a point, the bound is near the value of the point's linear program: the
/// relaxation is no other than the one that is documented.
TEST(InstantBound, IsTightAtPoints) {
  for (const int instant : {0, 12}) {
    PlanInstant at = plan_instant("uvms/valve_trajectory", instant);
    at.knot = false;
    const auto bound = make_instant_bound(at);
    const auto objective = make_instant_objective(at);
    Random random(11);
    int tight = 0;
    for (int sample = 0; sample < 40; ++sample) {
      const Eigen::VectorXd x = drawn(random, at.lower(), at.upper());
      const double value = objective->evaluate(x);
      if (!std::isfinite(value)) continue;
      BoxProof proof;
      const Eigen::VectorXd half = Eigen::VectorXd::Constant(x.size(), 1e-7);
      bound->evaluate(x - half, x + half, value - 1, bound->ceiling(), proof);
      EXPECT_GE(proof.high, value - 1e-6);
      tight += proof.high <= value + 0.05 * (1 + std::abs(value)) ? 1 : 0;
    }
    EXPECT_GT(tight, 10) << instant;
  }
}

/// The base of the planar vehicle cannot move along z, but water can. A tilted link turns that drag
/// into the plane.
TEST(InstantObjective, HasAllOfTheCurrent) {
  PlanInstant at = plan_instant("planar/trajectory", 12);
  at.knot = false;
  at.ranges.bend.low.setZero();
  at.ranges.bend.high.setZero();
  HydrodynamicBody body;
  body.frame.R = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 0).normalized()).toRotationMatrix();
  body.damping_quadratic << 3, 6, 9, 0, 0, 0;
  at.task.robot.water_density = 1000;
  at.task.robot.links.back().hydrodynamics = {body};
  const Eigen::Vector3d current(0.05, -0.1, 0.2);
  PlanInstant world = at;
  world.task.robot.current = current;
  at.current = current;
  at.x.twist.head<3>() -= current;
  const auto objective = make_instant_objective(at);
  MovingRobot robot(world), still(at);
  Random random(23);
  int feasible = 0, different = 0;
  for (int sample = 0; sample < 60; ++sample) {
    const Eigen::VectorXd x = drawn(random, at.lower(), at.upper());
    robot.set(x, Eigen::VectorXd::Zero(at.task.redundancy()));
    const double value = robot.value();
    still.set(x, Eigen::VectorXd::Zero(at.task.redundancy()));
    if (!std::isfinite(value)) continue;
    ++feasible;
    different += std::abs(still.value() - value) > 1e-6;
    EXPECT_NEAR(objective->evaluate(x), value, 1e-8 * (1 + std::abs(value)));
  }
  EXPECT_GT(feasible, 10);
  EXPECT_GT(different, 10);
}

/// Two knots that differ by D: the clamped cubic has the rate 6 s (1 - s) D/dt and the acceleration
/// 6 D/dt^2 at its start. The limit V at s = 1/2, an instant, gives D <= V dt/1.5, so at most 4
/// V/dt.
TEST(InstantRanges, OfTwoKnotsFollowFromTheSpeed) {
  Problem problem = load_problem("uvms/valve_trajectory");
  problem.motion->k = 2;
  const SchemeMaps maps = make_scheme(*problem.motion);
  const InstantRanges ranges = ranges_at(problem, maps, 0);
  for (Eigen::Index j = 0; j < 4; ++j) {
    const double V =
        problem.robot
            .joints[static_cast<std::size_t>(problem.redundant[static_cast<std::size_t>(j)])]
            .velocity_max;
    EXPECT_NEAR(ranges.bend.high[j], 4 * V / maps.dt, 1e-5);
    EXPECT_NEAR(ranges.bend.low[j], -4 * V / maps.dt, 1e-5);
    EXPECT_NEAR(ranges.rate.high[j], 0, 1e-12);
    EXPECT_NEAR(ranges.place.high[j], problem.theta_r_max[j], 2e-6);
  }
}

/// Random tables, scaled until they keep the speed limits, are in the ranges of all instants.
TEST(InstantRanges, HoldRandomTables) {
  const Problem problem = load_problem("uvms/valve_trajectory");
  const SchemeMaps maps = make_scheme(*problem.motion);
  Random random(13);
  std::vector<InstantRanges> ranges;
  for (int i = 0; i < maps.instants(); ++i) ranges.push_back(ranges_at(problem, maps, i));
  int kept = 0;
  for (int table = 0; table < 200; ++table) {
    const Eigen::Index j = table % 4;
    const double V =
        problem.robot
            .joints[static_cast<std::size_t>(problem.redundant[static_cast<std::size_t>(j)])]
            .velocity_max;
    const double start = random.uniform(problem.theta_r_min[j], problem.theta_r_max[j]);
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(maps.knots());
    Eigen::VectorXd Q = drawn(random, -ones, ones);
    Q *= V / (maps.speed * Q).lpNorm<Eigen::Infinity>();
    Q.array() += start - Q[0];
    if (Q.minCoeff() < problem.theta_r_min[j] || Q.maxCoeff() > problem.theta_r_max[j]) continue;
    const Eigen::VectorXd place = maps.P * Q, rate = maps.V * Q, bend = maps.A * Q;
    if (place.minCoeff() < problem.theta_r_min[j] || place.maxCoeff() > problem.theta_r_max[j]) {
      continue;
    }
    ++kept;
    for (int i = 0; i < maps.instants(); ++i) {
      const InstantRanges& at = ranges[static_cast<std::size_t>(i)];
      const auto inside = [j](const NumberRanges& range, double value) {
        return value >= range.low[j] - 1e-12 && value <= range.high[j] + 1e-12;
      };
      EXPECT_TRUE(inside(at.place, place[i]) && inside(at.rate, rate[i]) &&
                  inside(at.bend, bend[i]))
          << i;
    }
  }
  EXPECT_GT(kept, 50);
}

}  // namespace
}  // namespace maxwrench
