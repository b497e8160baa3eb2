#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <kdl/chain.hpp>
#include <kdl/chaindynparam.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>
#include <string>

#include "lib/robot/kinematics.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "solvers/solve/row.h"
#include "tests/reference_models/static_task.h"
#include "tests/support/mechanics.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

class Uvms : public testing::Test {
 protected:
  const Problem valve_ = load_problem("uvms/valve");
  const Problem lift_ = load_problem("uvms/lift");
};

TEST_F(Uvms, TasksShareRobotPoseAndDefaultPosture) {
  EXPECT_EQ(valve_.c, Vector6d::Unit(5));
  EXPECT_STREQ(valve_.unit(), "N m");
  EXPECT_EQ(lift_.c, Vector6d::Unit(2));
  EXPECT_STREQ(lift_.unit(), "N");
  for (const Problem* problem : {&valve_, &lift_}) {
    EXPECT_EQ(problem->redundancy(), 4);
    EXPECT_TRUE(problem->pose.R.isIdentity());
    EXPECT_TRUE(problem->pose.p.isZero());
    EXPECT_EQ(problem->W_any.cols(), 6);
    EXPECT_TRUE(
        problem->theta_r_default.isApprox(Eigen::Vector4d(M_PI, 0.4, 0.4 + M_PI / 2, 0), 1e-15));
  }
}

TEST_F(Uvms, ActuatorsHaveThePapersLimits) {
  const Robot& robot = valve_.robot;
  ASSERT_EQ(robot.velocities(), 10);
  ASSERT_EQ(robot.actuators(), 12);
  EXPECT_EQ(robot.actuation.rank, 10);
  EXPECT_TRUE((robot.actuation.u_min.head(8).array() == -40).all());
  EXPECT_TRUE((robot.actuation.u_max.head(8).array() == 50).all());
  EXPECT_EQ(robot.actuation.u_max.tail(4), Eigen::Vector4d(9, 9, 9, 2));
  EXPECT_EQ(robot.actuation.u_min.tail(4), -Eigen::Vector4d(9, 9, 9, 2));
  EXPECT_TRUE((robot.u_rate_max.head(8).array() == 50).all());
  EXPECT_TRUE((robot.u_rate_max.tail(4).array() == kInfinity).all());
  // Impulse: each of four vertical thrusters pushes the vehicle down at positive thrust.
  EXPECT_EQ(robot.actuation.B.row(2).head(8),
            (Eigen::VectorXd(8) << 0, 0, 0, 0, -1, -1, -1, -1).finished().transpose());
}

TEST_F(Uvms, EveryBlockKeepsItsSource) {
  std::vector<std::string> blocks;
  for (const auto& [block, source] : valve_.robot.sources) blocks.push_back(block);
  for (const char* block :
       {"robot", "base", "trim", "thrusters", "end_effectors.tool", "buoyancy", "buoyancy.vehicle",
        "hydrodynamics", "hydrodynamics.vehicle", "collision"}) {
    EXPECT_THAT(blocks, testing::Contains(block));
  }
}

/// 14.5 + 0.23 + 0.16 + 0.38 + 0.14 + 0.36 = 15.77 kg; the volumes 0.01447896 + 0.00016 + 0.000032
/// + 0.00022 + 0.000032 + 0.000134 = 0.01505696 m^3 displace 15.0268 kg; the trim lifts 0.808 kg:
/// 0.065 kg of buoyancy are left, which the thrusters hold down with 0.636 N.
TEST_F(Uvms, TrimLeavesLittleBuoyancy) {
  const Robot& robot = valve_.robot;
  double mass = 0, deflection_error = 0;
  for (const Link& link : robot.links) {
    mass += link.mass;
    deflection_error += robot.water_density * link.volume;
  }
  EXPECT_NEAR(mass, 15.77, 1e-12);
  EXPECT_NEAR(deflection_error + robot.trim.buoyancy_mass - mass, 0.065, 5e-4);
  PostureEvaluator model(valve_);
  const Posture& posture = model.evaluate(valve_.theta_r_default);
  EXPECT_NEAR(posture.tau_d[2], -(998 * 0.01505696 + 0.808 - 15.77) * 9.81, 1e-11);
}

/// Upright whenever q1 = pi, q3 = q2 + pi/2, q4 = 0; then the arm reaches ahead of the vehicle.
TEST_F(Uvms, VehicleIsUprightAndFreeOfCollisionAtTheDefaultPosture) {
  PostureEvaluator model(valve_);
  EXPECT_EQ(model.evaluate(valve_.theta_r_default).status, Status::kValid);
  for (const double q2 : {0.1, 0.4, 1.0, 1.6}) {
    const Posture& posture = model.evaluate(Eigen::Vector4d(M_PI, q2, q2 + M_PI / 2, 0));
    EXPECT_TRUE(posture.base.R.isIdentity(1e-10));
    EXPECT_LT(posture.base.p.x(), -0.3);
    EXPECT_NEAR(posture.base.p.y(), 0, 1e-10);
  }
}

TEST_F(Uvms, StaticLoadIsTheDerivativeOfThePotentialEnergy) {
  Random random(1);
  PostureEvaluator model(lift_, false);
  for (int sample = 0; sample < 20; ++sample) {
    const Posture& posture = model.evaluate(random_theta_r(lift_, random));
    const Eigen::VectorXd slopes =
        potential_energy_slopes(lift_.robot, posture.base, posture.q, 1e-6);
    EXPECT_LT((slopes - posture.tau_d).cwiseAbs().maxCoeff(), 1e-6);
  }
}

/// The arm on the vehicle, typed from its table of joints and links and not from our files. KDL
/// turns a joint before it applies the segment's frame, so each joint gets two segments.
KDL::Chain arm() {
  using KDL::Frame, KDL::Joint, KDL::Rotation, KDL::Segment, KDL::Vector;
  const double mount = 1.30215820291;
  struct Row {
    Rotation R;
    Vector p;
    double mass;
    Vector com;
  };
  const Row rows[] = {
      {Rotation::RPY(0, 0, M_PI), Vector(0, 0, 0), 0.16, Vector(0.006, 0, 0.0301)},
      {Rotation::RPY(M_PI / 2, mount, 0), Vector(0.02, 0, 0.0462), 0.38,
       Vector(0.0746, 0.00055, 0)},
      {Rotation::RPY(M_PI, 0, mount), Vector(0.1507053085, 0, 0), 0.14, Vector(0.01, -0.017, 0)},
      {Rotation::RPY(-M_PI / 2, M_PI / 2, 0), Vector(0.02, 0, 0), 0.36, Vector(0, 0, -0.1195)}};
  KDL::Chain chain;
  const auto fixed = [&chain](const Rotation& R, const Vector& p) {
    chain.addSegment(Segment(Joint(Joint::None), Frame(R, p)));
  };
  fixed(Rotation::RPY(M_PI, 0, 0), Vector(0.203, 0, -0.1317));
  for (const Row& row : rows) {
    fixed(row.R, row.p);
    chain.addSegment(
        Segment(Joint(Joint::RotZ), Frame::Identity(), KDL::RigidBodyInertia(row.mass, row.com)));
  }
  fixed(Rotation::RPY(M_PI / 2, M_PI / 2, 0), Vector(0, 0, -0.18));
  return chain;
}

TEST_F(Uvms, ArmAgreesWithKdl) {
  Robot robot = valve_.robot;
  robot.water_density = 0;
  Kinematics<double> kinematics(robot);
  const KDL::Chain chain = arm();
  Matrix6Xd J(6, 10);
  Eigen::VectorXd tau_d(10);
  Random random(2);
  for (int sample = 0; sample < 50; ++sample) {
    KDL::JntArray q(4), gravity(4);
    q.data = random_theta_r(valve_, random);
    kinematics.set_joints(q.data);
    kinematics.jacobian(robot.end_effectors[0], Eigen::Matrix3d::Identity(), J);
    kinematics.gravity_and_buoyancy(Eigen::Matrix3d::Identity(), tau_d);
    KDL::Frame tip;
    KDL::ChainFkSolverPos_recursive(chain).JntToCart(q, tip);
    KDL::Jacobian jacobian(4);
    KDL::ChainJntToJacSolver(chain).JntToJac(q, jacobian);
    KDL::ChainDynParam(chain, KDL::Vector(0, 0, -9.81)).JntToGravity(q, gravity);
    const Pose<double> pose = kinematics.end_effector(robot.end_effectors[0]);
    for (int r = 0; r < 3; ++r) {
      EXPECT_NEAR(pose.p[r], tip.p[r], 1e-13);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(pose.R(r, c), tip.M(r, c), 1e-13);
    }
    EXPECT_LT((J.rightCols(4) - jacobian.data).norm(), 1e-12);
    EXPECT_LT((tau_d.tail(4) - gravity.data).norm(), 1e-12);
  }
}

double capability(const Problem& problem, const char* measure, Wrench wrench) {
  const Case c{problem.name, measure, wrench};
  const Answer row = evaluate(problem, problem.theta_r_default, {c});
  EXPECT_TRUE(row.has_value()) << row.reason.c_str();
  return row.capability.beta;
}

/// The tasks in a model of their own, which knows no collisions. The tool is at the origin.
class UvmsReference : public Uvms {
 protected:
  reference::StaticTask task(const Problem& problem, Wrench wrench) const {
    return {robot_, "tool", Eigen::Isometry3d::Identity(), problem.c,
            wrench == Wrench::kPure ? Eigen::MatrixXd(problem.c) : Eigen::MatrixXd::Identity(6, 6)};
  }
  double beta(const Problem& problem, const std::string& measure, Wrench wrench,
              const Eigen::VectorXd& q) const {
    const reference::StaticTask mine = task(problem, wrench);
    return (measure == "ellipsoid" ? mine.ellipsoid(q) : mine.polytope(q)).value_or(-kInfinity);
  }

  const reference::Lagrange robot_{MAXWRENCH_SOURCE_DIR "/problems/uvms/bluerov2_alpha5.toml"};
};

/// The axis of the shoulder yaw is vertical, so a pure torque about the vertical passes through
/// this joint, whose limit is 9 N m.
TEST_F(UvmsReference, SLOW_DefaultPostureHasTheKnownCapability) {
  EXPECT_NEAR(capability(valve_, "linf_polytope", Wrench::kPure), 9, 1e-9);
  for (const Problem* problem : {&valve_, &lift_}) {
    const double ellipsoid = capability(*problem, "ellipsoid", Wrench::kPure);
    const double pure = capability(*problem, "linf_polytope", Wrench::kPure);
    const double any = capability(*problem, "linf_polytope", Wrench::kAny);
    const Eigen::VectorXd& q = problem->theta_r_default;
    EXPECT_NEAR(ellipsoid, beta(*problem, "ellipsoid", Wrench::kPure, q), 1e-8);
    EXPECT_NEAR(pure, beta(*problem, "linf_polytope", Wrench::kPure, q), 1e-8);
    EXPECT_NEAR(any, beta(*problem, "linf_polytope", Wrench::kAny, q), 1e-8);
    EXPECT_LE(ellipsoid, pure);
    EXPECT_GE(any, pure);
  }
}

/// max c'x of the reference's program by GLPK, where trying all vertices takes too long.
double by_glpk(const reference::Program& p, LpSolver& glpk) {
  LinearProgram program;
  program.A = p.A.sparseView();
  program.b = p.b;
  program.c = p.c;
  program.l = p.l;
  program.u = p.u;
  LpSolution solution;
  glpk.solve(program, solution);
  return solution.status == Status::kOptimal ? solution.objective : -kInfinity;
}

/// The best of random postures, improved by steps along the coordinates that become shorter.
double random_search(const Problem& problem,
                     const std::function<double(const Eigen::VectorXd&)>& value) {
  PostureEvaluator valid(problem);
  const auto at = [&](const Eigen::VectorXd& q) {
    return valid.evaluate(q).status == Status::kValid ? value(q) : -kInfinity;
  };
  std::vector<std::pair<double, Eigen::VectorXd>> found;
  Random random(1);
  for (int sample = 0; sample < samples(2000); ++sample) {
    const Eigen::VectorXd q = random_theta_r(problem, random);
    found.emplace_back(at(q), q);
  }
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  double best = -kInfinity;
  for (int start = 0; start < 3; ++start) {
    auto [reached, q] = found[start];
    for (double step = 0.2; step > 1e-4;) {
      const Eigen::VectorXd next = q + step * random_numbers(random, static_cast<int>(q.size()));
      const double there = at(next);
      if (there > reached) {
        reached = there;
        q = next;
      } else {
        step *= 0.97;
      }
    }
    best = std::max(best, reached);
  }
  return best;
}

/// Ours must not be worse, and the same within what a random search misses.
TEST_F(UvmsReference, SLOW_SearchReachesWhatARandomSearchOfAnotherModelReaches) {
  struct Choice {
    const Problem& problem;
    const char* measure;
    Wrench wrench;
  };
  const auto glpk = find_lp_solver("glpk").make();
  for (const Choice& choice :
       {Choice{valve_, "ellipsoid", Wrench::kPure}, Choice{valve_, "linf_polytope", Wrench::kPure},
        Choice{valve_, "linf_polytope", Wrench::kAny}, Choice{lift_, "ellipsoid", Wrench::kPure},
        Choice{lift_, "linf_polytope", Wrench::kPure}}) {
    SCOPED_TRACE(choice.problem.name + " " + choice.measure);
    Case c{choice.problem.name, choice.measure, choice.wrench};
    c.budget = 20000;
    const Answer row = solve(choice.problem, {c, 2});
    ASSERT_TRUE(row.has_value()) << row.reason.c_str();
    const double found = row.capability.beta;
    EXPECT_NEAR(found, beta(choice.problem, choice.measure, choice.wrench, row.posture.theta_r),
                1e-7 * found);
    const reference::StaticTask mine = task(choice.problem, choice.wrench);
    const double known = random_search(choice.problem, [&](const Eigen::VectorXd& q) {
      return c.measure == "ellipsoid" ? mine.ellipsoid(q).value_or(-kInfinity)
                                      : by_glpk(mine.program(q), *glpk);
    });
    EXPECT_GE(found, known * (1 - 1e-9));
    EXPECT_LE(found, 1.025 * known);
  }
}

/// Shapes: two boxes and a capsule (vehicle and arm base, one link), one capsule on each of links 1
/// to 3, two on link 4. Between links: 3 * 5 + (1 + 1 + 2) + (1 + 2) + 2 = 24 pairs; ignored are
/// base - link 1, 1 - 2, 2 - 3 with one pair each and 3 - 4 with two.
TEST_F(Uvms, AllPairsButNeighboursAreCheckedForCollision) {
  ASSERT_NE(valve_.robot.collision, nullptr);
  EXPECT_EQ(valve_.robot.collision->pairs(), 24 - 5);
  // Turned back, the arm puts the tool into the hull, at (-0.055, 0.141, -0.071) in its axes.
  PostureEvaluator model(valve_), unchecked(valve_, false);
  const Eigen::Vector4d inside(0.5, 0.4, 1.8, 0);
  EXPECT_STREQ(model.evaluate(inside).reason.c_str(), "self-collision");
  EXPECT_EQ(unchecked.evaluate(inside).status, Status::kValid);
  // The wrist is 0.0064 m from the upper arm: nearer than the margin. A little farther is free.
  EXPECT_STREQ(model.evaluate(Eigen::Vector4d(0.1, 1.6, 2.4, 0)).reason.c_str(), "self-collision");
  EXPECT_EQ(model.evaluate(Eigen::Vector4d(0.1, 1.6, 2, 0)).status, Status::kValid);
}

/// Vehicle and arm base are one link; their added mass and drag stay apart.
TEST_F(Uvms, HydrodynamicDataIsRead) {
  const std::vector<Link>& links = valve_.robot.links;
  ASSERT_EQ(links.size(), 5u);
  ASSERT_EQ(links[0].hydrodynamics.size(), 2u);
  EXPECT_EQ(links[0].hydrodynamics[0].added_mass[2], 18);
  EXPECT_TRUE(links[0].hydrodynamics[0].frame.p.isZero());
  // The base lies upside down at (0.203, 0, -0.1317), its centre 0.065 m behind.
  const HydrodynamicBody& base = links[0].hydrodynamics[1];
  EXPECT_TRUE(base.frame.p.isApprox(Eigen::Vector3d(0.203 - 0.065, 0, -0.1317)));
  EXPECT_NEAR(base.frame.R(2, 2), -1, 1e-15);
  EXPECT_EQ(base.damping_quadratic[1], 1.5);
  for (std::size_t i = 1; i < 5; ++i) {
    ASSERT_EQ(links[i].hydrodynamics.size(), 1u);
    EXPECT_TRUE(links[i].hydrodynamics[0].frame.p.isApprox(links[i].com));
  }
}

}  // namespace
}  // namespace maxwrench
