#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <tuple>

#include "maxwrench/load.h"
#include "solvers/solve/method.h"
#include "solvers/solve/row.h"
#include "solvers/solve/tank.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Options tried(const char* problem, const char* integrator, const char* scheme = "") {
  return {{.problem = problem, .scheme = scheme, .integrator = integrator}};
}

/// Two integrators agree, on 0.5 % less than was planned: of a posture, a turn and an impulse,
/// which peaks while thrusters lag behind.
TEST(Experiment, SLOW_IntegratorsReadTheSame) {
  for (const auto& [name, scheme, lag] : {std::tuple{"uvms/valve", "", 1e-4},
                                          {"mobile/trajectory", "spline", 1e-3},
                                          {"uvms/valve_impulse", "", 0.02}}) {
    const Problem problem = load_problem(name);
    const Answer a = experiment(problem, tried(name, "cvode", scheme));
    const Answer b = experiment(problem, tried(name, "ida", scheme));
    for (const Answer* row : {&a, &b}) {
      ASSERT_TRUE(row->has_value()) << name << " " << row->reason.str();
      EXPECT_EQ(row->status, Status::kReached);
      EXPECT_EQ(row->missed, "");
      EXPECT_NEAR(row->beta(), 0.995 * row->beta_linf, lag * row->beta_linf) << name;
      EXPECT_GT(row->evaluations, 1000);
    }
    EXPECT_EQ(a.beta_linf, b.beta_linf);
    EXPECT_NEAR(a.beta(), b.beta(), 1e-3 * a.beta()) << name;
    EXPECT_EQ(values(a).size(), value_columns().size());
  }
}

/// The default posture of the valve loads the first joint alone, whose limit is 9 N m.
TEST(Experiment, SLOW_TrajectoriesWhatThePostureHas) {
  const Answer row = experiment(load_problem("uvms/valve"), tried("uvms/valve", "cvode"));
  EXPECT_NEAR(row.beta_linf, 9, 1e-6);
}

/// A turn in 1.5 s has no efforts that balance it at its knots.
TEST(Experiment, WhatHasNoTrajectoryHasNoReading) {
  const char* name = "uvms/valve_trajectory_fast";
  Problem problem = load_problem(name);
  set_scheme("scheme", "ends", problem);
  const Answer row = experiment(problem, tried(name, "cvode", "ends"));
  EXPECT_EQ(row.status, Status::kInfeasible);
  EXPECT_FALSE(row.has_value());
  EXPECT_NE(row.reason.str(), "");
}

/// Thrusters and joints that hardly change let go of the posture while the wrench still grows.
TEST(Experiment, SLOW_ALostPostureHasNoReading) {
  Problem problem = load_problem("uvms/valve");
  problem.robot.u_rate_max.setConstant(0.1);
  const Answer row = experiment(problem, tried("uvms/valve", "cvode"));
  EXPECT_EQ(row.status, Status::kNoneFound);
  EXPECT_FALSE(row.has_value());
  EXPECT_EQ(row.reason.str(), "the posture was lost before the end");
}

TEST(Experiment, RejectsWhatIsNotSupported) {
  const Problem wall = load_problem("dual_arm/bar_wall"), valve = load_problem("uvms/valve");
  const Problem geared = load_problem("gallery/panda/lift");  // a finger that follows the other
  EXPECT_TRUE(supported_integrators(wall, "linf_polytope").empty());
  EXPECT_TRUE(supported_integrators(geared, "linf_polytope").empty());
  EXPECT_TRUE(supported_integrators(valve, "ellipsoid").empty());
  EXPECT_THROW(experiment(wall, tried("dual_arm/bar_wall", "cvode")), std::invalid_argument);
  EXPECT_THAT([&] { experiment(geared, tried("gallery/panda/lift", "cvode")); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("got a gear")));
  for (const char* name : {"arkode", "x", ""}) {
    EXPECT_THROW(experiment(valve, tried("uvms/valve", name)), std::invalid_argument);
  }
}

}  // namespace
}  // namespace maxwrench
