#include <memory>

#include "cli/cli.h"
#include "cli/progress.h"
#include "problems/loader.h"

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
    const Case c = options->read_case(problem);
    Progress progress("solve", c.budget);
    const Row row = solve(problem, c, options->thread_count(), progress.counter());
    progress.finish();
    exit_status = report(problem, row, options->json);
  });
}

}  // namespace maxwrench
