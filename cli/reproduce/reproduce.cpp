#include "cli/reproduce/reproduce.h"

#include <fmt/format.h>

#include <memory>

#include "benchmarks/suite/product.h"
#include "cli/cli.h"
#include "solvers/certify/proof.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

struct ReproduceOptions : CommonOptions {
  std::string out = "results";
};

int reproduce(const ReproduceOptions& options) {
  bool all_solved = true;
  const auto motion = [](const std::filesystem::path& folder, int threads) {
    return reproduce_motion(folder, threads, kTrajectoryBudget);
  };
  const auto tank = [](const std::filesystem::path& folder, int threads) {
    return reproduce_tank(folder, threads, kTrajectoryBudget);
  };
  for (PaperTable (*const table)(const std::filesystem::path&, int) :
       {reproduce_planar, reproduce_uvms, reproduce_dual, +motion, +tank}) {
    const PaperTable done = table(options.out, options.thread_count());
    fmt::print("{}\n", done.text);
    all_solved = all_solved && done.all_solved;
  }
  fmt::print("values, times and figures: {}\n", options.out);
  return all_solved ? kAnswered : kOtherStatus;
}

}  // namespace

double proven_bound(const Answer& answer, int threads) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  if (!answer.has_value()) return none;
  const Problem& problem = *answer.task;
  const auto bound = find_bound(problem, answer.choice.measure, answer.choice.wrench);
  if (!bound) return none;
  CertifyOptions options;
  options.boxes = 1'000'000;
  options.threads = threads;
  const CertifyResult result = prove(problem, resolve(problem, answer.choice), *bound,
                                     {answer.posture.theta_r, answer.beta()}, options);
  return result.status == Status::kProven ? result.bound : none;
}

void add_reproduce(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<ReproduceOptions>();
  CLI::App& command =
      *app.add_subcommand("reproduce", "computes the paper's tables and figures for comparison");
  command.add_option("--out", options->out, "folder for the results")
      ->capture_default_str()
      ->check(reject_empty);
  options->add_threads(command);
  command.callback([options, &exit_status] { exit_status = reproduce(*options); });
}

}  // namespace maxwrench
