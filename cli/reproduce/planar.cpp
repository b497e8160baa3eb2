#include <fmt/format.h>

#include <vector>

#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/reproduce/reproduce.h"
#include "cli/suite/row_writer.h"
#include "maxwrench/figures.h"
#include "maxwrench/load.h"

namespace maxwrench {
namespace {

/// One number of the paper's planar example (fig:optimalpolytopes), and the case that reproduces
/// it.
struct PaperValue {
  const char* symbol;
  double paper;  ///< N
  const char* measure;
  Wrench wrench;
  std::vector<const char*> solvers;
};

const std::vector<PaperValue>& planar_values() {
  static const std::vector<PaperValue> kValues = {
      {"beta_1", 1.91, "ellipsoid", Wrench::kPure, {kNoSolver}},
      {"beta_2", 3.47, "linf_polytope", Wrench::kPure, {"facets", "simplex", "ipopt"}},
      {"beta_3", 3.88, "linf_polytope", Wrench::kAny, {"simplex", "ipopt"}},
  };
  return kValues;
}

/// Enough for a first grid of 600 × 600 points; an interior point solve takes a thousand times as
/// long.
long budget_of(const std::string& search, const std::string& solver) {
  if (solver == "ipopt") return 3000;
  return search == "grid+cmaes" ? 400000 : 40000;
}

struct Rows {
  std::string text;          ///< the table
  std::vector<Answer> best;  ///< the first row for each paper value
  bool all_solved = true;
};

std::string planar_line(const Problem& problem, const PaperValue& value, const Answer& row,
                        double bound) {
  return fmt::format(
      "{}  {:>6.2f}  {:>8.4f}  {:>8.4f}  {:>+8.2f} %  {:<7}  {:<15}  {:>11}   {:.1e}  {}\n",
      value.symbol, value.paper, row.capability.beta, bound,
      100 * (row.capability.beta / value.paper - 1), row.choice.solver, row.choice.search,
      row.evaluations, row.capability.residual.gap, problem.label);
}

Rows solve_planar(const Problem& problem, const std::filesystem::path& folder, int threads) {
  RowWriter writer("reproduce planar", folder, threads, 12);
  Rows rows;
  rows.text = fmt::format(
      "{}: the paper's planar example, N. Geometry: {} (it is not published), so the table shows\n"
      "that the model can reproduce the paper's values, not that it predicts them. The grid\n"
      "before CMA-ES has 600 x 600 postures (ipopt: 51 x 51); gap bounds how far beta is from\n"
      "the optimum at its posture; proven: no posture has more, by branch and bound to 0.1 %.\n\n"
      "         paper      ours    proven  deviation  solver   search           evaluations   gap  "
      "    label\n",
      problem.name, problem.label);
  for (const PaperValue& value : planar_values()) {
    std::vector<Answer> of_value;
    for (const char* solver : value.solvers) {
      for (const char* search : {"grid+cmaes", "annealing+cmaes"}) {
        const Case c{problem.name,
                     value.measure,
                     value.wrench,
                     solver,
                     search,
                     1,
                     budget_of(search, solver)};
        of_value.push_back(writer.solve(problem, c));
      }
    }
    const double bound = proven_bound(of_value.front(), threads);
    for (const Answer& row : of_value) rows.text += planar_line(problem, value, row, bound);
    rows.best.push_back(of_value.front());
  }
  rows.all_solved = writer.finish();
  return rows;
}

}  // namespace

PaperTable reproduce_planar(const std::filesystem::path& folder, int threads) {
  const Problem problem = load_problem("planar/force");
  require_static(problem, "reproduce");
  const Rows rows = solve_planar(problem, folder, threads);
  write_file(folder / "planar.txt", rows.text);
  std::vector<Panel> optima;
  for (std::size_t i = 0; i < rows.best.size(); ++i) {
    optima.push_back(
        {fmt::format("optimum of {}", planar_values()[i].symbol), rows.best[i].posture.theta_r});
  }
  write_file(folder / "planar_polytopes.svg",
             figure(problem, {{"default posture", problem.theta_r_default}}));
  write_file(folder / "planar_optima.svg", figure(problem, optima));
  return {rows.text, rows.all_solved};
}

}  // namespace maxwrench
