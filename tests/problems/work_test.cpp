#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "maxwrench/load.h"
#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "tests/support/bad_input.h"
#include "tests/support/edited_copy.h"

namespace maxwrench {
namespace {

using testing::Each;

// What the structure takes is no wrench of the robot's: nothing would bound it.

constexpr const char* kAny = "any = [\"fx\", \"fy\", \"tz\"]";
constexpr const char* kBasis =
    "\n[[contact.basis]]\ndirection = [0.5, 0, 1, 0, 0, 0]\nmin = 0\n\n"
    "[[contact.basis]]\ndirection = [-0.5, 0, 1, 0, 0, 0]\nmin = 0\n";

Problem load_edited(const EditedCopy& copy, const std::string& task) {
  return load_problem((copy.path() / (task + ".toml")).string());
}

Matrix6Xd units(std::initializer_list<int> axes) {
  Matrix6Xd W(6, static_cast<Eigen::Index>(axes.size()));
  Eigen::Index column = 0;
  for (const int axis : axes) W.col(column++) = Vector6d::Unit(axis);
  return W;
}

/// The vehicle cannot be lifted, rolled or pitched; it resists all else.
TEST(Work, APlanarRobotExertsWrenchesInItsPlane) {
  EditedCopy copy;
  copy.replace("force.toml", kAny, "");
  EXPECT_EQ(load_edited(copy, "force").W_any, units({0, 1, 5}));
}

/// As above, the plane turned by 0.5 rad about x: its normal is (0, -sin, cos).
TEST(Work, OfATiltedPlaneToo) {
  EditedCopy copy;
  copy.replace("force.toml", kAny, "");
  copy.replace("force.toml", "rpy = [0, 0, 0.17453292519943295]", "rpy = [0.5, 0, 0.17]");
  copy.replace("vehicle.toml", "[base]", "[base]\nrpy = [0.5, 0, 0]");
  const Problem problem = load_edited(copy, "force");
  const Matrix6Xd& W = problem.W_any;
  ASSERT_EQ(W.cols(), 3);
  EXPECT_TRUE((W.transpose() * W).isIdentity(1e-14));
  const Eigen::Vector3d normal(0, -std::sin(0.5), std::cos(0.5));
  const Eigen::Vector3d forces = W.topRows<3>().transpose() * normal;
  EXPECT_LT(forces.norm(), 1e-14);
  EXPECT_LT((normal.cross(Eigen::Vector3d::UnitX()).transpose() * W.bottomRows<3>()).norm(), 1e-14);
  EXPECT_LT(W.row(3).norm(), 1e-14);
  EXPECT_LT((W * W.transpose() * problem.c - problem.c).norm(), 1e-14);
}

/// c leans out of the plane. Its own direction stays, what lies across it in the plane is free.
TEST(Work, WhatTheStructureTakesOfCIsNotFreed) {
  EditedCopy copy;
  copy.replace("force.toml", kAny, "");
  copy.replace("force.toml", "[1, 0, 0, 0, 0, 0]", "[3, 0, 4, 0, 0, 0]");
  const Problem problem = load_edited(copy, "force");
  ASSERT_EQ(problem.W_any.cols(), 3);
  EXPECT_EQ(problem.W_any.col(0), problem.c);
  Matrix6Xd plane(6, 3);
  plane << problem.c, Vector6d::Unit(1), Vector6d::Unit(5);
  EXPECT_LT((problem.W_any * problem.W_any.transpose() - plane * plane.transpose()).norm(), 1e-14);
}

const std::vector<ChangedProblem> kIdleWrenches = {
    {"c_across_the_plane",
     "force.toml",
     "c = [1, 0, 0, 0, 0, 0]\nany = [\"fx\", \"fy\", \"tz\"]",
     "c = [0, 0, 1, 0, 0, 0]",
     {"wrench.c: got [0, 0, 1, 0, 0, 0]", "does work"}},
    {"any_across_the_plane",
     "force.toml",
     kAny,
     "any = [\"fx\", \"fz\", \"fy\"]",
     {"wrench.any: got ['fx', 'fz', 'fy']", "0, 0, 1, 0, 0, 0] does none"}},
};

class IdleWrench : public testing::TestWithParam<ChangedProblem> {};

TEST_P(IdleWrench, IsRejected) { expect_rejected(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Work, IdleWrench, testing::ValuesIn(kIdleWrenches),
                         [](const auto& test) { return std::string(test.param.name); });

const std::vector<ChangedProblem> kIdleContacts = {
    {"direction_across_the_plane",  // the contact frame's y is the world's z
     "two_arms.toml",
     "direction = [-0.5, 0, 1, 0, 0, 0]\nmin = 0",
     "direction = [0, 2, 0, 0, 0, 0]\nmax = 1",
     {"contact.basis[1].direction: got [0, 2, 0, 0, 0, 0]", "does work"}},
    {"directions_whose_difference_is_idle",
     "two_arms.toml",
     kBasis,
     "\n[[contact.basis]]\ndirection = [0, 1, 1, 0, 0, 0]\n\n"
     "[[contact.basis]]\ndirection = [0, 0, 1, 0, 0, 0]\n",
     {"contact.basis: got 2 directions without limits", "independently of each other, 1 of these"}},
    {"push_across_the_plane",
     "two_arms.toml",
     "forces = \"basis\"\nsurface = \"line\"\n# A wall across x, ahead of the second arm; the "
     "contact frame's x is the world's y, its z the world's x.\nxyz = [-0.02, -0.25, 0]\n"
     "rpy = [1.5707963267948966, 0, 1.5707963267948966]",
     "forces = \"push\"\nsurface = \"line\"\nxyz = [-0.02, -0.25, 0]\nrpy = [0, 0, 0]",
     {"contact.rpy: got [0, 0, 0]", "can move"}},
};

class IdleContact : public testing::TestWithParam<ChangedProblem> {};

TEST_P(IdleContact, IsRejected) { expect_rejected(GetParam(), "planar/two_arms"); }

INSTANTIATE_TEST_SUITE_P(Work, IdleContact, testing::ValuesIn(kIdleContacts),
                         [](const auto& test) { return std::string(test.param.name); });

Problem two_arms(const std::string& forces) {
  EditedCopy copy;
  copy.replace("two_arms.toml", kBasis, "");
  copy.replace("two_arms.toml", "forces = \"basis\"", forces);
  return load_edited(copy, "two_arms");
}

/// The contact frame's x and z span the plane. Every solver gives the same beta with a finite
/// force.
TEST(Work, ASecondContactInAPlaneHasForcesInThePlane) {
  const Problem problem = two_arms("forces = \"point\"");
  ASSERT_EQ(problem.contact->C, units({0, 2}));
  PostureEvaluator model(problem);
  const Posture& posture = model.evaluate(problem.theta_r_default);
  ASSERT_EQ(posture.status, Status::kValid) << posture.reason.c_str();
  double beta = 0;
  for (const WrenchSolverEntry& entry : wrench_solvers()) {
    if (entry.one_column_only) continue;
    WrenchProgram program = make_wrench_program(problem, Wrench::kAny);
    set_posture(posture, program);
    Capability capability;
    find_measure("linf_polytope")
        .make(problem, entry.make())
        ->evaluate(posture, program, true, capability);
    ASSERT_EQ(capability.status, Status::kOptimal)
        << entry.name << ": " << capability.reason.c_str();
    // Joints of 1 N m with levers of centimetres: at most some hundred newtons.
    EXPECT_LT(capability.h_2.norm(), 1000) << entry.name;
    EXPECT_LT(std::abs(capability.h_2[2]), 1e-12) << entry.name;
    if (beta == 0) beta = capability.beta;
    EXPECT_NEAR(capability.beta, beta, 1e-6) << entry.name;
  }
}

/// The pyramid's edges e_z +- mu e_x stay, those along y keep their part in the plane.
TEST(Work, FrictionInAPlaneStaysInThePlane) {
  const Problem problem = two_arms("forces = \"friction\"\nmu = 0.5");
  Matrix6Xd C = Matrix6Xd::Zero(6, 4);
  C.row(0) << 0.5, -0.5, 0, 0;
  C.row(2).setOnes();
  EXPECT_EQ(problem.contact->C, C);
  EXPECT_THAT(problem.contact->w_min, Each(0));
}

/// In space the second contact is as the task says.
TEST(Work, InSpaceNothingIsLeftOut) {
  EXPECT_EQ(load_problem("fixed/push").W_any, units({0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(load_problem("mobile/push").W_any, units({0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(load_problem("dual_arm/bar_wall").contact->C, units({2}));
  EXPECT_EQ(load_problem("dual_arm/two_arms").contact->C, units({0, 1, 2}));
}

}  // namespace
}  // namespace maxwrench
