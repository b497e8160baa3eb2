#include "solvers/certify/certify.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "benchmarks/proof_recorder.h"
#include "benchmarks/write_file.h"
#include "cli/cli.h"
#include "cli/ctrl_c.h"
#include "cli/output.h"
#include "cli/pieces.h"
#include "cli/progress.h"
#include "maxwrench/load.h"
#include "maxwrench/version.h"

namespace maxwrench {
namespace {

struct ProofOptions : CommonOptions {
  double gap = CertifyOptions().gap;
  double seconds = 60;
  bool ignore_collision = false;
  std::string certificate;
};

/// What was proven of the best posture that was found.
struct Proof {
  Row row;  ///< of the posture, evaluated anew
  CertifyResult result;
  double search_s = 0;
  ProofRecorder boxes;  ///< if there is to be a certificate

  /// Of |beta|; infinite without a posture.
  double gap() const {
    if (!row.has_value()) return kInfinity;
    return (result.bound - row.capability.beta) / std::abs(row.capability.beta);
  }
};

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

/// One line on stderr, only if that is a terminal and a second has passed.
class GapLine {
 public:
  void show(double bound, double beta) {
    if (!enabled_ || std::chrono::steady_clock::now() < next_) return;
    next_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
    drawn_ = true;
    std::fputs(fmt::format("\rcertify gap {}  {:.0f} s\x1b[K",
                           percent((bound - beta) / std::abs(beta)), seconds_since(start_))
                   .c_str(),
               stderr);
    std::fflush(stderr);
  }
  ~GapLine() {
    if (drawn_) std::fputs("\r\x1b[K", stderr);
  }

 private:
  bool enabled_ = isatty(fileno(stderr)) != 0, drawn_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(),
                                        next_ = start_ + std::chrono::seconds(1);
};

/// What checks a certificate evaluates postures of a given pose whose base follows in closed form.
void refuse_certificate(const std::string& file, const Problem& problem) {
  const bool given = problem.dependent.empty() && !problem.contact && problem.free.count() == 0;
  if (file.empty() || given) return;
  throw std::invalid_argument(
      "--certificate: got a task with joints that follow from theta_r, a "
      "second contact or free coordinates of the pose, expected one "
      "without");
}

/// Searches, then bounds. What was found while bounding is evaluated anew, too.
Proof prove(const ProofOptions& options, const Problem& problem) {
  Case c = options.read_case();
  const auto bound = make_capability_bound(problem, c.measure, c.wrench);
  c.search = best_search(problem, c.measure);
  const Method method = resolve(problem, c);
  CtrlC ctrl_c;
  Proof proof;
  {
    Progress progress("search", method.choice.budget);
    proof.row =
        solve(problem, method, options.thread_count(), progress.counter(), &ctrl_c.interruption);
  }
  proof.search_s = proof.row.wall_s;
  GapLine line;
  CertifyOptions how;
  how.gap = options.gap;
  how.seconds = options.seconds;
  how.threads = options.thread_count();
  how.interrupted = [&ctrl_c] { return ctrl_c.interruption.asked.load(); };
  if (!options.certificate.empty()) {
    how.sink = [&proof](const CertifiedBox& box) { proof.boxes.add(box); };
  }
  how.progress = [&line](double most, double beta) { line.show(most, beta); };
  Candidate incumbent;
  if (proof.row.has_value()) {
    incumbent = {proof.row.posture.theta_r, proof.row.capability.beta};
  }
  const auto objective = make_capability_objective(problem, c.wrench, method.make_measure);
  proof.result = certify(*objective, *bound, incumbent, how);
  const Candidate& best = proof.result.best;
  if (best.value > incumbent.value) proof.row = evaluate(problem, method, best.theta_r);
  if (best.value == -kInfinity) {
    if (proof.result.status == Status::kProven) proof.result.reason = "no posture has a value";
  } else if (!proof.row.has_value()) {
    static_cast<Verdict&>(proof.result) = proof.row;
  }
  return proof;
}

/// Empty, or why the text is no gap.
std::string refuse_gap(const std::string& text) {
  double gap = 0;
  const bool read = CLI::detail::lexical_cast(text, gap);
  if (read && gap >= kLeastGap && gap <= 1) return "";
  return fmt::format("got '{}', expected a number of {:g} to 1", text, kLeastGap);
}

/// Without a posture of a value, or a bound, there is nothing to certify.
void write_certificate(const ProofOptions& options, const Problem& problem, const Proof& proof) {
  if (options.certificate.empty()) return;
  if (!proof.row.has_value() || !std::isfinite(proof.result.bound)) {
    remark(options.certificate + ": not written, as there is no value or no bound");
    return;
  }
  write_file(options.certificate, certificate_text(proof.boxes.certificate(
                                      problem, proof.row, proof.result, options.gap)));
}

void print_object(const ProofOptions& options, const Problem& problem, const Proof& proof) {
  const Row& row = proof.row;
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
  object["search"] = row.choice.search;
  object["search_s"] = proof.search_s;
  object["boxes"] = result.boxes;
  object["colliding"] = result.colliding;
  object["wall_s"] = result.seconds;
  object["version"] = version();
  print_json(object);
}

void print_text(const Problem& problem, const Proof& proof) {
  const Row& row = proof.row;
  const CertifyResult& result = proof.result;
  fmt::print("{}  measure {}  wrench {}{}\n", problem.name, row.choice.measure,
             to_string(row.choice.wrench), problem.robot.collision ? "" : "  collisions ignored");
  fmt::print("{}{}{}\n", to_string(result.status), result.reason.empty() ? "" : ": ",
             result.reason.c_str());
  if (row.has_value()) {
    fmt::print("theta_r   {}\n", line(row.posture.theta_r));
    fmt::print("beta      {:>9.5f} {}\n", row.capability.beta, row.unit);
  }
  fmt::print("bound     {:>9.5f} {}: no posture has more\n", result.bound, row.unit);
  if (row.has_value()) {
    fmt::print("gap       {}\nresidual {}\n", percent(proof.gap()), line(row.capability.residual));
  }
  fmt::print("boxes     {}, {} of them in collision, in {:.3g} s, after a search of {:.3g} s\n",
             result.boxes, result.colliding, result.seconds, proof.search_s);
}

void add_proof_options(CLI::App& command, ProofOptions& options) {
  command
      .add_option("problem", options.choice.problem,
                  "shipped name such as planar/force, or a task file")
      ->required();
  command
      .add_option("--measure", options.choice.measure, "linf_polytope, l2_polytope or ellipsoid")
      ->capture_default_str();
  command
      .add_option("--wrench", options.wrench, "pure: only along c; any: other components are free")
      ->capture_default_str();
  command.add_option("--gap", options.gap, "of the bound to beta that is to be reached")
      ->capture_default_str()
      ->check(refuse_gap);
  command.add_option("--time", options.seconds, "s, after which a bracket is printed")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e9));
  command.add_flag("--ignore-collision", options.ignore_collision,
                   "count postures that collide, too");
  command
      .add_option("--certificate", options.certificate, "file for the proof, which 'verify' checks")
      ->check(refuse_empty);
  options.add_threads(command);
  options.add_json(command);
}

}  // namespace

void add_certify(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<ProofOptions>();
  CLI::App& command = *app.add_subcommand(
      "certify", "the largest capability, and a proof that no posture has more");
  add_proof_options(command, *options);
  command.callback([options, &exit_status] {
    require_apart({{"problem", options->choice.problem}},
                  {{"--certificate", options->certificate}});
    Problem problem = load_problem(options->choice.problem);
    refuse_certificate(options->certificate, problem);
    if (options->ignore_collision) problem.robot.collision = nullptr;
    const Proof proof = prove(*options, problem);
    write_certificate(*options, problem, proof);
    if (options->json) {
      print_object(*options, problem, proof);
    } else {
      print_text(problem, proof);
    }
    exit_status = proof.result.status == Status::kProven ? kAnswered : kOtherStatus;
  });
}

}  // namespace maxwrench
