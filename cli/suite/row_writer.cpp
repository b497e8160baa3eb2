#include "cli/suite/row_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "benchmarks/suite/machine.h"
#include "benchmarks/tables/write_file.h"
#include "maxwrench/problem.h"
#include "solvers/solve/method.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

/// The columns of times.csv: those of a row, and the conditions of the measurement.
std::vector<std::string> measured_columns() {
  std::vector<std::string> columns = time_columns();
  columns.insert(columns.end(), {"cpu_s", "threads", "machine", "build", "sources", "version"});
  return columns;
}

/// Processor time [s] of this thread if `threads` is 1, otherwise of the process.
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

RowsThere::RowsThere(const std::filesystem::path& folder, std::string version)
    : values_(values_table(folder)), times_(times_table(folder)), version_(std::move(version)) {}

bool names_sources(std::string_view version) {
  return !version.ends_with(".dirty") && !version.ends_with("+unknown");
}

bool RowsThere::has(const Problem& problem, const Case& c) const {
  if (!names_sources(version_)) return false;
  const auto measured = times_.find(case_values(c));
  const auto values = values_.find(case_values(c));
  return measured && values && values->at(values_.column("task_digest")) == problem.digest &&
         measured->at(times_.column("sources")) == sources_id() &&
         measured->at(times_.column("version")) == version_;
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

Answer RowWriter::kept(int threads, const std::function<Answer()>& make, double work) {
  const double start = processor_seconds(threads);
  Answer answer = make();
  const double used = processor_seconds(threads) - start;
  std::vector<std::string> measured = times(answer);
  measured.insert(measured.end(), {fmt::format("{:.4g}", used), std::to_string(threads),
                                   processor_name(), build_line(), sources_id(), version()});
  const std::lock_guard guard(mutex_);
  values_.put(values(answer));
  times_.put(measured);
  all_solved_ = all_solved_ && answer.has_value();
  progress_.show(done_ += work);
  return answer;
}

Answer RowWriter::solve(const Problem& problem, const Case& c) {
  return kept(threads_, [&] { return maxwrench::solve(problem, {c, threads_}); });
}

Answer RowWriter::evaluate(const Problem& problem, const Case& c, const Eigen::MatrixXd& theta_r) {
  return kept(1, [&] { return maxwrench::evaluate(problem, theta_r, {c}); });
}

void RowWriter::carry_out(const Problem& problem, const Case& c, double work) {
  const bool searches = c.integrator.empty();
  const auto make = [&] {
    try {
      Problem changed = problem;
      if (problem.motion) set_scheme("scheme", c.scheme, changed);
      return searches ? maxwrench::solve(changed, {c, threads_}) : experiment(changed, {c});
    } catch (const std::exception& error) {
      Answer answer;
      answer.task = std::make_shared<const Problem>(problem);
      answer.choice = c;
      answer.conclude(Status::kNumericalError, error.what());
      return answer;
    }
  };
  kept(searches ? threads_ : 1, make, work);
}

bool RowWriter::finish() {
  progress_.finish();
  values_.write();
  times_.write();
  return all_solved_;
}

}  // namespace maxwrench
