#pragma once

#include <filesystem>
#include <string>

namespace maxwrench {

struct Answer;

/// One of the paper's tables beside ours.
struct PaperTable {
  std::string text;
  bool all_solved = true;
};

/// What branch and bound proves from the posture of an answer on, to 0.1 %: no posture has more.
/// NaN where no bound serves or none comes so near.
double proven_bound(const Answer& answer, int threads);

// Each solves its cases into values.csv and times.csv of the folder and writes its table, and
// figures if it has any, beside them.
PaperTable reproduce_planar(const std::filesystem::path& folder, int threads);
PaperTable reproduce_uvms(const std::filesystem::path& folder, int threads);
PaperTable reproduce_dual(const std::filesystem::path& folder, int threads);
/// Each trajectory that was found becomes a table trajectories/TASK_SCHEME.csv of the folder.
/// `budget` is that of each search.
PaperTable reproduce_motion(const std::filesystem::path& folder, int threads, long budget);

}  // namespace maxwrench
