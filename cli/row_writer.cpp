#include "cli/row_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "benchmarks/machine.h"
#include "solvers/solve/plan_row.h"
#include "solvers/solve/tank_row.h"
#include "benchmarks/write_file.h"
#include "maxwrench/problem.h"
#include "maxwrench/version.h"

namespace maxwrench {
namespace {

/// Columns of times.csv: those of a row, and what a time depends on.
std::vector<std::string> measured_columns() {
  std::vector<std::string> columns = time_columns();
  columns.insert(columns.end(), {"cpu_s", "threads", "machine", "build", "sources", "version"});
  return columns;
}

/// [s], of this thread if it works alone.
double processor_seconds(int threads) {
  timespec now{};
  clock_gettime(threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

Table values_table(const std::filesystem::path& folder) {
  return {folder / "values.csv", value_columns(), case_columns().size()};
}

Table times_table(const std::filesystem::path& folder) {
  return {folder / "times.csv", measured_columns(), case_columns().size()};
}

RowsThere::RowsThere(const std::filesystem::path& folder)
    : values_(values_table(folder)), times_(times_table(folder)) {}

bool RowsThere::has(const Case& c) const {
  const auto measured = times_.find(case_values(c));
  const std::vector<std::string> present = {sources_id(), version()};
  return measured && std::equal(present.begin(), present.end(), measured->end() - 2) &&
         values_.find(case_values(c));
}

bool RowsThere::all_solved(const std::vector<Case>& cases) const {
  const std::size_t beta = values_.column("beta");
  return std::all_of(cases.begin(), cases.end(), [&](const Case& c) {
    const auto row = values_.find(case_values(c));
    return row && !row->at(beta).empty();
  });
}

RowWriter::RowWriter(const std::string& command, const std::filesystem::path& folder, int threads,
                     double work)
    : values_(values_table(folder)),
      times_(times_table(folder)),
      threads_(threads),
      progress_(command, work) {
  values_.hold();
  times_.hold();
  const std::filesystem::path machine = folder / "machine.txt";
  if (work > 0 || !std::filesystem::exists(machine)) write_file(machine, describe_machine());
}

template <class AnyRow>
AnyRow RowWriter::kept(const Problem& problem, int threads, const std::function<AnyRow()>& make,
                       double work) {
  const double start = processor_seconds(threads);
  AnyRow row = make();
  const double used = processor_seconds(threads) - start;
  std::vector<std::string> measured = times(row.choice, row.evaluations, row.wall_s);
  measured.insert(measured.end(), {fmt::format("{:.4g}", used), std::to_string(threads),
                                   processor_name(), build_line(), sources_id(), version()});
  const std::lock_guard guard(mutex_);
  values_.put(values(problem, row));
  times_.put(measured);
  all_solved_ = all_solved_ && row.has_value();
  progress_.show(done_ += work);
  return row;
}

template <class AnyRow>
AnyRow RowWriter::attempted(const Case& c, const std::function<AnyRow()>& make) const {
  try {
    return make();
  } catch (const std::exception& error) {
    AnyRow row;
    row.choice = c;
    row.conclude(Status::kNumericalError, error.what());
    return row;
  }
}

Row RowWriter::solve(const Problem& problem, const Method& method) {
  return kept<Row>(problem, threads_, [&] { return maxwrench::solve(problem, method, threads_); });
}

PlanRow RowWriter::solve(const Problem& problem, const PlanMethod& method) {
  return kept<PlanRow>(problem, threads_, [&] { return solve_plan(problem, method, threads_); });
}

void RowWriter::solve_case(const Problem& problem, const Case& c, double work) {
  if (!c.integrator.empty()) {
    Problem changed = problem;
    if (problem.motion) set_scheme("scheme", c.scheme, changed);
    const auto make = [&] { return run_experiment(changed, c); };
    kept<TankRow>(
        changed, 1, [&] { return attempted<TankRow>(c, make); }, work);
    return;
  }
  if (!problem.motion) {
    const auto make = [&] { return maxwrench::solve(problem, resolve(problem, c), threads_); };
    kept<Row>(
        problem, threads_, [&] { return attempted<Row>(c, make); }, work);
    return;
  }
  Problem changed = problem;
  set_scheme("scheme", c.scheme, changed);
  const auto make = [&] { return solve_plan(changed, resolve_plan(changed, c), threads_); };
  kept<PlanRow>(
      changed, threads_, [&] { return attempted<PlanRow>(c, make); }, work);
}

Row RowWriter::evaluate(const Problem& problem, const Method& method,
                        const Eigen::VectorXd& theta_r) {
  return kept<Row>(problem, 1, [&] { return maxwrench::evaluate(problem, method, theta_r); });
}

PlanRow RowWriter::evaluate(const Problem& problem, const PlanMethod& method,
                            const Eigen::MatrixXd& knots) {
  return kept<PlanRow>(problem, 1, [&] { return evaluate_plan(problem, method, knots); });
}

bool RowWriter::finish() {
  progress_.finish();
  values_.write();
  times_.write();
  return all_solved_;
}

}  // namespace maxwrench
