#include <fmt/format.h>

#include <array>

#include "maxwrench/mps.h"
#include "maxwrench/problem.h"
#include "problems/mps/writer.h"

namespace maxwrench {
namespace {

std::string wrench_name(const Problem& problem, const WrenchProgram& program, int j) {
  const Eigen::Index own = program.W.cols();
  if (j >= own) return fmt::format("w2_{}", j - own + 1);
  const Vector6d direction = program.W.col(j);
  if (own == 1 && direction == problem.c) return "w_c";
  for (int axis = 0; axis < 6; ++axis) {
    if (direction == Vector6d::Unit(axis)) return fmt::format("w_{}", kWrenchAxes[axis]);
  }
  return fmt::format("w_{}", j + 1);
}

}  // namespace

std::string wrench_program_mps(const Problem& problem, const WrenchProgram& program) {
  const Robot& robot = problem.robot;
  LinearProgram lp = assemble(program);
  for (const int axis : robot.base_axes)
    lp.row_names.push_back(fmt::format("base_{}", kTwistAxes[axis]));
  for (const Thruster& thruster : robot.thrusters) lp.col_names.push_back(thruster.name);
  for (const Joint& joint : robot.joints) {
    lp.row_names.push_back(joint.name);
    lp.col_names.push_back(joint.name);
  }
  for (int j = 0; j < program.columns(); ++j) {
    lp.col_names.push_back(wrench_name(problem, program, j));
  }
  return mps_text(lp, problem.name);
}

}  // namespace maxwrench
