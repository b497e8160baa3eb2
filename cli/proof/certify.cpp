#include "solvers/certify/certify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/ctrl_c.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/proof/good_postures.h"
#include "cli/task/problem_options.h"
#include "maxwrench/load.h"
#include "maxwrench/version.h"
#include "solvers/certify/proof.h"
#include "solvers/certify/proof_recorder.h"
#include "solvers/solve/format.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

struct ProofOptions : CommonOptions {
  double gap = CertifyOptions().gap;
  double seconds = 60;
  bool ignore_collision = false;
  std::string certificate;
  WithinOptions within;
  ProblemOptions source;
};

/// The proof for the best posture found.
struct Proof {
  Answer row;  ///< the posture, evaluated again
  std::string search;
  CertifyResult result;
  double search_s = 0;
  ProofRecorder boxes;               ///< filled if a certificate is requested
  std::optional<GoodPostures> good;  ///< if requested, and if there is a value

  /// The gap as a share of |beta|; infinite without a posture.
  double gap() const {
    if (!row.has_value()) return kInfinity;
    return (result.bound - row.capability.beta) / std::abs(row.capability.beta);
  }
  bool complete() const {
    return result.status == Status::kProven && (!good || good->status == Status::kProven);
  }
};

/// Lists the good postures in the remaining time.
GoodPostures list_good(const ProofOptions& options, const Problem& problem, const Method& method,
                       const Bound& bound, const CertifyOptions& how, Proof& proof) {
  ProgressLine line;
  GoodOptions good;
  good.within = options.within.share();
  good.resolution = options.within.resolution;
  good.seconds = std::max(0.0, how.seconds - proof.result.seconds);
  good.threads = how.threads;
  good.interrupted = how.interrupted;
  good.progress = [&line](std::size_t waiting, std::size_t kept) {
    line.show(fmt::format("within {} boxes kept, {} open", kept, waiting));
  };
  return verified_good_postures(problem, method, bound, proof.result.bound, good, proof.row);
}

/// `verify` reads the task again by its name, without the options of `certify`.
void throw_on_choices(const ProofOptions& options) {
  if (options.certificate.empty()) return;
  if (is_urdf(options.choice.problem)) {
    throw std::invalid_argument(
        "--certificate: got a URDF, expected a task file, such as 'maxwrench init' writes");
  }
  if (options.source.limits) {
    throw std::invalid_argument("--certificate: got --limits " + *options.source.limits +
                                ", expected the limits that the robot has without it");
  }
}

/// The check of a certificate does not support forces of a second contact. The list of good
/// postures needs boxes of theta_r only.
void throw_on_dependents(const ProofOptions& options, const Problem& problem) {
  if (!options.certificate.empty() && problem.contact_columns() > 0) {
    throw std::invalid_argument(
        "--certificate: got a task with forces of a second contact, expected one without");
  }
  if (options.within.asked() && (!problem.dependent.empty() || problem.contact)) {
    throw std::invalid_argument(
        "--within: got a task with dependent joints or a second contact, expected one without");
  }
}

/// Searches, then bounds. A better posture found while bounding is also evaluated again.
Proof prove(const ProofOptions& options, const Problem& problem) {
  Options c = options.read_options();
  c.budget = kUsualBudget;
  const auto bound = make_capability_bound(problem, c.measure, c.wrench);  // first, as it may throw
  const Method method = resolve(problem, c);
  CtrlC ctrl_c;
  Proof proof;
  {
    Progress progress("search", method.choice.budget);
    c.progress = progress.counter();
    c.interrupted = ctrl_c.asked();
    proof.row = solve(problem, c);
    proof.search = proof.row.choice.search;
  }
  proof.search_s = proof.row.wall_s;
  ProgressLine line;
  CertifyOptions how;
  how.gap = options.gap;
  how.seconds = options.seconds;
  how.threads = options.thread_count();
  how.interrupted = ctrl_c.asked();
  if (!options.certificate.empty()) {
    how.sink = [&proof](const CertifiedBox& box) { proof.boxes.add(box); };
  }
  how.progress = [&line](double most, double beta) {
    line.show("certify gap " + percent((most - beta) / std::abs(beta)));
  };
  Candidate incumbent;
  if (proof.row.has_value()) {
    incumbent = {proof.row.posture.theta_r, proof.row.capability.beta};
  }
  proof.result = prove(problem, method, *bound, incumbent, how);
  const Candidate& best = proof.result.best;
  if (best.value > incumbent.value) proof.row = evaluate(problem, best.theta_r, c);
  if (best.value == -kInfinity) {
    if (proof.result.status == Status::kProven) proof.result.reason = "no posture has a value";
  } else if (!proof.row.has_value()) {
    static_cast<Verdict&>(proof.result) = proof.row;
  }
  if (options.within.asked() && proof.row.has_value()) {
    proof.good = list_good(options, problem, method, *bound, how, proof);
  }
  return proof;
}

/// Empty, or why the text is not a gap.
std::string reject_gap(const std::string& text) {
  double gap = 0;
  const bool read = CLI::detail::lexical_cast(text, gap);
  if (read && gap >= kLeastGap && gap <= 1) return "";
  return fmt::format("got '{}', expected a number from {:g} to 1", text, kLeastGap);
}

/// Without a posture that has a value, or without a bound, there is nothing to certify.
void write_certificate(const ProofOptions& options, const Proof& proof) {
  if (options.certificate.empty()) return;
  if (!proof.row.has_value() || !std::isfinite(proof.result.bound)) {
    remark(options.certificate + ": not written: there is no value or no bound");
    return;
  }
  write_file(options.certificate,
             certificate_text(proof.boxes.certificate(proof.row, proof.result, options.gap)));
}

void print_proof_object(const ProofOptions& options, const Problem& problem, const Proof& proof) {
  const Answer& row = proof.row;
  const CertifyResult& result = proof.result;
  const bool found = row.has_value();
  nlohmann::ordered_json object = {{"problem", options.choice.problem},
                                   {"measure", row.choice.measure},
                                   {"wrench", to_string(row.choice.wrench)},
                                   {"status", to_string(result.status)},
                                   {"reason", result.reason.str()},
                                   {"beta", known(found, row.capability.beta)},
                                   {"bound", known(std::isfinite(result.bound), result.bound)},
                                   {"unit", row.unit},
                                   {"gap", known(std::isfinite(proof.gap()), proof.gap())},
                                   {"asked", options.gap},
                                   {"collision", problem.robot.collision != nullptr}};
  object["theta_r"] = known(found, array(row.posture.theta_r));
  object["theta"] = nullptr;
  if (found) object["theta"] = theta(problem.robot, row.posture.base, row.posture.q);
  object["residual"] = known(found, to_json(row.capability.residual));
  object["search"] = proof.search;
  object["search_s"] = proof.search_s;
  object["boxes"] = result.boxes;
  object["colliding"] = result.colliding;
  object["wall_s"] = result.seconds;
  object["within"] = nullptr;
  if (proof.good) object["within"] = to_json(*proof.good, options.within);
  object["version"] = version();
  print_json(object);
}

void print_proof_text(const ProofOptions& options, const Problem& problem, const Proof& proof) {
  const Answer& row = proof.row;
  const CertifyResult& result = proof.result;
  fmt::print("{}  measure {}  wrench {}{}\n", problem.name, row.choice.measure,
             to_string(row.choice.wrench), problem.robot.collision ? "" : "  collisions ignored");
  fmt::print("{}{}{}\n", to_string(result.status), result.reason.empty() ? "" : ": ",
             result.reason.c_str());
  if (row.has_value()) {
    fmt::print("theta_r   {}\n", line(row.posture.theta_r));
    fmt::print("beta      {:>9.5f} {}\n", row.capability.beta, row.unit);
  }
  if (std::isfinite(result.bound)) {
    fmt::print("bound     {:>9.5f} {}: no posture has more\n", result.bound, row.unit);
  } else if (result.status != Status::kProven) {
    fmt::print("bound     none proven\n");
  }
  if (row.has_value()) {
    fmt::print("gap       {}\nresidual {}\n",
               std::isfinite(proof.gap()) ? percent(proof.gap()) : "unknown",
               line(row.capability.residual));
  }
  fmt::print("boxes     {}, {} of them in collision, in {:.3g} s, after a search of {:.3g} s\n",
             result.boxes, result.colliding, result.seconds, proof.search_s);
  if (proof.good) print_good(problem, *proof.good, options.within);
}

void add_proof_options(CLI::App& command, ProofOptions& options) {
  command.add_option("problem", options.choice.problem, kProblemHelp)->required();
  options.source.add(command);
  command
      .add_option("--measure", options.choice.measure, "linf_polytope, l2_polytope or ellipsoid")
      ->capture_default_str();
  command
      .add_option("--wrench", options.wrench, "pure: along c only; any: other components are free")
      ->capture_default_str();
  command
      .add_option("--gap", options.gap,
                  "relative gap between bound and beta at which the proof ends")
      ->capture_default_str()
      ->check(reject_gap);
  command.add_option("--time", options.seconds, "time limit [s], after which a bracket is printed")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e9));
  command.add_flag("--ignore-collision", options.ignore_collision, "allow postures that collide");
  command
      .add_option("--certificate", options.certificate,
                  "file for the certificate, which 'verify' checks")
      ->check(reject_empty);
  options.within.add(command);
  options.add_threads(command);
  options.add_json(command);
}

}  // namespace

void add_certify(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<ProofOptions>();
  CLI::App& command = *app.add_subcommand(
      "certify", "finds the largest capability and proves that no posture has more");
  add_proof_options(command, *options);
  command.callback([options, &exit_status] {
    require_apart(options->source.inputs(options->choice.problem),
                  {{"--certificate", options->certificate},
                   {"--figure", options->within.figure},
                   {"--boxes", options->within.boxes}});
    if (options->within.asked()) {
      options->gap = std::min(options->gap, kGapPart * options->within.share());
    }
    throw_on_choices(*options);
    Problem problem = options->source.load(options->choice.problem);
    throw_on_dependents(*options, problem);
    if (options->ignore_collision) problem.robot.collision = nullptr;
    const Proof proof = prove(*options, problem);
    write_certificate(*options, proof);
    if (proof.good) write_good(proof.row, *proof.good, options->within);
    if (options->json) {
      print_proof_object(*options, problem, proof);
    } else {
      print_proof_text(*options, problem, proof);
    }
    exit_status = proof.complete() ? kAnswered : kOtherStatus;
  });
}

}  // namespace maxwrench
