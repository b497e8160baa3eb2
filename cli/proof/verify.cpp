#include "verify/verify.h"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "cli/cli.h"
#include "cli/output.h"
#include "cli/proof/lp_proof.h"
#include "cli/proof/verify_rows.h"
#include "maxwrench/load.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

struct VerifyOptions : CommonOptions {
  std::string file;
  std::size_t sample = 0;
};

/// theta_r from the coordinates of the certificate's posture, which may be too few.
Eigen::VectorXd theta_r_of(const ProofCertificate& proof, const Problem& problem) {
  return proof.x.head(std::min(proof.x.size(), problem.theta_r_min.size()));
}

void print_verified(const ProofCertificate& proof, const Problem& problem,
                    const Verification& result, double seconds) {
  fmt::print("{}  measure {}  wrench {}{}\n", problem.name, proof.measure, to_string(proof.wrench),
             proof.collision ? "" : "  collisions ignored");
  fmt::print("{}{}{}\n", result.rejection.empty() ? "verified" : "rejected",
             result.rejection.empty() ? "" : ": ", result.rejection);
  const Eigen::VectorXd theta_r = theta_r_of(proof, problem);
  if (theta_r.size() > 0) fmt::print("theta_r   {}\n", line(theta_r));
  fmt::print("beta      {:>9.5f} {}\n", proof.value, problem.unit());
  fmt::print("bound     {:>9.5f} {}{}\n", proof.bound, problem.unit(),
             result.rejection.empty() ? ": no posture has more" : ", as claimed");
  fmt::print("gap       {:.3g} %\n", 100 * (proof.bound - proof.value) / std::abs(proof.value));
  fmt::print(
      "boxes     {}: {} leaves by a multiplier, {} in collision, {} without a posture, {} by their "
      "parent\n",
      result.boxes, result.by_multiplier, result.by_collision, result.by_equations,
      result.by_parent);
  fmt::print("checked in {:.3g} s, written by maxwrench {}\n", seconds, proof.version);
}

void print_verified_object(const ProofCertificate& proof, const Problem& problem,
                           const Verification& result, double seconds) {
  nlohmann::ordered_json object = {{"problem", problem.name},
                                   {"measure", proof.measure},
                                   {"wrench", to_string(proof.wrench)},
                                   {"status", result.rejection.empty() ? "verified" : "rejected"},
                                   {"reason", result.rejection},
                                   {"beta", proof.value},
                                   {"bound", proof.bound},
                                   {"unit", problem.unit()},
                                   {"gap", (proof.bound - proof.value) / std::abs(proof.value)},
                                   {"collision", proof.collision}};
  object["theta_r"] = array(theta_r_of(proof, problem));
  object["boxes"] = result.boxes;
  object["multiplier"] = result.by_multiplier;
  object["colliding"] = result.by_collision;
  object["no_posture"] = result.by_equations;
  object["parent"] = result.by_parent;
  object["ceiling"] = known(std::isfinite(result.ceiling), result.ceiling);
  object["wall_s"] = seconds;
  object["version"] = proof.version;
  print_json(object);
}

/// A fraction with many digits is hard to read.
std::string readable(const std::string& fraction) {
  constexpr std::size_t kShort = 20;
  if (fraction.size() <= kShort) return fraction;
  return fmt::format("{:.15g}, rounded", mpq_class(fraction).get_d());
}

void print_lp(const LpVerification& result) {
  fmt::print("{}\n", result.mps_file);
  if (!result.rejection.empty()) {
    fmt::print("rejected: {}\n", result.rejection);
    return;
  }
  fmt::print("verified\n{} in rational numbers{}{}\n", to_string(result.status),
             result.objective.empty() ? "" : ", objective ", readable(result.objective));
}

int check_lp_file(const VerifyOptions& options) {
  const LpVerification result = verify_lp(options.file, options.choice.problem);
  const bool verified = result.rejection.empty();
  if (options.json) {
    print_json({{"file", result.mps_file},
                {"status", verified ? "verified" : "rejected"},
                {"reason", result.rejection},
                {"verdict", to_string(result.status)},
                {"objective", result.objective}});
  } else {
    print_lp(result);
  }
  return verified ? kAnswered : kOtherStatus;
}

int check_file(const VerifyOptions& options) {
  if (is_values_file(options.file)) {
    if (!options.choice.problem.empty()) {
      throw std::invalid_argument("--problem: got '" + options.choice.problem +
                                  "', expected none: each row names its problem");
    }
    return verify_rows(options.file, options.sample, options.choice.seed, options.thread_count(),
                       options.json);
  }
  if (is_lp_proof(options.file)) return check_lp_file(options);
  const auto start = std::chrono::steady_clock::now();
  const ProofCertificate proof = read_certificate(options.file);
  const std::string& other = options.choice.problem;
  Problem problem = load_problem(other.empty() ? proof.problem : other);
  if (!proof.collision) problem.robot.collision = nullptr;
  const Verification result = verify(problem, proof, options.thread_count());
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  (options.json ? print_verified_object : print_verified)(proof, problem, result, seconds);
  return result.rejection.empty() ? kAnswered : kOtherStatus;
}

}  // namespace

void add_verify(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<VerifyOptions>();
  options->choice.problem.clear();
  CLI::App& command = *app.add_subcommand(
      "verify",
      "checks a certificate of 'certify' or 'lp' with independent code, or rows of 'run'");
  command.add_option("file", options->file, "certificate, or values.csv.gz")
      ->required()
      ->check(reject_empty);
  command
      .add_option("--problem", options->choice.problem,
                  "shipped task, task file or MPS file to check it against (default: the one that "
                  "it names)")
      ->check(reject_empty);
  command
      .add_option("--sample", options->sample, "number of rows of values.csv.gz to check (0: all)")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command.add_option("--seed", options->choice.seed, "seed of the sample of rows")
      ->capture_default_str()
      ->check(reject_seed);
  options->add_threads(command);
  options->add_json(command);
  command.callback([options, &exit_status] { exit_status = check_file(*options); });
}

}  // namespace maxwrench
