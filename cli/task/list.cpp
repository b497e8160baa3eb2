#include <fmt/format.h>

#include <stdexcept>

#include "cli/cli.h"
#include "cli/output.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"

namespace maxwrench {
namespace {

template <class Table>
void print_table(const char* title, const Table& table) {
  fmt::print("{}\n", title);
  for (const auto& entry : table) fmt::print("  {:<28} {}\n", entry.name, entry.summary);
}

void print_problem(const std::string& name) {
  const Problem problem = load_problem(name);
  const std::string motion =
      problem.motion ? fmt::format("{} of {:g} s, ", problem.type(), problem.motion->T) : "";
  fmt::print("  {:<28} {}, {}redundancy {}, beta in {}{}\n", name, problem.robot.name, motion,
             problem.redundancy(), problem.unit(),
             problem.label.empty() ? "" : ", " + problem.label);
}

/// A file with errors does not hide the others: it is named, and the exit status is that of an
/// error.
int list() {
  int exit_status = kAnswered;
  const std::filesystem::path folder = problems_folder();
  fmt::print("problems ({})\n",
             folder.empty() ? "no folder found: set MAXWRENCH_PROBLEMS" : "in " + folder.string());
  for (const std::string& name : shipped_problems()) {
    try {
      print_problem(name);
    } catch (const std::invalid_argument& error) {
      complain(error.what());
      exit_status = kBadInput;
    }
  }
  print_table("measures", measures());
  print_table("lower-level solvers (--solver)", wrench_solvers());
  print_table("lower-level solvers for tasks in time (--solver)", trajectory_solvers());
  print_table("searches", searches());
  print_table("trajectory searches: for tasks in time, and for static tasks with linf_polytope",
              trajectory_searches());
  print_table("searches between facets: for static tasks with linf_polytope and few facets",
              facet_searches());
  print_table("searches for tasks along a path", path_searches());
  print_table("searches for transfers", transfer_searches());
  print_table("integrators", integrators());
  for (const Absent& absent : not_built_in()) {
    fmt::print("not built in: {} {} (needs {})\n", absent.family, absent.name, absent.library);
  }
  return exit_status;
}

}  // namespace

void add_list(CLI::App& app, int& exit_status) {
  CLI::App& command = *app.add_subcommand(
      "list", "lists the shipped tasks, measures, solvers, searches and integrators");
  command.callback([&exit_status] { exit_status = list(); });
}

}  // namespace maxwrench
