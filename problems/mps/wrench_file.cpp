#include <fmt/format.h>

#include <array>

#include "maxwrench/mps.h"
#include "maxwrench/problem.h"
#include "problems/mps/writer.h"

namespace maxwrench {
namespace {

std::string wrench_name(const Problem& problem, const Matrix6Xd& W, Eigen::Index j) {
  if (j >= W.cols()) return fmt::format("w2_{}", j - W.cols() + 1);
  const Vector6d direction = W.col(j);
  if (W.cols() == 1 && direction == problem.c) return "w_c";
  for (int axis = 0; axis < 6; ++axis) {
    if (direction == Vector6d::Unit(axis)) return fmt::format("w_{}", kWrenchAxes[axis]);
  }
  return fmt::format("w_{}", j + 1);
}

/// Names of the rows of a balance.
std::vector<std::string> balance_names(const Robot& robot) {
  std::vector<std::string> names;
  for (const int axis : robot.base_axes) names.push_back(fmt::format("base_{}", kTwistAxes[axis]));
  for (const Joint& joint : robot.joints) names.push_back(joint.name);
  return names;
}

std::vector<std::string> effort_names(const Robot& robot) {
  std::vector<std::string> names;
  for (const Thruster& thruster : robot.thrusters) names.push_back(thruster.name);
  for (const Joint& joint : robot.joints) names.push_back(joint.name);
  return names;
}

/// Names of the rows and columns of an assembled trajectory program, in its order.
class TrajectoryNames {
 public:
  TrajectoryNames(const Problem& problem, const TrajectoryProgram& program)
      : problem_(problem),
        program_(program),
        balances_(balance_names(problem.robot)),
        efforts_(effort_names(problem.robot)) {}

  void write(LinearProgram& lp) const {
    for (int i = 0; i < program_.size(); ++i) add_instant(i, lp);
    for (int i = 0; i + 1 < program_.size(); ++i) {
      for (std::size_t j = 0; j < efforts_.size(); ++j) {
        if (program_.du_max(static_cast<Eigen::Index>(j), i) == kInfinity) continue;
        add_both("rate." + efforts_[j], i, lp);
      }
    }
    for (int i = 0; i + 1 < program_.size(); ++i) {
      for (std::size_t j = 0; j < efforts_.size(); ++j) {
        if (program_.lags(static_cast<int>(j), i)) add_both("command." + efforts_[j], i, lp);
      }
    }
    if (program_.peak < 0) {
      lp.col_names.emplace_back("t");
      for (int i = 0; i < program_.size(); ++i) add_both("above_t", i, lp);
    }
    for (int j = 0; j < program_.border(); ++j) lp.col_names.push_back(at("y", j));
    for (int row = 0; row < program_.R.rows(); ++row) add_both("row", row, lp);
  }

 private:
  static std::string at(const std::string& name, int i) { return fmt::format("{}.{}", name, i); }

  static void add_both(const std::string& name, int i, LinearProgram& lp) {
    lp.row_names.push_back(at(name, i));
    lp.col_names.push_back(at(name, i));
  }

  void add_instant(int i, LinearProgram& lp) const {
    const WrenchProgram& instant = program_.instants[static_cast<std::size_t>(i)];
    for (const std::string& name : balances_) lp.row_names.push_back(at(name, i));
    for (const std::string& name : efforts_) lp.col_names.push_back(at(name, i));
    // c may have turned with the end effector.
    const Matrix6Xd W = instant.W.cols() == 1 ? Matrix6Xd(problem_.c) : problem_.W_any;
    for (int j = 0; j < instant.columns(); ++j) {
      lp.col_names.push_back(at(wrench_name(problem_, W, j), i));
    }
    if (!program_.elastic() || i < program_.first_elastic) return;
    for (const char* sign : {"plus.", "minus."}) {
      for (const std::string& name : balances_) lp.col_names.push_back(at(sign + name, i));
    }
  }

  const Problem& problem_;
  const TrajectoryProgram& program_;
  std::vector<std::string> balances_, efforts_;
};

}  // namespace

std::string wrench_program_mps(const Problem& problem, const WrenchProgram& program) {
  LinearProgram lp = assemble(program);
  lp.row_names = balance_names(problem.robot);
  lp.col_names = effort_names(problem.robot);
  for (int j = 0; j < program.columns(); ++j) {
    lp.col_names.push_back(wrench_name(problem, program.W, j));
  }
  return mps_text(lp, problem.name);
}

std::string trajectory_program_mps(const Problem& problem, const TrajectoryProgram& program) {
  LinearProgram lp = assemble(program);
  TrajectoryNames(problem, program).write(lp);
  return mps_text(lp, problem.name);
}

}  // namespace maxwrench
