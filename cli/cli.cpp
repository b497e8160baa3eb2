#include "cli/cli.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <system_error>

#include "cli/output.h"
#include "maxwrench/batch.h"
#include "maxwrench/problem.h"
#include "maxwrench/version.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

/// Replaces the name of a key in an error message, such as "solver: got ", by that of its option,
/// "--solver: got ".
std::string as_option(const CLI::App& app, const std::string& message) {
  std::string key = message.substr(0, message.find(": got "));
  std::replace(key.begin(), key.end(), '_', '-');
  const std::string of_key = message.substr(std::min(key.size(), message.size()));
  if (key == "seconds") key = "time";
  for (const CLI::App* command : app.get_subcommands()) {
    if (command->get_option_no_throw("--" + key) == nullptr) continue;
    return "--" + key + of_key;
  }
  return message;
}

/// The line of the parser. Text that is no number has one that says what was expected.
std::string complaint_of_parser(const CLI::ParseError& error) {
  const std::string line = error.what(), unread = "Could not convert: ";
  const std::size_t equals = line.find(" = ");
  if (!line.starts_with(unread) || equals == std::string::npos) return line;
  return fmt::format("{}: got '{}', expected a number",
                     line.substr(unread.size(), equals - unread.size()), line.substr(equals + 3));
}

int parse_and_run(int argc, const char* const* argv) {
  CLI::App app("Finds how strongly a kinematically redundant robot can push, lift or twist.",
               "maxwrench");
  app.set_version_flag("--version", [] {
    std::string text = describe_build();
    text.pop_back();  // without the line break at its end
    return text;
  });
  app.require_subcommand(1);
  int exit_status = kAnswered;
  for (const auto add :
       {add_list,    add_check,       add_init,      add_pose,     add_eval,   add_solve,
        add_certify, add_sensitivity, add_map,       add_margin,   add_pareto, add_verify,
        add_lp,      add_run,         add_merge,     add_simulate, add_plot,   add_view,
        add_compare, add_report,      add_reproduce, add_manual}) {
    add(app, exit_status);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    const bool no_subcommand = app.get_subcommands().empty() && argc > 1;
    complain(no_subcommand
                 ? fmt::format("got '{}', expected a subcommand: see maxwrench --help", argv[1])
                 : complaint_of_parser(error));
    return kBadInput;
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(as_option(app, error.what()));
  }
  return exit_status;
}

/// The one line for an exception: the command ends with a status and, for bad input, one line,
/// never with an exception.
std::string complaint_of(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const std::filesystem::filesystem_error& error) {
    return fmt::format("{}: got '{}', expected a usable file or folder", error.path1().string(),
                       error.code().message());
  } catch (const std::system_error& error) {
    if (std::ferror(stdout) == 0) return error.what();
    return fmt::format("stdout: got '{}', expected a writable stream", error.code().message());
  } catch (const std::bad_alloc&) {
    return "got too little memory, expected a smaller task or fewer evaluations, boxes, times or "
           "threads";
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "stopped by an unknown error";
  }
}

}  // namespace

int run_command(int argc, const char* const* argv) {
  prepare_streams();
  try {
    const int exit_status = parse_and_run(argc, argv);
    print_kept_complaints();
    return flush_output(exit_status);
  } catch (...) {
    complain(complaint_of(std::current_exception()));
    return kBadInput;
  }
}

void CommonOptions::add_case(CLI::App& app) {
  app.add_option("problem", choice.problem, kProblemHelp)->required();
  add_choice(app);
}

void CommonOptions::add_choice(CLI::App& app) {
  app.add_option("--measure", choice.measure, "capability measure")->capture_default_str();
  app.add_option("--wrench", wrench, "pure: along c only; any: other components are free")
      ->capture_default_str();
  app.add_option("--solver", choice.solver, "lower-level solver (default: the first that applies)");
}

std::string reject_seed(const std::string& text) {
  const bool whole = !text.empty() && text.size() < 20 &&
                     text.find_first_not_of("0123456789") == std::string::npos;
  return whole ? "" : "got '" + text + "', expected a whole number from 0 to 10^19 - 1";
}

std::function<std::string(const std::string&)> whole_number(long low, long high) {
  return [low, high](const std::string& text) -> std::string {
    long number = 0;
    const char* end = text.data() + text.size();
    const auto [at, error] = std::from_chars(text.data(), end, number);
    if (error == std::errc() && at == end && number >= low && number <= high) return "";
    return fmt::format("got '{}', expected a whole number from {} to {}", text, low, high);
  };
}

std::string reject_empty(const std::string& text) {
  return text.empty() ? "got '', expected a name" : "";
}

void CommonOptions::add_search(CLI::App& app) {
  app.add_option("--search", choice.search,
                 "search over theta_r, or stages joined by + (default: facet_sqp+cmaes where it "
                 "applies, else crs2+cmaes, restarted until another optimum is unlikely or "
                 "--budget is spent; slp for a task in time)");
  app.add_option("--seed", choice.seed, "seed of the random numbers")
      ->capture_default_str()
      ->check(reject_seed);
  add_budget(app,
             "evaluation budget (default: 20000; 200000 for the default search of a static task)");
}

void CommonOptions::add_budget(CLI::App& app, const char* what) {
  app.add_option("--budget", choice.budget, what)->check(CLI::Range(1L, long{kMostBudget}));
}

void require_static(const Problem& problem, const char* command) {
  if (!problem.motion) return;
  throw std::invalid_argument(fmt::format("{}: type: got {} {}, expected a static task for `{}`",
                                          problem.name, problem.motion->impulse ? "an" : "a",
                                          problem.type(), command));
}

void reject_given(const CLI::App& command, std::initializer_list<const char*> options,
                  const std::string& why) {
  for (const char* option : options) {
    if (command.get_option(option)->count() == 0) continue;
    throw std::invalid_argument(fmt::format("{}: got {}", option, why));
  }
}

Eigen::VectorXd theta_r_of(const Problem& problem, const std::optional<std::string>& text) {
  return text ? parse_numbers("--theta-r", *text) : problem.theta_r_default;
}

int report(const Answer& answer, bool json) {
  fmt::print("{}", json ? to_json(answer) + "\n" : summary(answer));
  return answer.answered() ? kAnswered : kOtherStatus;
}

void CommonOptions::add_json(CLI::App& app) {
  app.add_flag("--json", json, "print one JSON object");
}

void CommonOptions::add_threads(CLI::App& app) {
  app.add_option("--threads", threads,
                 "number of threads; changes the time, never the result (0: one per core)")
      ->capture_default_str()
      ->check(CLI::Range(0, kMostThreads));
}

Options CommonOptions::read_options() const {
  Options options{choice, threads};
  options.wrench = parse_wrench(wrench);
  return options;
}

int CommonOptions::thread_count() const { return maxwrench::thread_count(threads); }

Eigen::VectorXd parse_numbers(const std::string& option, const std::string& text) {
  std::vector<double> numbers;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string item = text.substr(begin, end - begin);
    std::size_t used = 0;
    double value = NAN;
    try {
      value = std::stod(item, &used);
    } catch (const std::logic_error&) {
      used = 0;
    }
    if (used == 0 || used != item.size() || !std::isfinite(value)) {
      throw std::invalid_argument(
          fmt::format("{}: got '{}', expected finite numbers separated by commas", option, text));
    }
    numbers.push_back(value);
    begin = end + 1;
  }
  return Eigen::Map<Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

}  // namespace maxwrench
