#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "cli/proof/lp_proof.h"
#include "maxwrench/mps.h"
#include "maxwrench/strategies.h"
#include "maxwrench/version.h"
#include "solvers/lp/exact/exact_basis.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

struct LpOptions {
  std::string file;
  std::string lp = "simplex";
  bool json = false;
  std::string certificate;
};

/// An answer with the numbers recomputed from the file's data.
struct Checked {
  LpSolution solution;
  Residual residual;
  double wall_s = 0;

  bool optimal() const { return solution.status == Status::kOptimal; }
};

Checked solve(const LpEntry& solver, const LinearProgram& program) {
  Checked answer;
  const auto start = std::chrono::steady_clock::now();
  solver.make()->solve(program, answer.solution);
  answer.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  LpSolution& solution = answer.solution;
  const bool verdict = solution.status == Status::kOptimal ||
                       solution.status == Status::kInfeasible ||
                       solution.status == Status::kUnbounded;
  // The interior point method ends near a vertex, not exactly at it.
  if (verdict && !verified(program, solution, 1e-6)) {
    solution.status = Status::kNumericalError;
    solution.reason = "the verdict is not confirmed by the program's data";
  }
  if (answer.optimal()) answer.residual = residuals(program, solution);
  return answer;
}

ordered_json by_name(const std::vector<std::string>& names, const Eigen::VectorXd& values) {
  ordered_json object = ordered_json::object();
  for (Eigen::Index i = 0; i < values.size(); ++i) object[names[i]] = values[i];
  return object;
}

void print_lp_object(const LpOptions& options, const MpsProgram& mps, const Checked& answer) {
  const LpSolution& solution = answer.solution;
  const bool optimal = answer.optimal();
  const auto known = [](bool condition, const ordered_json& value) {
    return condition ? value : ordered_json(nullptr);
  };
  ordered_json object;
  object["file"] = options.file;
  object["name"] = mps.name;
  object["sense"] = mps.minimize ? "min" : "max";
  object["lp"] = options.lp;
  object["status"] = to_string(solution.status);
  object["reason"] = known(!solution.reason.empty(), solution.reason.str());
  object["objective"] = known(optimal, mps.objective(solution));
  object["iterations"] = solution.iterations;
  const Residual& r = answer.residual;
  object["residual"] = known(
      optimal, {{"row", r.balance}, {"bound", r.bounds}, {"reduced_cost", r.dual}, {"gap", r.gap}});
  object["verified"] =
      solution.status != Status::kNumericalError && solution.status != Status::kBudgetExhausted;
  object["x"] = optimal ? by_name(mps.program.col_names, mps.point(solution)) : nullptr;
  object["duals"] = optimal ? by_name(mps.program.row_names, mps.duals(solution)) : nullptr;
  object["wall_s"] = answer.wall_s;
  object["version"] = version();
  print_json(object);
}

void print_nonzero(const char* kind, const char* symbol, const std::vector<std::string>& names,
                   const Eigen::VectorXd& values) {
  fmt::print("{:<20} {:>13}\n", kind, symbol);
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (values[i] != 0) fmt::print("{:<20} {:>13.6g}\n", names[i], values[i]);
  }
}

void print_lp(const LpOptions& options, const MpsProgram& mps, const Checked& answer) {
  const LpSolution& solution = answer.solution;
  const LinearProgram& program = mps.program;
  fmt::print("{}  {} rows  {} columns  {}  lp {}\n", options.file, program.rows(), mps.file_cols,
             mps.minimize ? "minimise" : "maximise", options.lp);
  if (!answer.optimal()) {
    fmt::print("{}: {}\n", to_string(solution.status), solution.reason.c_str());
    if (solution.status == Status::kInfeasible) fmt::print("Farkas vector checked\n");
    if (solution.status == Status::kUnbounded) fmt::print("feasible point and ray checked\n");
    fmt::print("{} iterations in {:.3g} s\n", solution.iterations, answer.wall_s);
    return;
  }
  fmt::print("optimal  {} = {:.12g}\n", mps.objective_name, mps.objective(solution));
  print_nonzero("column", "x", program.col_names, mps.point(solution));
  print_nonzero("row", "dual", program.row_names, mps.duals(solution));
  const Residual& r = answer.residual;
  fmt::print(
      "residual row {:.1e}, bound {:.1e}, reduced cost {:.1e}, gap {:.1e}; {} iterations in {:.3g} "
      "s\n",
      r.balance, r.bounds, r.dual, r.gap, solution.iterations, answer.wall_s);
}

/// Proves the verdict in rational numbers. Returns false if they do not confirm it.
bool certify_verdict(const LpOptions& options, const MpsProgram& mps, const LpSolution& solution) {
  const LpProof proof = exact_proof(mps.program, solution);
  std::string rejection = reject_lp_proof(mps.program, proof);
  if (rejection.empty() && proof.status != solution.status) rejection = to_string(proof.status);
  if (!rejection.empty()) {
    remark(fmt::format("{}: not written: rational arithmetic does not confirm '{}': {}",
                       options.certificate, to_string(solution.status), rejection));
    return false;
  }
  write_file(options.certificate, lp_proof_text(options.file, mps, proof));
  return true;
}

int lp(const LpOptions& options) {
  require_apart({{"file", options.file}}, {{"--certificate", options.certificate}});
  const LpEntry& solver = find_lp_solver(options.lp);
  const MpsProgram mps = read_mps(options.file);
  const Checked answer = solve(solver, mps.program);
  const bool certified =
      options.certificate.empty() || certify_verdict(options, mps, answer.solution);
  (options.json ? print_lp_object : print_lp)(options, mps, answer);
  return certified && answer.optimal() ? kAnswered : kOtherStatus;
}

}  // namespace

void add_lp(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<LpOptions>();
  CLI::App& command = *app.add_subcommand("lp", "solves the linear program of an MPS file");
  command.add_option("file", options->file, "MPS file in fixed or free format")->required();
  command.add_option("--solver", options->lp, "linear programming solver")->capture_default_str();
  command
      .add_option("--certificate", options->certificate,
                  "file for a proof in rational numbers, which 'verify' checks; up to 500 rows")
      ->check(reject_empty);
  command.add_flag("--json", options->json, "print one JSON object");
  command.callback([options, &exit_status] { exit_status = lp(*options); });
}

}  // namespace maxwrench
