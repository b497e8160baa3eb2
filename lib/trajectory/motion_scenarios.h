#pragma once

#include <string>
#include <vector>

#include "maxwrench/problem.h"
#include "maxwrench/trajectory_program.h"

namespace maxwrench {

/// One scenario of a task in time: its limits of the efforts, and its wrench in world axes at the
/// start of the path. A task without a list has one. Limits and wrench last for the whole motion.
struct MotionScenario {
  ScenarioChoice choice;                ///< c is that of the start
  const Zonotope* actuation = nullptr;  ///< of the problem
  Matrix6Xd W = Matrix6Xd(6, 0);        ///< basis of the allowed wrenches; `hold`: no columns
  Eigen::VectorXd c_w;                  ///< objective by column (k)
};

/// The scenarios of a task in the order of `next`. The problem must outlive them.
std::vector<MotionScenario> motion_scenarios(const Problem& problem, Wrench wrench);
std::vector<MotionScenario> motion_scenarios(const Problem&& problem, Wrench wrench) = delete;

/// Makes block `peak` of each scenario the peak of an impulse.
void set_peak(const std::vector<MotionScenario>& scenarios, int peak, TrajectoryProgram& program);

/// What decides: the scenario whose multipliers pi of `of` have the largest sum, and its instant
/// with the largest one; the first of several. Without finite multipliers the first of all.
struct DecidingBlock {
  int scenario = 0, block = 0;  ///< block of the scenario
};
DecidingBlock deciding_block(const TrajectoryProgram& program, const Eigen::VectorXd& of);

/// The scenario of a proof that there is no value, as `describe`; "" if there is no list.
std::string infeasible_scenario(const Problem& problem,
                                const std::vector<MotionScenario>& scenarios,
                                const TrajectoryProgram& program,
                                const TrajectorySolution& solution);

}  // namespace maxwrench
