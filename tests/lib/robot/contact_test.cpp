#include "maxwrench/contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/math/decompositions.h"
#include "lib/posture/ik/contact_arm.h"
#include "maxwrench/load.h"
#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "tests/support/contacts.h"

namespace maxwrench {
namespace {

std::unique_ptr<Measure> linf(const Problem& problem, const char* solver) {
  return make_linf_polytope(problem.robot, find_wrench_solver(solver).make());
}

TEST(Contact, EveryIkSolutionReachesItsPoint) {
  Random random(1);
  for (const char* name : kContactProblems) {
    for (const Problem& problem : {load_problem(name), with_pipe(load_problem(name))}) {
      ContactArm arm(problem);
      EXPECT_TRUE(arm.closed_form()) << name;
      const EndEffector& tip = problem.robot.end_effectors[problem.contact->end_effector];
      Kinematics<double> kinematics(problem.robot);
      int found = 0;
      for (int sample = 0; sample < 300; ++sample) {
        // A target that the arm reaches: that of random joints.
        Eigen::VectorXd q = problem.contact->q_rest;
        for (const int i : problem.contact->follow) {
          q[i] = random.uniform(problem.robot.joints[i].q_min, problem.robot.joints[i].q_max);
        }
        kinematics.set_joints(q);
        const Pose<double> target = kinematics.end_effector(tip);
        const int ik_solutions = arm.solve(target);
        bool same = false;
        for (int b = 0; b < ik_solutions; ++b) {
          Eigen::VectorXd other = problem.contact->q_rest;
          double distance = 0;
          for (std::size_t k = 0; k < problem.contact->follow.size(); ++k) {
            const int i = problem.contact->follow[k];
            other[i] = arm.solution(b)[static_cast<Eigen::Index>(k)];
            distance += std::abs(std::sin((other[i] - q[i]) / 2));
          }
          same |= distance < 1e-6;
          kinematics.set_joints(other);
          EXPECT_LT((kinematics.end_effector_position(tip) - target.p).norm(), 1e-12) << name;
        }
        EXPECT_TRUE(same) << name << " lost the joints that made the target";
        found += ik_solutions;
      }
      EXPECT_GE(found, 600);
    }
  }
}

TEST(Contact, NewtonReachesWhereNoClosedFormIsKnown) {
  Random random(2);
  const Problem problem = load_problem("planar/two_arms");
  // A sliding elbow has no closed form here.
  Problem slide = problem;
  slide.robot.joints[static_cast<std::size_t>(slide.contact->follow[1])].type =
      JointType::kPrismatic;
  ContactArm arm(slide);
  EXPECT_FALSE(arm.closed_form());
  Kinematics<double> kinematics(slide.robot);
  const EndEffector& tip = slide.robot.end_effectors[slide.contact->end_effector];
  int found = 0;
  for (int sample = 0; sample < 50; ++sample) {
    Eigen::VectorXd q = slide.contact->q_rest;
    for (const int i : slide.contact->follow) q[i] = random.uniform(0.2, 1);
    kinematics.set_joints(q);
    const Pose<double> target = kinematics.end_effector(tip);
    const int ik_solutions = arm.solve(target);
    for (int b = 0; b < ik_solutions; ++b) {
      Eigen::VectorXd other = q;
      for (int k = 0; k < 2; ++k) other[slide.contact->follow[k]] = arm.solution(b)[k];
      kinematics.set_joints(other);
      EXPECT_LT((kinematics.end_effector_position(tip) - target.p).norm(), 1e-12);
    }
    found += ik_solutions > 0;
  }
  EXPECT_EQ(found, 50);
}

/// The rows of J_2 by central differences of the second end effector in the world, moving base and
/// joints one by one.
TEST(Contact, StackedJacobianEqualsDifferences) {
  Random random(3);
  for (const char* name : kContactProblems) {
    const Problem problem = load_problem(name);
    PostureEvaluator model(problem, false);
    const Posture& posture = model.evaluate(problem.theta_r_default);
    ASSERT_EQ(posture.status, Status::kValid) << name << ": " << posture.reason.c_str();
    Kinematics<double> kinematics(problem.robot);
    const int axes = static_cast<int>(problem.robot.base_axes.size());
    constexpr double kStep = 1e-6;
    for (const auto& [tip, J] : {std::pair(problem.end_effector, posture.J),
                                 std::pair(problem.contact->end_effector, posture.J_2)}) {
      const auto pose = [&, tip = tip](int i, double step) {
        Eigen::VectorXd q = posture.q;
        Pose<double> base = posture.base;
        if (i >= axes) {
          q[i - axes] += step;
        } else if (problem.robot.base_axes[i] < 3) {
          base.p += step * base.R.col(problem.robot.base_axes[i]);
        } else {
          base.R = base.R *
                   Eigen::AngleAxisd(step, Eigen::Vector3d::Unit(problem.robot.base_axes[i] - 3));
        }
        kinematics.set_joints(q);
        return base * kinematics.end_effector(problem.robot.end_effectors[tip]);
      };
      for (int i = 0; i < problem.robot.velocities(); ++i) {
        const Pose<double> after = pose(i, kStep), before = pose(i, -kStep);
        const Eigen::Vector3d v = (after.p - before.p) / (2 * kStep);
        EXPECT_LT((v - J.col(i).head<3>()).norm(), 1e-9);
        const Eigen::Matrix3d S = (after.R - before.R) / (2 * kStep) * pose(i, 0).R.transpose();
        EXPECT_LT((Eigen::Vector3d(S(2, 1), S(0, 2), S(1, 0)) - J.col(i).tail<3>()).norm(), 1e-9);
      }
    }
  }
}

/// Of beta and of random linear functions of tau_d, J, J_2 and C_2, on one IK solution.
TEST(Contact, GradientEqualsDifferences) {
  Random random(4);
  for (const char* name : kContactProblems) {
    for (const Problem& problem : {load_problem(name), with_pipe(load_problem(name))}) {
      PostureEvaluator model(problem, false);
      const int n = problem.robot.velocities();
      const auto noise = [&](Eigen::Index, Eigen::Index) { return random.normal(); };
      Capability seeds;
      seeds.lambda = Eigen::VectorXd::NullaryExpr(n, [&] { return random.normal(); });
      seeds.beta_J = seeds.beta_J2 = Matrix6Xd::NullaryExpr(6, n, noise);
      seeds.beta_C2 = Matrix6Xd::NullaryExpr(6, problem.contact_columns(), noise);
      int compared = 0;
      for (int sample = 0; sample < 40; ++sample) {
        const Eigen::VectorXd theta_r = near_default(problem, random);
        if (model.evaluate(theta_r).status != Status::kValid) continue;
        Eigen::VectorXd gradient;
        model.pull_back(theta_r, seeds, gradient);
        const int ik_solutions = model.ik_solutions();
        bool jumped = false;
        const auto value = [&](const Eigen::VectorXd& at) {
          const Posture& p = model.evaluate(at);
          jumped |= model.ik_solutions() != ik_solutions;
          return seeds.lambda.dot(p.tau_d) + seeds.beta_J.cwiseProduct(p.J).sum() +
                 seeds.beta_J2.cwiseProduct(p.J_2).sum() + seeds.beta_C2.cwiseProduct(p.C_2).sum();
        };
        constexpr double kStep = 1e-6;
        for (int k = 0; k < problem.redundancy(); ++k) {
          const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(theta_r.size(), k);
          const double difference = (value(theta_r + step) - value(theta_r - step)) / (2 * kStep);
          if (jumped) break;
          EXPECT_NEAR(gradient[k], difference, 2e-6 * (1 + std::abs(difference))) << name;
          ++compared;
        }
      }
      EXPECT_GT(compared, 10) << name;
    }
  }
}

/// Nothing from the second contact: the value of the first alone. Anything: never less. Push: only
/// w >= 0.
TEST(Contact, FrameIsThatOfAnInvalidPostureToo) {
  const Problem problem = load_problem("dual_arm/bar_wall");
  PostureEvaluator model(problem);
  ASSERT_EQ(model.evaluate(problem.theta_r_default).status, Status::kValid);
  const Eigen::Vector2d beyond = 2 * problem.theta_r_max;
  const Posture& posture = model.evaluate(beyond);
  EXPECT_EQ(posture.status, Status::kInvalidPosture);
  const Pose<double> contact = contact_pose(*problem.contact, beyond.data());
  EXPECT_LT((posture.contact.p - contact.p).norm(), 1e-15);
}

TEST(Contact, MoreFreedomNeverLowersTheValue) {
  Random random(5);
  for (const char* name : kContactProblems) {
    for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
      const Problem problem = load_problem(name);
      Problem idle = problem;
      idle.contact->C.resize(6, 0);
      idle.contact->w_min.resize(0);
      idle.contact->w_max.resize(0);
      Problem free = problem;
      free.contact->w_min.setConstant(-kInfinity);
      int compared = 0;
      for (int sample = 0; sample < 60; ++sample) {
        const Eigen::VectorXd theta_r = near_default(problem, random);
        const auto beta = [&](const Problem& p) {
          PostureEvaluator model(p, false);
          WrenchProgram program = make_wrench_program(p, wrench);
          Capability capability;
          const Posture& posture =
              evaluate_best(model, theta_r, *linf(p, "condensed"), true, program, capability);
          if (posture.status != Status::kValid || capability.status != Status::kOptimal) {
            return -kInfinity;
          }
          EXPECT_TRUE(capability.residual.within(1e-7 * (1 + std::abs(capability.beta)))) << name;
          EXPECT_GE((capability.w - program.w_min).minCoeff(), -1e-9) << name;
          return capability.beta;
        };
        const double with = beta(problem);
        const double without = beta(idle);
        if (with == -kInfinity) {
          EXPECT_EQ(without, -kInfinity) << name;
          continue;
        }
        EXPECT_GE(with, without - 1e-9 * (1 + std::abs(with))) << name;
        EXPECT_GE(beta(free), with - 1e-9 * (1 + std::abs(with))) << name;
        // The same postures without any second contact, joint for joint.
        PostureEvaluator model(idle, false);
        double single = -kInfinity;
        model.evaluate(theta_r);
        for (int ik_solution = 0; ik_solution < model.ik_solutions(); ++ik_solution) {
          const Posture& posture = model.select(ik_solution);
          Problem one = problem;
          one.contact.reset();
          WrenchProgram program = make_wrench_program(one, wrench);
          set_posture(posture, program);
          Capability capability;
          linf(one, "condensed")->evaluate(posture, program, false, capability);
          if (capability.status == Status::kOptimal) single = std::max(single, capability.beta);
        }
        EXPECT_EQ(without, single) << name;
        ++compared;
      }
      EXPECT_GT(compared, 5) << name;
    }
  }
}

/// The stacked_jacobian J of the docstring.
Eigen::MatrixXd stacked_jacobian(const Problem& problem, const Posture& posture) {
  const Contact& contact = *problem.contact;
  const Eigen::Index base = static_cast<Eigen::Index>(problem.robot.base_axes.size());
  Eigen::MatrixXd J(6 + contact.rows(), posture.J.cols());
  J << posture.J, posture.J_2.topRows(contact.rows());
  for (Eigen::Index row = 3; row < J.rows(); ++row) {
    if (row < 6 || row >= 9) J.row(row) *= contact.length_scale;
  }
  for (Eigen::Index i = 0; i < J.cols(); ++i) {
    const bool turns = i < base ? problem.robot.base_axes[i] >= 3
                                : problem.robot.joints[i - base].type == JointType::kRevolute;
    if (turns) J.col(i) /= contact.length_scale;
  }
  return J;
}

/// By singular values, at thresholds on both sides of the smallest that counts.
TEST(Contact, PivotsTellNearSingularPostures) {
  Random random(12);
  std::vector<Problem> problems;
  for (const char* name : kContactProblems) problems.push_back(load_problem(name));
  for (int sample = 0; sample < 3; ++sample) problems.push_back(with_firm_grasp(random));
  for (const Problem& problem : problems) {
    PostureEvaluator model(problem, false);
    for (int sample = 0; sample < 10; ++sample) {
      const Posture& posture = model.evaluate(near_default(problem, random));
      Contact contact = *problem.contact;
      const double gain = singular_values(stacked_jacobian(problem, posture))[contact.rank - 1];
      EXPECT_NEAR(smallest_gain(problem.robot, contact, posture.J, posture.J_2), gain, 1e-9);
      for (const double part : {0.0, 1e-7, 0.5, 1 - 1e-7, 1 + 1e-7, 2.0}) {
        contact.sigma_min = part * gain;
        EXPECT_EQ(near_singular(problem.robot, contact, posture.J, posture.J_2), part > 1)
            << problem.name << " " << part << " of " << gain;
      }
      contact.rank = 0;  // nothing moves: singular at any threshold
      EXPECT_TRUE(near_singular(problem.robot, contact, posture.J, posture.J_2));
    }
  }
}

/// The bar leaves the base no motion, so a stretched second arm lacks one direction.
TEST(Contact, NearSingularPosturesAreRejected) {
  Problem problem = load_problem("dual_arm/bar_wall");
  EXPECT_EQ(problem.contact->rank, 9);
  for (const int i : problem.contact->follow) {
    problem.robot.joints[i].q_min = -7;
    problem.robot.joints[i].q_max = 7;
  }
  const Eigen::Vector3d start = problem.contact->frame.p;
  const Eigen::Vector3d away = Eigen::Vector3d(0.1, -1, 0.2).normalized();
  const auto at = [&](double distance) {
    problem.contact->frame.p = start + distance * away;
    return PostureEvaluator(problem, false).evaluate(problem.theta_r_default);
  };
  EXPECT_EQ(at(0).status, Status::kValid);
  double low = 0, high = 1;  // it reaches the one and not the other
  for (int step = 0; step < 50; ++step) {
    (at((low + high) / 2).ik_solutions.found > 0 ? low : high) = (low + high) / 2;
  }
  const Posture stretched = at(low - 1e-6);
  EXPECT_LT(smallest_gain(problem.robot, *problem.contact, stretched.J, stretched.J_2), 0.05);
  EXPECT_EQ(stretched.status, Status::kInvalidPosture);
  EXPECT_EQ(stretched.reason.str().find("singular"), 0u) << stretched.reason.c_str();
  EXPECT_GT(stretched.ik_solutions.singular, 0);
  EXPECT_EQ(stretched.ik_solutions.valid(), 0);
  const Posture far = at(high + 1e-6);
  EXPECT_EQ(far.status, Status::kInvalidPosture);
  EXPECT_EQ(far.reason.str().find("unreachable contact"), 0u) << far.reason.c_str();
}

}  // namespace
}  // namespace maxwrench
