#include <memory>

#include "benchmarks/row.h"
#include "cli/cli.h"
#include "cli/ctrl_c.h"
#include "cli/progress.h"
#include "maxwrench/load.h"

namespace maxwrench {

void add_solve(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<CommonOptions>();
  CLI::App& command =
      *app.add_subcommand("solve", "search the posture with the largest capability");
  options->add_case(command);
  options->add_search(command);
  options->add_threads(command);
  options->add_json(command);
  command.callback([options, &exit_status] {
    const Problem problem = load_problem(options->choice.problem);
    const Method method = resolve(problem, options->read_case());
    Progress progress("solve", method.choice.budget);
    CtrlC ctrl_c;
    const Row row =
        solve(problem, method, options->thread_count(), progress.counter(), &ctrl_c.interruption);
    progress.finish();
    exit_status = report(problem, row, options->json);
  });
}

}  // namespace maxwrench
