#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>

#include "maxwrench/solve.h"

namespace maxwrench {

struct Problem;

/// Exit statuses of the command.
enum ExitStatus { kAnswered = 0, kOtherStatus = 1, kBadInput = 2 };

/// Runs the whole command line. Prints results to stdout and messages to stderr; returns the exit
/// status.
int run_command(int argc, const char* const* argv);

/// The options that several commands share. `wrench` and `theta_r` are texts until they are parsed.
struct CommonOptions {
  Case choice;
  std::string wrench = "pure";
  int threads = 0;  ///< 0: one per core
  bool json = false;

  void add_case(CLI::App& app);
  void add_choice(CLI::App& app);  ///< measure, wrench and solver
  void add_search(CLI::App& app);
  void add_budget(CLI::App& app, const char* what);
  void add_json(CLI::App& app);
  void add_threads(CLI::App& app);

  Options read_options() const;  ///< all except callbacks
  int thread_count() const;
};

/// What PROBLEM may be.
inline constexpr const char* kProblemHelp =
    "shipped task such as planar/force, a task file, or a URDF";

/// Numbers separated by commas; throws std::invalid_argument that names the option.
Eigen::VectorXd parse_numbers(const std::string& option, const std::string& text);

/// The posture that `--theta-r` gives, or that of the task.
Eigen::VectorXd theta_r_of(const Problem& problem, const std::optional<std::string>& text);

/// Throws std::invalid_argument for a task in time, which the command does not support.
void require_static(const Problem& problem, const char* command);

/// Throws std::invalid_argument "OPTION: got ..." if one of these options is given.
///
/// @param why  what was got and what is expected
void reject_given(const CLI::App& command, std::initializer_list<const char*> options,
                  const std::string& why);

/// Empty, or why the text is not a seed of random numbers.
std::string reject_seed(const std::string& text);

/// Returns a check that rejects what is not a whole number from `low` to `high`.
std::function<std::string(const std::string&)> whole_number(long low, long high);

/// Empty, or why the text does not name a file or folder.
std::string reject_empty(const std::string& text);

/// Prints an answer as text or, with `json`, as one object; returns its exit status.
int report(const Answer& answer, bool json);

// One function for each subcommand. It adds the subcommand to the command line; the subcommand's
// callback sets `exit_status`.
void add_list(CLI::App& app, int& exit_status);
void add_check(CLI::App& app, int& exit_status);
void add_init(CLI::App& app, int& exit_status);
void add_pose(CLI::App& app, int& exit_status);
void add_eval(CLI::App& app, int& exit_status);
void add_solve(CLI::App& app, int& exit_status);
void add_certify(CLI::App& app, int& exit_status);
void add_verify(CLI::App& app, int& exit_status);
void add_lp(CLI::App& app, int& exit_status);
void add_run(CLI::App& app, int& exit_status);
void add_merge(CLI::App& app, int& exit_status);
void add_simulate(CLI::App& app, int& exit_status);
void add_plot(CLI::App& app, int& exit_status);
void add_map(CLI::App& app, int& exit_status);
void add_margin(CLI::App& app, int& exit_status);
void add_pareto(CLI::App& app, int& exit_status);
void add_sensitivity(CLI::App& app, int& exit_status);
void add_view(CLI::App& app, int& exit_status);
void add_compare(CLI::App& app, int& exit_status);
void add_report(CLI::App& app, int& exit_status);
void add_reproduce(CLI::App& app, int& exit_status);
void add_manual(CLI::App& app, int& exit_status);

}  // namespace maxwrench
