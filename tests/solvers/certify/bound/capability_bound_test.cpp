#include <gtest/gtest.h>

#include <cmath>

#include "maxwrench/bound.h"
#include "maxwrench/load.h"
#include "maxwrench/objective.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "tests/support/boxes.h"
#include "tests/support/free_poses.h"

namespace maxwrench {
namespace {

struct BoundForm {
  const char* measure;
  Wrench wrench;
};

const std::vector<BoundForm> kBoundForms = {{"linf_polytope", Wrench::kPure},
                                            {"linf_polytope", Wrench::kAny},
                                            {"l2_polytope", Wrench::kPure},
                                            {"ellipsoid", Wrench::kPure}};

const std::vector<const char*> kBoundProblems = {"planar/force", "uvms/valve", "uvms/lift",
                                                 "random", "free"};

/// A shipped problem, or one with a sliding joint, or with a pose that is partly free.
Problem bounded_problem(const std::string& name) {
  Random random(8);
  if (name == "free") return with_free_pose(random_problem(random, 2), {{1, 3, 5}, true, true});
  return name == "random" ? random_problem(random, 4) : load_problem(name);
}

MeasureMaker maker(const Problem& problem, const BoundForm& form) {
  return [&problem, form] {
    const bool one = form.wrench == Wrench::kPure;
    return find_measure(form.measure)
        .make(problem, find_wrench_solver(one ? "facets" : "condensed").make());
  };
}

class BoundOf : public testing::TestWithParam<std::tuple<const char*, BoundForm>> {};

std::string form_name(const testing::TestParamInfo<BoundOf::ParamType>& of) {
  std::string name = std::get<0>(of.param);
  const BoundForm& form = std::get<1>(of.param);
  name += std::string("_") + form.measure + (form.wrench == Wrench::kAny ? "_any" : "_pure");
  for (char& c : name) c = c == '/' ? '_' : c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(Forms, BoundOf,
                         testing::Combine(testing::ValuesIn(kBoundProblems),
                                          testing::ValuesIn(kBoundForms)),
                         form_name);

/// 100,000 pairs of a box and a posture in it for each form. Every other bound starts at the
/// multiplier of some other box; what is not of interest ends anywhere below the value.
TEST_P(BoundOf, NoPostureIsAbove) {
  const auto& [name, form] = GetParam();
  const Problem problem = bounded_problem(name);
  const auto bound = make_capability_bound(problem, form.measure, form.wrench);
  const auto objective =
      make_capability_objective(problem, form.wrench, maker(problem, form), false);
  Random random(1);
  BoxProof proof;
  int bounded = 0;
  for (int pair = 0; pair < samples(10000); ++pair) {
    const RandomBox box = random_box(problem, random);
    const double value = objective->evaluate(box.inside);
    if (value == -kInfinity) continue;
    EXPECT_GE(bound->ceiling(), value);
    if (pair % 2 == 0) proof = {};
    const double low = value - random.uniform(0, 1) * std::abs(value) - 1e-9;
    const double high =
        std::min(bound->ceiling(), 10 + value + random.uniform(0, 2) * std::abs(value));
    bound->evaluate(box.lower, box.upper, low, high, proof);
    EXPECT_LE(proof.high, high);
    if (proof.kind == BoxProof::Kind::kCollision) {
      PostureEvaluator model(problem);
      EXPECT_EQ(model.evaluate(box.inside).violation, Violation::kCollision);
      proof = {};
      continue;
    }
    ++bounded;
    EXPECT_GE(std::max(low, proof.high), value) << box.lower << '\n' << box.upper;
  }
  EXPECT_GT(bounded, samples(800));
}

/// A box of no width is its posture: the bound is the value.
TEST_P(BoundOf, IsExactAtAPoint) {
  const auto& [name, form] = GetParam();
  Problem problem = bounded_problem(name);
  problem.robot.collision = nullptr;
  const auto bound = make_capability_bound(problem, form.measure, form.wrench);
  const auto objective =
      make_capability_objective(problem, form.wrench, maker(problem, form), false);
  Random random(2);
  for (int sample = 0; sample < 50; ++sample) {
    const Eigen::VectorXd theta_r = random_theta_r(problem, random);
    const double value = objective->evaluate(theta_r);
    if (value == -kInfinity) continue;
    BoxProof proof;
    const double size = 1 + std::abs(value);
    bound->evaluate(theta_r, theta_r, value - 1e-4 * size, std::min(bound->ceiling(), 1e4), proof);
    EXPECT_NEAR(proof.high, value, 2e-6 * size);
  }
}

std::string rejection(const std::string& name, const char* measure, Wrench wrench) {
  const Problem problem = load_problem(name);
  try {
    make_capability_bound(problem, measure, wrench);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(CapabilityBound, RejectsWhatItDoesNotSupport) {
  const auto rejected = [](const std::string& name, const char* measure, Wrench wrench,
                           const char* word) {
    const std::string text = rejection(name, measure, wrench);
    EXPECT_NE(text.find(word), std::string::npos) << name << ": " << text;
    EXPECT_NE(text.find("expected"), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  };
  rejected("uvms/valve_trajectory", "linf_polytope", Wrench::kPure, "task in time");
  rejected("dual_arm/bar_wall", "ellipsoid", Wrench::kPure, "ellipsoid");
  rejected("dual_arm/bar_alone", "linf_polytope", Wrench::kAny, "second contact");
  rejected("fixed/push", "l2_polytope", Wrench::kAny, "any");
  rejected("planar/force", "manipulability", Wrench::kPure, "manipulability");
  rejected("planar/force", "ellipsoid", Wrench::kAny, "any");
  EXPECT_EQ(rejection("planar/force", "ellipsoid", Wrench::kPure), "");
}

/// A base that does not turn limits no torque, and one without z no force that joints may turn to
/// z.
TEST(CapabilityBound, RejectsWhatTheFreeAxesDoNotLimit) {
  Random random(3);
  Problem problem = random_problem(random, 4);
  const auto rejects = [&problem](const std::vector<int>& axes, const Vector6d& c) {
    problem.robot.base_axes = axes;
    complete_actuation(problem.robot);
    problem.c = c;
    try {
      make_capability_bound(problem, "linf_polytope", Wrench::kPure);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what()).find("free axes do not limit") != std::string::npos;
    }
    return false;
  };
  const Vector6d force = Vector6d::Unit(0), torque = Vector6d::Unit(3);
  EXPECT_FALSE(rejects({0, 1, 2, 3, 4, 5}, force));
  EXPECT_FALSE(rejects({0, 1, 2}, force));
  EXPECT_TRUE(rejects({0, 1, 2}, torque));
  EXPECT_TRUE(rejects({0, 1, 3, 4, 5}, force));
  EXPECT_FALSE(rejects({3, 4, 5}, torque));
  EXPECT_TRUE(rejects({3, 4, 5}, force));
}

/// With shares, 7 joints and 4 coordinates that enter as themselves have 3^7 2^4 = 34,992 control
/// points.
TEST(CapabilityBound, TakesTwoArmsThatBothExertForces) {
  const Problem problem = load_problem("dual_arm/two_arms");
  EXPECT_NO_THROW(make_capability_bound(problem, "linf_polytope", Wrench::kPure));
  EXPECT_NO_THROW(make_capability_bound(problem, "l2_polytope", Wrench::kPure));
}

/// A torque at the second contact is in no balance of forces of the base.
TEST(CapabilityBound, RejectsWhatNothingLimits) {
  Problem problem = load_problem("planar/two_arms");
  EXPECT_NO_THROW(make_capability_bound(problem, "linf_polytope", Wrench::kPure));
  problem.contact->C.col(0) << 0, 0, 0, 0, 0, 1;
  EXPECT_THROW(make_capability_bound(problem, "linf_polytope", Wrench::kPure),
               std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
