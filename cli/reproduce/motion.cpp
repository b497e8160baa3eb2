#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "benchmarks/tables/write_file.h"
#include "cli/reproduce/reproduce.h"
#include "cli/suite/row_writer.h"
#include "cli/task/motion_options.h"
#include "maxwrench/figures.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "solvers/solve/active_limits.h"
#include "solvers/solve/method.h"
#include "solvers/solve/tank.h"
#include "view/scene/scene.h"
#include "view/still/still.h"

namespace maxwrench {
namespace {

/// One of the paper's experiments in time, with the measurements of its tank.
struct MotionTable {
  const char* problem;
  const char* title;
  const char *constant, *moving;  ///< names of their rows
  double tank_constant, tank_moving;
  const char* reading;  ///< which number of the virtual tank's load cell the table shows
};

constexpr MotionTable kMotionTables[] = {
    {"uvms/valve_trajectory", "torque throughout a turn by 180 degrees in 5 s", "fixed",
     "optimised", 16, 19, "least"},
    {"uvms/valve_impulse", "peak torque in an impulse of 2.5 s", "static", "impulse", 25, 35,
     "at t_h"},
};

constexpr double kWide = 0.5;  // m: bodies farther apart than this do not count as near

/// One row of a table; its problem must outlive it.
struct Moved {
  const Problem& problem;
  std::string name;
  Answer row;
  TrajectoryExperiment tank;

  double reading() const {
    const TankSummary& summary = tank.run.summary;
    return problem.motion->impulse ? summary.motion->at_peak : summary.low;
  }
  bool ran() const { return !tank.run.samples.empty(); }
};

/// The change of the value of the same table of theta_r under another task.
std::string rise(const Moved& moved, const MotionTask& other) {
  Problem problem = moved.problem;
  problem.motion = other;
  const Trajectory trajectory =
      evaluate(problem, moved.row.trajectory.knots, {moved.row.choice}).trajectory;
  const double risen = std::round(1000 * (trajectory.value - moved.row.trajectory.value)) / 1000;
  return std::isfinite(risen) ? fmt::format("{:>+8.3f}", risen + 0.0)
                              : in_column(risen);  // avoids -0
}

/// The least clearance between the bodies of the robot at the knots, beyond their margin.
std::string clearance(const Moved& moved) {
  TrajectoryEvaluator evaluator(moved.problem, Wrench::kPure, trajectory_solvers().front().make);
  double least = kWide;
  for (const NearPair& pair : evaluator.near_pairs(moved.row.trajectory.knots, kWide)) {
    least = std::min(least, pair.clearance);
  }
  return least < kWide ? fmt::format("{:>7.3f}", least + 0.0) : fmt::format("{:>7}", "far");
}

std::string limits_line(const Moved& moved) {
  const Robot& robot = moved.problem.robot;
  MotionTask no_rates = *moved.problem.motion, free_start = no_rates;
  no_rates.rates = false;
  free_start.start = Start::kFree;
  return fmt::format("{:<9} {:<9} {} {} {}  {:<24} {}\n", to_string(moved.problem.motion->scheme),
                     moved.name, rise(moved, no_rates),
                     free_start.impulse ? rise(moved, free_start) : fmt::format("{:>8}", "-"),
                     clearance(moved), fastest_joint(robot, moved.row.trajectory),
                     dearest_efforts(moved.row));
}

/// The planned value in the virtual tank, and its result.
std::string tank_cells(const Moved& moved) {
  const TankScript& script = moved.tank.script;
  const TankSummary& summary = moved.tank.run.summary;
  const std::string asked = in_column((1 - script.margin) * script.planned);
  if (!moved.ran()) return fmt::format("{} {} {:>6} {:>4}", asked, in_column(NAN), "-", "-");
  const char* held = summary.held ? "yes" : summary.theta_r_error < kLost ? "no" : "lost";
  return fmt::format("{} {} {:>6.3f} {:>4}", asked, in_column(moved.reading()),
                     summary.configuration_error, held);
}

/// `constant` is the row of the same scheme that the gain refers to.
std::string value_line(const MotionTable& table, const Moved& moved, const Moved& constant) {
  const Trajectory& trajectory = moved.row.trajectory;
  const bool found = &moved != &constant;
  const bool both = moved.ran() && constant.ran();
  return fmt::format("{:<9} {:<9} {} {}   {}  {:>5.1f}  {} {} {:>6.2f}\n",
                     to_string(moved.problem.motion->scheme), moved.name,
                     in_column(trajectory.value), in_column(trajectory.value_between_knots),
                     tank_cells(moved), found ? table.tank_moving : table.tank_constant,
                     in_column(trajectory.value / constant.row.trajectory.value, 6),
                     in_column(both ? moved.reading() / constant.reading() : NAN, 7),
                     found ? table.tank_moving / table.tank_constant : 1);
}

/// The constant default and the trajectory that the search finds, both simulated in the virtual
/// tank.
std::vector<Moved> solve_scheme(RowWriter& writer, const MotionTable& table, const Problem& problem,
                                const std::filesystem::path& folder, long budget) {
  const Case c{.budget = budget};
  std::vector<Moved> rows;
  const auto add = [&](const char* name, const Answer& row) {
    Moved& moved = rows.emplace_back(Moved{problem, name, row, {}});
    const ScriptOptions script{.interpolation = usual_interpolation(problem)};
    moved.tank =
        simulate_trajectory(problem, row.trajectory, Wrench::kPure,
                            find_trajectory_solver(row.choice.solver), script, "cvode", {});
  };
  add(table.constant, writer.evaluate(problem, c, problem.theta_r_default));
  const Answer found = writer.solve(problem, c);
  if (!found.has_value()) return rows;
  add(table.moving, found);
  write_file(trajectory_file(folder, problem), knots_csv(problem, found.trajectory.knots));
  return rows;
}

/// Writes the paper's figures of a task in time, for the scheme that defines the motion between
/// instants.
void write_motion_figures(const MotionTable& table, const std::vector<Moved>& rows,
                          const std::filesystem::path& folder) {
  const Moved& found = rows.back();
  std::string name = table.problem;
  std::replace(name.begin(), name.end(), '/', '_');
  std::vector<TankCurve> curves;
  for (const Moved& row : rows) {
    if (row.ran()) curves.push_back({row.name, &row.tank.run});
  }
  if (!curves.empty()) {
    write_file(folder / (name + ".svg"), motion_figure(found.problem, curves));
  }
  const std::vector<double> times = telling_times(*found.problem.motion, found.row.trajectory);
  write_file(folder / (name + "_postures.svg"),
             trajectory_figure(found.problem, found.row.trajectory, times));
  const auto scene =
      scene_of(found.problem, read_visuals(found.problem.robot, {}), {{"best", found.row}});
  write_file(folder / (name + "_stills.svg"), still_figure(scene, times));
}

/// The schemes of the table; for an impulse, without the one that ends at rest, which was not
/// measured.
std::vector<std::string> schemes_of_table(const Problem& problem) {
  std::vector<std::string> schemes = scheme_names(problem.motion->impulse);
  std::erase(schemes, to_string(Scheme::kBackwardStop));
  return schemes;
}

std::string motion_table(RowWriter& writer, const MotionTable& table,
                         const std::filesystem::path& folder, long budget) {
  Problem problem = load_problem(table.problem);
  std::string text = fmt::format(
      "{}: {}, {} ({})\n"
      "                                       ------ virtual tank ------   paper  ------- gain "
      "-------\n"
      "scheme    found_by     value  between      asked {:>8}  error held   tank   value reading   "
      "tank\n",
      problem.name, table.title, problem.unit(), problem.label, table.reading);
  std::string limits =
      "  what limits the trajectory:\n"
      "scheme    found_by  no rates   start  clear.  fastest joint            efforts at their "
      "limits, the costliest first\n";
  for (const std::string& scheme : schemes_of_table(problem)) {
    set_scheme("scheme", scheme, problem);
    const std::vector<Moved> rows = solve_scheme(writer, table, problem, folder, budget);
    for (const Moved& row : rows) {
      text += value_line(table, row, rows.front());
      if (row.row.has_value()) limits += limits_line(row);
    }
    if (rows.size() < 2) text += fmt::format("{:<9} no trajectory found\n", scheme);
    if (scheme == to_string(Scheme::kSpline)) write_motion_figures(table, rows, folder);
  }
  return text + limits;
}

}  // namespace

std::string in_column(double value, int width, int digits) {
  return std::isfinite(value) ? fmt::format("{:>{}.{}f}", value, width, digits)
                              : fmt::format("{:>{}}", "none", width);
}

std::filesystem::path trajectory_file(const std::filesystem::path& folder, const Problem& problem,
                                      const char* suffix) {
  std::string file =
      fmt::format("{}_{}{}.csv", problem.name, to_string(problem.motion->scheme), suffix);
  std::replace(file.begin(), file.end(), '/', '_');
  return folder / "trajectories" / file;
}

PaperTable reproduce_motion(const std::filesystem::path& folder, int threads, long budget) {
  long rows = 0;
  for (const MotionTable& table : kMotionTables) {
    rows += 2 * static_cast<long>(schemes_of_table(load_problem(table.problem)).size());
  }
  RowWriter writer("reproduce motion", folder, threads, rows);
  std::string text = fmt::format(
      "The underwater vehicle along a path and in an impulse. Values are those of a model of\n"
      "public data, nothing is tuned to the tank; tank: measured in the paper. fixed, static: the\n"
      "default posture of the task throughout, which is the best static one of uvms/valve; the\n"
      "others: the best trajectory that search {} found with seed {} and at most {} evaluations\n"
      "(trajectories/TASK_SCHEME.csv). between: the value on the spline through the knots, none\n"
      "where no efforts achieve it. The virtual tank requests {:g} % less than the value and\n"
      "interpolates between the instants as the scheme does (spline: with the efforts of\n"
      "between); error: of all joints and the base from the trajectory, rad or m; held: the\n"
      "reading is within {:g} % of the trajectory along the whole path or at t_h, and error and\n"
      "limits are kept; lost: the error ended the experiment.\n"
      "gain: over the constant posture of the same scheme, of the value, of the virtual tank's\n"
      "reading, and of the paper's tank. no rates, start: the increase of the value at the same\n"
      "knots without limits of effort rates, and from any efforts at the start; clear.: least\n"
      "distance of bodies at knots beyond their margin, m; fastest joint: share of its speed\n"
      "limit at an instant.\n",
      trajectory_searches().front().name, Case().seed, budget, 100 * TankOptions().margin,
      100 * kTrackedWrenchError);
  for (const MotionTable& table : kMotionTables) {
    text += "\n" + motion_table(writer, table, folder, budget);
  }
  const bool all_solved = writer.finish();
  write_file(folder / "uvms_motion.txt", text);
  return {text, all_solved};
}

}  // namespace maxwrench
