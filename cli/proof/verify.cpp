#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "benchmarks/suite/map_check.h"
#include "benchmarks/suite/map_store.h"
#include "benchmarks/tables/csv.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "cli/proof/lp_proof.h"
#include "cli/proof/trajectory_proofs.h"
#include "cli/proof/verify_rows.h"
#include "maxwrench/certify.h"
#include "maxwrench/load.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

struct VerifyOptions : CommonOptions {
  std::string file;
  std::size_t sample = 0;
};

void print_verified(const VerifiedProof& proof) {
  fmt::print("{}  measure {}  wrench {}{}\n", proof.problem, proof.measure, to_string(proof.wrench),
             proof.collision ? "" : "  collisions ignored");
  fmt::print("{}{}{}\n", proof.verified() ? "verified" : "rejected", proof.verified() ? "" : ": ",
             proof.rejection);
  if (proof.theta_r.size() > 0) fmt::print("theta_r   {}\n", line(proof.theta_r));
  fmt::print("beta      {:>9.5f} {}\n", proof.value, proof.unit);
  fmt::print("bound     {:>9.5f} {}{}\n", proof.bound, proof.unit,
             proof.verified() ? ": no posture has more" : ", as claimed");
  fmt::print("gap       {:.3g} %\n", 100 * proof.gap());
  fmt::print(
      "boxes     {}: {} leaves by a multiplier, {} in collision, {} without a posture, {} by their "
      "parent\n",
      proof.boxes, proof.by_multiplier, proof.by_collision, proof.by_equations, proof.by_parent);
  fmt::print("checked in {:.3g} s, written by maxwrench {}\n", proof.seconds, proof.version);
}

void print_verified_object(const VerifiedProof& proof) {
  nlohmann::ordered_json object = {{"problem", proof.problem},
                                   {"measure", proof.measure},
                                   {"wrench", to_string(proof.wrench)},
                                   {"status", proof.verified() ? "verified" : "rejected"},
                                   {"reason", proof.rejection},
                                   {"beta", proof.value},
                                   {"bound", proof.bound},
                                   {"unit", proof.unit},
                                   {"gap", proof.gap()},
                                   {"collision", proof.collision}};
  object["theta_r"] = array(proof.theta_r);
  object["boxes"] = proof.boxes;
  object["multiplier"] = proof.by_multiplier;
  object["colliding"] = proof.by_collision;
  object["no_posture"] = proof.by_equations;
  object["parent"] = proof.by_parent;
  object["ceiling"] = known(std::isfinite(proof.ceiling), proof.ceiling);
  object["wall_s"] = proof.seconds;
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

/// The folder of a map, if the file is one or its table; else empty.
std::filesystem::path map_folder(const std::string& file) {
  const std::filesystem::path path = file;
  if (std::filesystem::is_directory(path)) return path;
  const bool table =
      path.filename() == kMapTable || path.filename() == std::string(kMapTable) + kPackedEnding;
  return table && holds_map(path.parent_path()) ? path.parent_path() : "";
}

int check_map_folder(const std::filesystem::path& folder, const VerifyOptions& options) {
  if (!holds_map(folder)) {
    throw std::invalid_argument(folder.string() +
                                ": got a folder without map.json, expected the folder of 'map "
                                "--out', or a file: a certificate or the values.csv.gz of 'run'");
  }
  const std::string& other = options.choice.problem;
  const MapCheck check = check_map(
      folder,
      [&other](const std::string& name) { return load_problem(other.empty() ? name : other); },
      options.sample, options.choice.seed, options.thread_count());
  const bool verified = check.rejected.empty();
  if (options.json) {
    print_json({{"problem", check.problem},
                {"status", verified ? "verified" : "rejected"},
                {"cells", check.cells},
                {"checked", check.checked},
                {"values", check.values},
                {"rejected", check.rejected}});
  } else {
    fmt::print("{}\n", check.problem);
    if (!verified) fmt::print("rejected: {} of the checked cells\n", check.rejected.size());
    fmt::print("{}: {} of {} cells, {} of them with a value, {} without\n",
               verified ? "verified" : "checked", check.checked, check.cells, check.values,
               check.checked - check.values);
    for (const std::string& each : check.rejected) fmt::print("rejected: {}\n", each);
  }
  return verified ? kAnswered : kOtherStatus;
}

int check_file(const VerifyOptions& options) {
  if (const auto folder = map_folder(options.file); !folder.empty()) {
    return check_map_folder(folder, options);
  }
  if (is_values_file(options.file)) {
    if (!options.choice.problem.empty()) {
      throw std::invalid_argument("--problem: got '" + options.choice.problem +
                                  "', expected none: each row names its problem");
    }
    return verify_rows(options.file, options.sample, options.choice.seed, options.thread_count(),
                       options.json);
  }
  if (options.sample > 0) {
    throw std::invalid_argument(fmt::format(
        "--sample: got {}, expected no such option with a certificate", options.sample));
  }
  if (is_lp_proof(options.file)) return check_lp_file(options);
  if (is_trajectory_certificate(std::filesystem::path(options.file))) {
    return verify_trajectory_file(options.file, options.choice.problem, options.thread_count(),
                                  options.json);
  }
  const std::string& other = options.choice.problem;
  const VerifiedProof proof = verify_certificate(
      options.file,
      [&other](const std::string& name) { return load_problem(other.empty() ? name : other); },
      options.thread_count());
  (options.json ? print_verified_object : print_verified)(proof);
  return proof.verified() ? kAnswered : kOtherStatus;
}

}  // namespace

void add_verify(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<VerifyOptions>();
  options->choice.problem.clear();
  CLI::App& command = *app.add_subcommand(
      "verify",
      "checks a certificate of 'certify' or 'lp' with independent code, rows of 'run', or cells of "
      "'map'");
  command.add_option("file", options->file, "certificate, values.csv.gz, or the folder of a map")
      ->required()
      ->check(reject_empty);
  command
      .add_option("--problem", options->choice.problem,
                  "shipped task, task file or MPS file to check it against (default: the one that "
                  "it names)")
      ->check(reject_empty);
  command
      .add_option("--sample", options->sample,
                  "number of rows of values.csv.gz, or of cells of a map, to check (0: all)")
      ->capture_default_str()
      ->check(whole_number(0, 1'000'000'000));
  command.add_option("--seed", options->choice.seed, "seed of the sample")
      ->capture_default_str()
      ->check(reject_seed);
  options->add_threads(command);
  options->add_json(command);
  command.callback([options, &exit_status] { exit_status = check_file(*options); });
}

}  // namespace maxwrench
