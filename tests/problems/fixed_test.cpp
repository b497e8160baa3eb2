#include <gtest/gtest.h>

#include <cmath>
#include <kdl/chaindynparam.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "lib/math/decompositions.h"
#include "lib/robot/kinematics.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "solvers/solve/row.h"
#include "tests/support/kdl_chain.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using Joints = Eigen::Matrix<double, 7, 1>;

/// The arm of fixed/push, computed by KDL alone.
class KdlArm {
 public:
  explicit KdlArm(const Problem& problem)
      : problem_(problem),
        chain_(kdl_chain(problem.robot)),
        weight_(chain_, KDL::Vector(0, 0, -problem.robot.gravity)) {}

  KDL::Frame tip(const Joints& q) {
    KDL::Frame frame;
    KDL::ChainFkSolverPos_recursive(chain_).JntToCart(array(q), frame);
    return frame;
  }
  Matrix6Xd jacobian(const Joints& q) {
    KDL::Jacobian J(7);
    KDL::ChainJntToJacSolver(chain_).JntToJac(array(q), J);
    return J.data;
  }
  Eigen::VectorXd weight(const Joints& q) {
    KDL::JntArray tau(7);
    weight_.JntToGravity(array(q), tau);
    return tau.data;
  }

  /// From near the pose onto it.
  void correct(Joints& q) {
    for (int i = 0; i < 3; ++i) {
      const KDL::Frame at = tip(q);
      Eigen::Matrix3d R;
      Vector6d error;
      for (int r = 0; r < 3; ++r) {
        error[r] = problem_.pose.p[r] - at.p[r];
        for (int c = 0; c < 3; ++c) R(r, c) = at.M(r, c);
      }
      error.tail<3>() = logarithm(problem_.pose.R * R.transpose());
      q += pseudo_inverse(jacobian(q)) * error;
    }
  }

  /// The joint rates that keep the pose, of unit length.
  Joints null_motion(const Joints& q) { return split(jacobian(q).transpose()).complement.col(0); }

  /// The largest b with |weight + J'c b| <= effort, joint by joint; negative if there is none.
  double capability(const Joints& q) {
    const Eigen::VectorXd tau_d = weight(q);
    const Eigen::VectorXd slope = jacobian(q).transpose() * problem_.c;
    double low = -kInfinity;
    double high = kInfinity;
    for (int i = 0; i < 7; ++i) {
      const double effort = problem_.robot.joints[static_cast<std::size_t>(i)].effort_max;
      if (std::abs(slope[i]) < 1e-12) continue;
      const double a = (effort - tau_d[i]) / slope[i];
      const double b = (-effort - tau_d[i]) / slope[i];
      low = std::max(low, std::min(a, b));
      high = std::min(high, std::max(a, b));
    }
    return low <= high ? high : -1;
  }

  bool within_limits(const Joints& q) {
    for (int i = 0; i < 7; ++i) {
      const Joint& joint = problem_.robot.joints[static_cast<std::size_t>(i)];
      if (q[i] < joint.q_min || q[i] > joint.q_max) return false;
    }
    return true;
  }

 private:
  static KDL::JntArray array(const Joints& q) {
    KDL::JntArray result(7);
    result.data = q;
    return result;
  }

  const Problem& problem_;
  KDL::Chain chain_;
  KDL::ChainDynParam weight_;
};

TEST(FixedArm, KinematicsAreThoseOfKdl) {
  const Problem problem = load_problem("fixed/push");
  KdlArm kdl(problem);
  Kinematics<double> kinematics(problem.robot);
  Random random(1);
  Matrix6Xd J(6, 7);
  Eigen::VectorXd tau_d(7);
  for (int sample = 0; sample < 100; ++sample) {
    const Joints q = Joints::NullaryExpr([&](Eigen::Index) { return random.uniform(-2, 2); });
    kinematics.set_joints(q);
    kinematics.jacobian(problem.robot.end_effectors[0], Eigen::Matrix3d::Identity(), J);
    kinematics.gravity_and_buoyancy(Eigen::Matrix3d::Identity(), tau_d);
    const Pose<double> pose = kinematics.end_effector(problem.robot.end_effectors[0]);
    const KDL::Frame tip = kdl.tip(q);
    for (int r = 0; r < 3; ++r) {
      EXPECT_NEAR(pose.p[r], tip.p[r], 1e-14);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(pose.R(r, c), tip.M(r, c), 1e-14);
    }
    EXPECT_LT((J - kdl.jacobian(q)).norm(), 1e-13);
    EXPECT_LT((tau_d - kdl.weight(q)).norm(), 1e-11);
  }
}

TEST(FixedArm, OneJointIsRedundantAndSixFollow) {
  const Problem problem = load_problem("fixed/push");
  EXPECT_EQ(problem.redundant, std::vector<int>{6});
  EXPECT_EQ(problem.dependent, (std::vector<int>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(problem.robot.actuation.facet_pairs(), 7);  // each joint is a pair of its own
  PostureEvaluator model(problem);
  KdlArm kdl(problem);
  for (double q7 = -1.3; q7 < 2.7; q7 += 0.1) {
    const Posture& posture = model.evaluate(Eigen::VectorXd::Constant(1, q7));
    ASSERT_EQ(posture.status, Status::kValid) << posture.reason.c_str() << " at " << q7;
    EXPECT_TRUE(posture.base.p.isZero());
    const KDL::Frame tip = kdl.tip(posture.q);
    for (int r = 0; r < 3; ++r) EXPECT_NEAR(tip.p[r], problem.pose.p[r], 1e-12);
    EXPECT_NEAR(tip.M(0, 2), 1, 1e-12);  // z along the world's x
  }
}

/// Walks along all postures of the pose by KDL's null motion, in both directions from each IK
/// solution at the default, and compares the best with what the search finds.
TEST(FixedArm, SLOW_SearchFindsTheBestOfAllPostures) {
  const Problem problem = load_problem("fixed/push");
  PostureEvaluator model(problem);
  model.evaluate(problem.theta_r_default);
  KdlArm kdl(problem);
  Kinematics<double> kinematics(problem.robot);
  constexpr double kStep = 3e-3;
  double best = 0;
  const auto walk = [&](Joints q, double direction) {
    Joints along = direction * kdl.null_motion(q);
    for (int i = 0; i < 6 / kStep && std::abs(q[6]) < problem.theta_r_max[0]; ++i) {
      const Joints next = kdl.null_motion(q);
      along = next.dot(along) < 0 ? Joints(-next) : next;
      q += kStep * along;
      kdl.correct(q);
      kinematics.set_joints(q);
      const bool collides = problem.robot.collision->collides(kinematics.links());
      if (kdl.within_limits(q) && !collides) best = std::max(best, kdl.capability(q));
    }
  };
  ASSERT_GT(model.ik_solutions(), 1);
  for (int ik_solution = 0; ik_solution < model.ik_solutions(); ++ik_solution) {
    for (const double direction : {-1.0, 1.0}) walk(model.select(ik_solution).q, direction);
  }
  Case c;
  c.problem = "fixed/push";
  c.search = "grid+cmaes";
  c.budget = 4000;
  const Answer row = solve(problem, {c, 1});
  ASSERT_EQ(row.status, Status::kBestFound);
  // The optimum is a kink; half a step of the walk away from it little is lost.
  EXPECT_NEAR(row.capability.beta, best, 2 * kStep * best);
  EXPECT_GE(row.capability.beta, best - 1e-9 * best);
  EXPECT_GT(row.capability.beta, evaluate(problem, problem.theta_r_default, {c}).capability.beta);
  EXPECT_NEAR(kdl.capability(row.posture.q), row.capability.beta, 1e-9 * best);
}

}  // namespace
}  // namespace maxwrench
