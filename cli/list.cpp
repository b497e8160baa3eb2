#include <fmt/format.h>

#include "cli/cli.h"
#include "problems/loader.h"
#include "solvers/strategies.h"

namespace maxwrench {
namespace {

template <class Table>
void print_table(const char* title, const Table& table) {
  fmt::print("{}\n", title);
  for (const auto& entry : table) fmt::print("  {:<28} {}\n", entry.name, entry.summary);
}

void list() {
  fmt::print("problems\n");
  for (const std::string& name : shipped_problems()) {
    const Problem problem = load_problem(name);
    fmt::print("  {:<28} {}, redundancy {}, beta in {}{}\n", name, problem.robot.name,
               problem.redundancy(), problem.unit(),
               problem.label.empty() ? "" : ", " + problem.label);
  }
  print_table("measures", measures());
  print_table("lower-level solvers (--lp)", wrench_solvers());
  print_table("searches", searches());
  print_table("integrators", integrators());
}

}  // namespace

void add_list(CLI::App& app, int& exit_status) {
  CLI::App& command = *app.add_subcommand("list", "what there is to choose from");
  command.callback([&exit_status] {
    list();
    exit_status = kAnswered;
  });
}

}  // namespace maxwrench
