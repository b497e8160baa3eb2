#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/method.h"
#include "tests/support/support.h"

namespace maxwrench {

/// The loop of a search over points with values, with gradients, allocates nothing after it has
/// seen them once. Solver `facets` scans the list by facets.
inline void expect_no_allocations(const Problem& task, const std::string& solver,
                                  const std::vector<Eigen::VectorXd>& points) {
  PostureEvaluator model(task, false);
  WrenchProgram program = make_wrench_program(task, Wrench::kPure);
  const auto measure = make_scenario_polytope(
      task, Wrench::kPure, find_wrench_solver(solver).make(), solver == "facets");
  Capability capability;
  Eigen::VectorXd gradient;
  const auto run = [&](const Eigen::VectorXd& theta_r) {
    evaluate_best(model, theta_r, *measure, false, program, capability);
    EXPECT_EQ(capability.status, Status::kOptimal);
    model.pull_back(theta_r, capability, gradient);
  };
  for (const Eigen::VectorXd& point : points) run(point);
  const long before = allocation_count();
  for (const Eigen::VectorXd& point : points) run(point);
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace maxwrench
