#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <string>

#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/reproduce/reproduce.h"
#include "cli/suite/row_writer.h"
#include "maxwrench/figures.h"
#include "maxwrench/load.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

constexpr std::array<const char*, 2> kSearches = {"grid+cmaes", "annealing+cmaes"};
constexpr long kDualBudget = 20000;
constexpr int kRandomContacts = 2000;

struct Tank {
  double one = 23, chosen = 26, best = 30;  ///< N m, measured in the paper
};

/// The measure beta_2: pure torque at the bar.
Case pure(const char* search) {
  return {"", "linf_polytope", Wrench::kPure, "", search, 1, kDualBudget};
}

Answer at_default(RowWriter& writer, const Problem& problem) {
  return writer.evaluate(problem, pure(""), problem.theta_r_default);
}

std::string contact_line(const char* name, const Answer& row, double one, double tank,
                         double tank_one, const std::string& proven = "") {
  if (!row.has_value()) return fmt::format("{:<16} no value: {}\n", name, row.reason.c_str());
  const double w_2 = row.capability.h_2.head<3>().norm();
  return fmt::format(
      "{:<16} {:>8.3f} {:>8}  {:>7.1f}  {:>+8.1f} %  {:>+6.1f} %  {:>8.2f}  [{:.4f}]\n", name,
      row.capability.beta, proven, tank, 100 * (row.capability.beta / one - 1),
      100 * (tank / tank_one - 1), w_2, fmt::join(row.posture.theta_r, ", "));
}

}  // namespace

PaperTable reproduce_dual(const std::filesystem::path& folder, int threads) {
  const Problem alone = load_problem("dual_arm/bar_alone");
  const Problem wall = load_problem("dual_arm/bar_wall");
  for (const Problem* problem : {&alone, &wall}) require_static(*problem, "reproduce");
  RowWriter writer("reproduce dual", folder, threads, 2 + static_cast<long>(kSearches.size()));
  const Tank tank;
  const Answer one = at_default(writer, alone);
  const Answer chosen = at_default(writer, wall);
  Answer best;
  for (const char* search : kSearches) {
    const Answer row = writer.solve(wall, pure(search));
    if (!row.has_value()) continue;
    if (!best.has_value() || row.capability.beta > best.capability.beta) best = row;
  }
  const double reference = one.capability.beta;
  std::string text = fmt::format(
      "dual_arm/bar_wall: torque about the vertical at a rigid bar, while the arm may push on a "
      "wall,\nN m ({}). tank: measured in the paper; push: force on the wall, N;\n"
      "proven: no contact has more, by branch and bound to 0.1 %.\n\n"
      "                     ours   proven     tank  ours gain  tank gain  push    regrasp [m]\n",
      wall.label);
  text += contact_line("one contact", one, reference, tank.one, tank.one);
  text += contact_line("default contact", chosen, reference, tank.chosen, tank.one);
  text += contact_line("best contact", best, reference, tank.best, tank.one,
                       fmt::format("{:.3f}", proven_bound(best, threads)));
  const Sampled contacts = sample_postures(wall, kRandomContacts);
  text += fmt::format("  {} random contacts, {} of them valid; {}\n", kRandomContacts,
                      contacts.valid, describe(contacts.postures));
  if (best.has_value()) {
    write_file(
        folder / "dual_postures.svg",
        posture_figure(wall, {{"default", wall.theta_r_default}, {"best", best.posture.theta_r}}));
  }
  const bool all_solved = writer.finish();
  write_file(folder / "dual.txt", text);
  return {text, all_solved};
}

}  // namespace maxwrench
