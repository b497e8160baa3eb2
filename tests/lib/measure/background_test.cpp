// The measures of the paper's background against dense formulas of their own, written with inverses
// and determinants that the library avoids.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

#include "lib/math/decompositions.h"
#include "maxwrench/load.h"
#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/method.h"
#include "tests/support/edited_copy.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

Capability evaluate(const Problem& problem, const std::string& measure, Wrench wrench,
                    const Posture& posture) {
  WrenchProgram program = make_wrench_program(problem, wrench);
  set_posture(posture, program);
  Capability capability;
  resolve(problem, {problem.name, measure, wrench})
      .make_measure()
      ->evaluate(posture, program, true, capability);
  EXPECT_EQ(capability.status, Status::kOptimal) << measure << ": " << capability.reason.c_str();
  EXPECT_TRUE(capability.residual.within(1e-9 * (1 + std::abs(capability.beta)))) << measure;
  return capability;
}

/// B^+ for full row rank.
Matrix right_inverse(const Matrix& B) { return B.transpose() * (B * B.transpose()).inverse(); }

/// W_u B^+.
Matrix weighted(const Robot& robot) {
  const Zonotope& set = robot.actuation;
  return set.u_min.cwiseAbs().cwiseMin(set.u_max.cwiseAbs()).cwiseInverse().asDiagonal() *
         right_inverse(set.B);
}

/// Random postures of the shipped robots and of random ones, with gravity low enough for the
/// actuators to hold them.
void at_random_postures(const std::function<void(const Problem&, const Posture&)>& check) {
  Random random(1);
  std::vector<Problem> problems = {load_problem("uvms/valve"), load_problem("uvms/lift"),
                                   load_problem("planar/force")};
  for (int i = 0; i < 10; ++i) {
    problems.push_back(random_problem(random, 4));
    problems.back().robot.gravity = 0.5;
  }
  for (Problem& problem : problems) {
    problem.reference = 3.5;
    problem.desired << 1, 2, 3, 0.5, 0.25, 0.125;
    PostureEvaluator model(problem, false);
    for (int i = 0; i < 50; ++i) check(problem, model.evaluate(random_theta_r(problem, random)));
  }
}

TEST(Background, ManipulabilityIsTheRootOfTheDeterminant) {
  at_random_postures([](const Problem& problem, const Posture& posture) {
    const Matrix A = problem.W_any.transpose() * posture.J;
    const double expected = std::sqrt((A * A.transpose()).determinant());
    const Capability found = evaluate(problem, "manipulability", Wrench::kPure, posture);
    EXPECT_NEAR(found.beta, expected, 1e-10 * expected);
    EXPECT_EQ(found.lambda.norm(), 0);
    EXPECT_EQ(found.w.size() + found.u.size(), 0);
    // det(J J') is the sum of all squared minors, of which the base's own is 1 (Cauchy, Binet).
    EXPECT_GE(found.beta, 1);
  });
}

TEST(Background, TransmissionRatioIsTheRadiusAlongC) {
  at_random_postures([](const Problem& problem, const Posture& posture) {
    const Vector a = posture.J.transpose() * problem.c;
    const Capability found = evaluate(problem, "transmission_ratio", Wrench::kPure, posture);
    EXPECT_NEAR(found.beta, 1 / a.norm(), 1e-12);
    EXPECT_LT((found.h - found.beta * problem.c).norm(), 1e-12);
    EXPECT_EQ(found.lambda.norm(), 0);
    const Vector b = weighted(problem.robot) * a;
    const double expected = 1 / b.norm();
    EXPECT_NEAR(evaluate(problem, "weighted_transmission_ratio", Wrench::kPure, posture).beta,
                expected, 1e-10 * expected);
  });
}

TEST(Background, TransmissionRatioWithAnyWrenchIsTheSupportOfTheEllipsoid) {
  at_random_postures([](const Problem& problem, const Posture& posture) {
    // max c'h over h'Q h <= 1 is sqrt(c'Q^-1 c).
    const Vector c_w = problem.W_any.transpose() * problem.c;
    for (const auto& [measure, K] :
         {std::pair<const char*, Matrix>{"transmission_ratio",
                                         Matrix::Identity(posture.J.cols(), posture.J.cols())},
          {"weighted_transmission_ratio", weighted(problem.robot)}}) {
      const Matrix G = K * posture.J.transpose() * problem.W_any;
      const double expected = std::sqrt(c_w.dot((G.transpose() * G).inverse() * c_w));
      const Capability found = evaluate(problem, measure, Wrench::kAny, posture);
      EXPECT_NEAR(found.beta, expected, 1e-9 * expected) << measure;
      EXPECT_NEAR(problem.c.dot(found.h), found.beta, 1e-9 * expected);
    }
  });
}

TEST(Background, WeightedTransmissionRatioIsTheEllipsoidWithoutLoad) {
  at_random_postures([](const Problem& problem, const Posture& posture) {
    Posture unloaded = posture;
    unloaded.tau_d.setZero();
    for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
      const Capability ratio = evaluate(problem, "weighted_transmission_ratio", wrench, posture);
      const Capability ellipsoid = evaluate(problem, "ellipsoid", wrench, unloaded);
      EXPECT_NEAR(ratio.beta, ellipsoid.beta, 1e-10 * ratio.beta);
      EXPECT_LT((ratio.beta_J - ellipsoid.beta_J).norm(), 1e-9 * ellipsoid.beta_J.norm());
    }
  });
}

TEST(Background, LeastEffortIsThatOfThePseudoinverse) {
  at_random_postures([](const Problem& problem, const Posture& posture) {
    const Matrix B_pinv = right_inverse(problem.robot.actuation.B);
    const Vector tau = posture.tau_d + 3.5 * (posture.J.transpose() * problem.c);
    const Vector u = B_pinv * tau;
    const Capability pure = evaluate(problem, "least_effort", Wrench::kPure, posture);
    EXPECT_NEAR(pure.beta, -u.squaredNorm(), 1e-10 * u.squaredNorm());
    EXPECT_LT((pure.u - u).norm(), 1e-10 * u.norm());
    EXPECT_LT((pure.h - 3.5 * problem.c).norm(), 1e-12);
    // Free components: least squares over an orthonormal basis of what is orthogonal to c.
    const Matrix W = problem.W_any;
    const Vector c_w = W.transpose() * problem.c;
    const Matrix Q = Matrix(c_w).householderQr().householderQ();
    const Matrix rest = W * Q.rightCols(W.cols() - 1);
    const Matrix A = B_pinv * posture.J.transpose() * rest;
    const double least = (u - A * (pseudo_inverse(A) * u)).squaredNorm();
    const Capability any = evaluate(problem, "least_effort", Wrench::kAny, posture);
    EXPECT_NEAR(any.beta, -least, 1e-8 * (1 + least));
    EXPECT_NEAR(problem.c.dot(any.h), 3.5, 1e-9);
  });
}

TEST(Background, LeastEffortOrdersAsTheTransmissionRatio) {
  // Without load and with limits of 1 N and 1 N m, |u| at c reference is reference / beta.
  const Problem problem = load_problem("planar/force");
  PostureEvaluator model(problem, false);
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const Posture& posture = model.evaluate(random_theta_r(problem, random));
    const double ratio =
        evaluate(problem, "weighted_transmission_ratio", Wrench::kPure, posture).beta;
    EXPECT_NEAR(evaluate(problem, "least_effort", Wrench::kPure, posture).beta,
                -1 / (ratio * ratio), 1e-12);
  }
}

TEST(Background, SaturatingWrenchIsTheSmallestRatio) {
  at_random_postures([](const Problem& problem, const Posture& posture) {
    const Zonotope& set = problem.robot.actuation;
    // The efforts of the least |W_u u| with B u = tau: u = V B' (B V B')^-1 tau, V = W_u^-2.
    const Vector limit = set.u_min.cwiseAbs().cwiseMin(set.u_max.cwiseAbs());
    const Matrix VBt = limit.cwiseAbs2().asDiagonal() * set.B.transpose();
    const Matrix K = VBt * (set.B * VBt).inverse();
    const Vector slope = K * (posture.J.transpose() * problem.c);
    const Vector load = K * posture.tau_d;
    double expected = kInfinity;
    for (Eigen::Index i = 0; i < slope.size(); ++i) {
      if (std::abs(slope[i]) < 1e-12) continue;
      const double left = slope[i] > 0 ? set.u_max[i] - load[i] : set.u_min[i] - load[i];
      expected = std::min(expected, left / slope[i]);
    }
    const Capability found = evaluate(problem, "saturating_wrench", Wrench::kPure, posture);
    EXPECT_NEAR(found.beta, expected, 1e-9 * (1 + std::abs(expected)));
    EXPECT_LE(found.beta, evaluate(problem, "linf_polytope", Wrench::kPure, posture).beta + 1e-9);
    if (problem.robot.name == "random") return;  // thrusters with unlike limits
    EXPECT_NEAR(found.beta, evaluate(problem, "l2_polytope", Wrench::kPure, posture).beta, 1e-9);
  });
}

TEST(Background, EllipsoidTraceIsTheTraceOfTheInverse) {
  at_random_postures([](const Problem& problem, const Posture& posture) {
    const Matrix G = weighted(problem.robot) * posture.J.transpose() * problem.W_any;
    const Matrix S = problem.W_any.transpose() * problem.desired.asDiagonal() * problem.W_any;
    const double expected = (S * G.transpose() * G * S).inverse().trace();
    const Capability found = evaluate(problem, "ellipsoid_trace", Wrench::kPure, posture);
    EXPECT_NEAR(found.beta, expected, 1e-9 * expected);
    EXPECT_EQ(found.lambda.norm(), 0);
    // Measured by twice the wrench, the radii are half.
    Problem doubled = problem;
    doubled.desired *= 2;
    EXPECT_NEAR(evaluate(doubled, "ellipsoid_trace", Wrench::kPure, posture).beta, expected / 4,
                1e-9 * expected);
  });
}

/// A vehicle that turns freely in the plane measures the same whichever way the end effector is to
/// point, if all wrenches are given in its axes.
TEST(Background, DesiredWrenchesAreInTheAxesOfTheFrame) {
  const Eigen::Vector2d theta_r(0.3, -0.7);
  double first = 0;
  for (const char* yaw : {"0", "0.7", "1.5707963267948966"}) {
    EditedCopy copy;
    copy.replace("force.toml", "0.17453292519943295", yaw);
    copy.replace("force.toml", "\"tz\"]",
                 "\"tz\"]\nframe = \"end_effector\"\ndesired = [10, 1, 1, 1, 1, 2]");
    const Problem problem = load_problem((copy.path() / "force.toml").string());
    PostureEvaluator model(problem, false);
    const double trace =
        evaluate(problem, "ellipsoid_trace", Wrench::kPure, model.evaluate(theta_r)).beta;
    if (first == 0) first = trace;
    EXPECT_NEAR(trace, first, 1e-9 * first) << yaw;
  }
}

TEST(Background, RobotsWithoutTheRankOrTheLimitsAreRejected) {
  Random random(3);
  Problem problem = random_problem(random, 2);
  Problem one_sided = problem;
  one_sided.robot.thrusters[0].force_min = 0;
  complete_actuation(one_sided.robot);
  EXPECT_THROW(make_saturating_wrench(one_sided.robot), std::invalid_argument);
  EXPECT_THROW(make_weighted_transmission_ratio(one_sided.robot), std::invalid_argument);
  EXPECT_THROW(make_ellipsoid_trace(one_sided), std::invalid_argument);
  EXPECT_NO_THROW(make_transmission_ratio(one_sided.robot));
  problem.robot.thrusters.resize(3);
  complete_actuation(problem.robot);
  EXPECT_THROW(make_transmission_ratio(problem.robot), std::invalid_argument);
  EXPECT_THROW(make_weighted_transmission_ratio(problem.robot), std::invalid_argument);
  EXPECT_THROW(make_least_effort(problem), std::invalid_argument);
  EXPECT_THROW(make_saturating_wrench(problem.robot), std::invalid_argument);
  EXPECT_THROW(make_ellipsoid_trace(problem), std::invalid_argument);
  EXPECT_NO_THROW(make_manipulability(problem));
}

TEST(Background, WhatHasNoValueSaysWhy) {
  const Problem problem = load_problem("planar/force");
  PostureEvaluator model(problem, false);
  Posture posture = model.evaluate(problem.theta_r_default);
  const auto status = [&](const char* measure, const Posture& at) {
    WrenchProgram program = make_wrench_program(problem, Wrench::kPure);
    set_posture(at, program);
    Capability capability;
    resolve(problem, {problem.name, measure})
        .make_measure()
        ->evaluate(at, program, false, capability);
    return capability.status;
  };
  Posture heavy = posture;
  heavy.tau_d[4] = 100;  // the elbow asks for another sign of the wrench than the shoulder
  heavy.tau_d[3] = -100;
  heavy.J(0, 3) = heavy.J(0, 4) = 0.1;
  EXPECT_EQ(status("saturating_wrench", heavy), Status::kInfeasible);
  posture.J.setZero();
  for (const char* measure : {"manipulability", "transmission_ratio", "least_effort",
                              "weighted_transmission_ratio", "ellipsoid_trace"}) {
    EXPECT_EQ(status(measure, posture), Status::kNumericalError) << measure;
  }
  EXPECT_EQ(status("saturating_wrench", posture), Status::kUnbounded);
  posture.tau_d = heavy.tau_d;  // no wrench helps an actuator, and two are overloaded
  EXPECT_EQ(status("saturating_wrench", posture), Status::kInfeasible);
}

}  // namespace
}  // namespace maxwrench
