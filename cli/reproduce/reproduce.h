#pragma once

#include <filesystem>
#include <string>

namespace maxwrench {

struct Answer;
struct Problem;

/// One of the paper's tables, with our values.
struct PaperTable {
  std::string text;
  bool all_solved = true;
};

/// The bound on all postures that branch and bound proves to 0.1 %, starting from the posture of an
/// answer. NaN if no bound is supported or none is near enough.
double proven_bound(const Answer& answer, int threads);

/// The number in a column; "none" if it is not finite.
std::string in_column(double value, int width = 8, int digits = 2);

/// The table trajectories/TASK_SCHEME.csv of the folder, with a suffix behind SCHEME.
std::filesystem::path trajectory_file(const std::filesystem::path& folder, const Problem& problem,
                                      const char* suffix = "");

// Each function solves its cases, writes them to values.csv and times.csv of the folder, and writes
// its table, and its figures if any, to the same folder.
PaperTable reproduce_planar(const std::filesystem::path& folder, int threads);
PaperTable reproduce_uvms(const std::filesystem::path& folder, int threads);
PaperTable reproduce_dual(const std::filesystem::path& folder, int threads);
/// Also writes each trajectory found to a table trajectories/TASK_SCHEME.csv of the folder.
/// `budget` is the budget of each search.
PaperTable reproduce_motion(const std::filesystem::path& folder, int threads, long budget);
/// What the trajectories of `reproduce_motion` in the folder, and the best ones that are proven,
/// are worth when executed. Writes no rows, but the proven trajectories, to
/// trajectories/TASK_SCHEME_proven.csv, and those planned for the lag of the tank's thrusters to
/// trajectories/TASK_SCHEME_lag.csv.
PaperTable reproduce_tank(const std::filesystem::path& folder, int threads, long budget);

}  // namespace maxwrench
