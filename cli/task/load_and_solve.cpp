#include "cli/task/load_and_solve.h"

#include <utility>

#include "cli/ctrl_c.h"
#include "cli/progress.h"

namespace maxwrench {
namespace {

template <class Run>
auto with_progress(const char* command, const Problem& problem, Options how, const Run& run) {
  static_cast<Case&>(how) = with_search(problem, how);
  Progress progress(command, static_cast<double>(how.budget));
  CtrlC ctrl_c;
  how.progress = progress.counter();
  how.interrupted = ctrl_c.asked();
  auto result = run(how);
  progress.finish();
  return result;
}

}  // namespace

Problem load_apart(const std::string& problem, const ProblemOptions& source,
                   const MotionOptions& motion, const std::vector<NamedFile>& inputs,
                   const std::vector<NamedFile>& outputs) {
  std::vector<NamedFile> read = source.inputs(problem);
  read.insert(read.end(), inputs.begin(), inputs.end());
  require_apart(read, outputs);
  Problem task = source.load(problem);
  motion.change(task);
  if (task.motion) require_apart({{"path.file", task.motion->path_file}}, outputs);
  return task;
}

Answer solve_with_progress(const char* command, const Problem& problem, Options how) {
  return with_progress(command, problem, std::move(how),
                       [&](const Options& options) { return solve(problem, options); });
}

TrajectoryProof solve_proven_with_progress(const char* command, const Problem& problem,
                                           Options how) {
  return with_progress(command, problem, std::move(how),
                       [&](const Options& options) { return solve_proven(problem, options); });
}

}  // namespace maxwrench
