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
#include "cli/proof/good_postures.h"
#include "cli/proof/plan_bounds.h"
#include "cli/proof/prove.h"
#include "cli/proof/trajectory_proofs.h"
#include "cli/task/motion_options.h"
#include "cli/task/problem_options.h"
#include "maxwrench/load.h"
#include "maxwrench/version.h"
#include "solvers/certify/proof.h"
#include "solvers/certify/proof_recorder.h"
#include "solvers/solve/format.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

struct CertifyCommandOptions : CommonOptions {
  double gap = ProofOptions().gap;
  double seconds = ProofOptions().seconds;
  bool ignore_collision = false;
  std::string certificate;
  WithinOptions within;
  ProblemOptions source;
  std::optional<std::string> theta_r;  ///< of a task in time
  bool bound = false;                  ///< of a task in time with theta_r: what no other exceeds
  MotionOptions motion;
};

/// The proof, and what the command adds to it.
struct Certified {
  Proof proof;
  ProofRecorder boxes;               ///< filled if a certificate is requested
  std::optional<GoodPostures> good;  ///< if requested, and if there is a value

  bool complete() const {
    return proof.status == Status::kProven && (!good || good->status == Status::kProven);
  }
};

/// `verify` reads the task again by its name, without the options of `certify`.
void throw_on_choices(const CertifyCommandOptions& options) {
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

/// Without a trajectory, bounds all trajectories of a task in time; else proves the given one.
/// `command` has the options of static tasks, too.
int certify_motion(const CertifyCommandOptions& options, const CLI::App& command,
                   const Problem& problem) {
  reject_given(command, {"--within", "--resolution", "--figure", "--boxes"},
               problem.name + ", a task in time, expected a static task");
  if (!options.theta_r || options.bound) {
    reject_given(command, {"--certificate"},
                 "a bound on all trajectories, which has none, expected --theta-r without "
                 "--bound");
    const Eigen::MatrixXd knots =
        options.theta_r ? knots_of(problem, options.theta_r) : Eigen::MatrixXd();
    return bound_trajectories(problem, options.read_options(),
                              {.gap = options.gap, .seconds = options.seconds}, knots,
                              options.json);
  }
  reject_given(command, {"--gap", "--time"},
               "the proof of one trajectory, expected it without --theta-r or with --bound");
  if (!options.certificate.empty() && options.motion.t_h) {
    throw std::invalid_argument("--certificate: got --t-h " + *options.motion.t_h +
                                ", expected the peak that the task has without it");
  }
  if (!options.certificate.empty() && options.motion.thruster_lag) {
    throw std::invalid_argument(
        fmt::format("--certificate: got --thruster-lag {}, expected motion.thruster_lag in the "
                    "task's file",
                    *options.motion.thruster_lag));
  }
  require_apart(
      {{"path.file", problem.motion->path_file}, {"--theta-r", options.theta_r.value_or("")}},
      {{"--certificate", options.certificate}});
  return certify_trajectory(problem, knots_of(problem, options.theta_r), options.read_options(),
                            options.certificate, options.json);
}

/// Neither the check of a certificate nor the list of good postures supports all tasks.
void throw_on_unsupported(const CertifyCommandOptions& options, const Problem& problem) {
  const Options of = options.read_options();
  const std::string got = why_no_certificate(problem, of.wrench);
  if (!options.certificate.empty() && !got.empty()) {
    throw std::invalid_argument("--certificate: got " + got + ", expected one without");
  }
  options.within.require_listable(problem);
}

Certified prove(const CertifyCommandOptions& options, const Problem& problem) {
  CtrlC ctrl_c;
  Options c = options.read_options();
  c.interrupted = ctrl_c.asked();
  Certified certified;
  certified.proof =
      prove_with_progress(problem, c, {.gap = options.gap, .seconds = options.seconds},
                          options.certificate.empty() ? nullptr : &certified.boxes);
  if (options.within.asked() && certified.proof.answer.has_value()) {
    certified.good =
        list_with_progress(problem, options.within, c, options.seconds, certified.proof);
  }
  return certified;
}

/// Empty, or why the text is not a gap.
std::string reject_gap(const std::string& text) {
  double gap = 0;
  const bool read = CLI::detail::lexical_cast(text, gap);
  if (read && gap >= kLeastGap && gap <= 1) return "";
  return fmt::format("got '{}', expected a number from {:g} to 1", text, kLeastGap);
}

/// Without a posture that has a value, or without a bound, there is nothing to certify.
void write_certificate(const CertifyCommandOptions& options, const Certified& certified) {
  if (options.certificate.empty()) return;
  const Proof& proof = certified.proof;
  if (!proof.answer.has_value() || !std::isfinite(proof.bound)) {
    remark(options.certificate + ": not written: there is no value or no bound");
    return;
  }
  write_file(options.certificate,
             certificate_text(certified.boxes.certificate(proof.answer, proof.bound, options.gap)));
}

void print_proof_object(const CertifyCommandOptions& options, const Problem& problem,
                        const Certified& certified) {
  const Proof& proof = certified.proof;
  const Answer& row = proof.answer;
  const bool found = row.has_value();
  nlohmann::ordered_json object = {{"problem", options.choice.problem},
                                   {"measure", row.choice.measure},
                                   {"wrench", to_string(row.choice.wrench)},
                                   {"status", to_string(proof.status)},
                                   {"reason", proof.reason.str()},
                                   {"beta", known(found, row.capability.beta)},
                                   {"bound", known(std::isfinite(proof.bound), proof.bound)},
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
  object["boxes"] = proof.boxes;
  object["colliding"] = proof.colliding;
  object["wall_s"] = proof.seconds;
  object["within"] = nullptr;
  if (certified.good) object["within"] = to_json(problem, *certified.good, options.within);
  object["version"] = version();
  print_json(object);
}

void print_proof_text(const CertifyCommandOptions& options, const Problem& problem,
                      const Certified& certified) {
  const Proof& proof = certified.proof;
  const Answer& row = proof.answer;
  fmt::print("{}  measure {}  wrench {}{}\n", problem.name, row.choice.measure,
             to_string(row.choice.wrench), problem.robot.collision ? "" : "  collisions ignored");
  fmt::print("{}{}{}\n", to_string(proof.status), proof.reason.empty() ? "" : ": ",
             proof.reason.c_str());
  if (row.has_value()) {
    fmt::print("theta_r   {}\n", line(row.posture.theta_r));
    fmt::print("beta      {:>9.5f} {}\n", row.capability.beta, row.unit);
  }
  if (std::isfinite(proof.bound)) {
    fmt::print("bound     {:>9.5f} {}: no posture has more\n", proof.bound, row.unit);
  } else if (proof.status != Status::kProven) {
    fmt::print("bound     none proven\n");
  }
  if (row.has_value()) {
    fmt::print("gap       {}\nresidual {}\n",
               std::isfinite(proof.gap()) ? percent(proof.gap()) : "unknown",
               line(row.capability.residual));
  }
  fmt::print("boxes     {}, {} of them in collision, in {:.3g} s, after a search of {:.3g} s\n",
             proof.boxes, proof.colliding, proof.seconds, proof.search_s);
  if (certified.good) print_good(problem, *certified.good, options.within);
}

void add_proof_options(CLI::App& command, CertifyCommandOptions& options) {
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
  add_theta_r(command, options.theta_r, "none, of a task in time a bound on all trajectories");
  command.add_flag("--bound", options.bound,
                   "of a task in time with --theta-r: what no trajectory exceeds, and the gap");
  options.motion.add(command);
  options.add_threads(command);
  options.add_json(command);
}

}  // namespace

void add_certify(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<CertifyCommandOptions>();
  CLI::App& command = *app.add_subcommand(
      "certify",
      "finds the largest capability and proves that no posture has more; of a task in time: what "
      "no trajectory exceeds or, with --theta-r, what a trajectory exerts at every instant");
  add_proof_options(command, *options);
  command.callback([options, &command, &exit_status] {
    require_apart(options->source.inputs(options->choice.problem),
                  {{"--certificate", options->certificate},
                   {"--figure", options->within.figure},
                   {"--boxes", options->within.boxes}});
    if (options->within.asked()) {
      options->gap = std::min(options->gap, kGapPart * options->within.share());
    }
    throw_on_choices(*options);
    Problem problem = options->source.load(options->choice.problem);
    options->motion.change(problem);
    if (options->ignore_collision) problem.robot.collision = nullptr;
    if (problem.motion) {
      exit_status = certify_motion(*options, command, problem);
      return;
    }
    if (options->theta_r || options->bound) {
      throw std::invalid_argument(std::string(options->theta_r ? "--theta-r" : "--bound") +
                                  ": got " + problem.name +
                                  ", a static task, expected a task in time");
    }
    throw_on_unsupported(*options, problem);
    const Certified certified = prove(*options, problem);
    write_certificate(*options, certified);
    if (certified.good) write_good(certified.proof.answer, *certified.good, options->within);
    if (options->json) {
      print_proof_object(*options, problem, certified);
    } else {
      print_proof_text(*options, problem, certified);
    }
    exit_status = certified.complete() ? kAnswered : kOtherStatus;
  });
}

}  // namespace maxwrench
