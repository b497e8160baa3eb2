#include "cli/wrench_file.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <stdexcept>

#include "problems/mps/writer.h"

namespace maxwrench {
namespace {

std::string wrench_name(const Problem& problem, const WrenchProgram& program, int j) {
  static constexpr std::array<const char*, 6> kAxes = {"fx", "fy", "fz", "mx", "my", "mz"};
  const Eigen::Index own = program.W.cols();
  if (j >= own) return fmt::format("w2_{}", j - own + 1);
  const Vector6d direction = program.W.col(j);
  if (own == 1 && direction == problem.c) return "w_c";
  for (int axis = 0; axis < 6; ++axis) {
    if (direction == Vector6d::Unit(axis)) return fmt::format("w_{}", kAxes[axis]);
  }
  return fmt::format("w_{}", j + 1);
}

}  // namespace

void write_wrench_program(const Problem& problem, const WrenchProgram& program,
                          const std::string& file) {
  static constexpr std::array<const char*, 6> kAxes = {"x", "y", "z", "roll", "pitch", "yaw"};
  const Robot& robot = problem.robot;
  LinearProgram lp = assemble(program);
  for (const int axis : robot.base_axes)
    lp.row_names.push_back(fmt::format("base_{}", kAxes[axis]));
  for (const Thruster& thruster : robot.thrusters) lp.col_names.push_back(thruster.name);
  for (const Joint& joint : robot.joints) {
    lp.row_names.push_back(joint.name);
    lp.col_names.push_back(joint.name);
  }
  for (int j = 0; j < program.columns(); ++j) {
    lp.col_names.push_back(wrench_name(problem, program, j));
  }
  std::ofstream out(file);
  out << mps_text(lp, problem.name);
  out.close();
  if (!out) {
    throw std::invalid_argument(fmt::format("--write: got '{}', expected a writable file", file));
  }
}

}  // namespace maxwrench
