// The best posture of a task, or the best trajectory of a task in time: solve [TASK]
#include "maxwrench/solve.h"

#include <cstdio>
#include <exception>

#include "maxwrench/load.h"

using namespace maxwrench;

int main(int argc, char** argv) try {
  const Problem task = load_problem(argc > 1 ? argv[1] : "planar/force");
  const Answer before = evaluate(task, task.theta_r_default);
  const Answer best = solve(task);
  std::printf("default %.6f %s, best %.6f %s\n\n%s", before.beta(), before.unit.c_str(),
              best.beta(), best.unit.c_str(), summary(best).c_str());
  return best.answered() ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "solve: %s\n", error.what());
  return 2;
}
