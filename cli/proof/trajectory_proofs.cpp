#include "cli/proof/trajectory_proofs.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "maxwrench/load.h"
#include "maxwrench/version.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

/// "5.2e-05 m", or "nothing was checked".
std::string words_of_clearance(double clearance) {
  return std::isfinite(clearance) ? fmt::format("at least {:.3g} m beyond the margin", clearance)
                                  : "not checked";
}

std::string verdict_words(const Verdict& verdict) {
  return fmt::format("{}{}{}", to_string(verdict.status), verdict.reason.empty() ? "" : ": ",
                     verdict.reason.c_str());
}

/// The value that is guaranteed, as a line of text; empty if there is none.
std::string guaranteed_line(const TrajectoryProof& proof) {
  if (proof.status != Status::kProven) return "";
  return fmt::format("guaranteed {:>8.5f} {}: proven {}\n", proof.guaranteed, proof.answer.unit,
                     proof.answer.task->motion->impulse ? "at the peak" : "at every instant");
}

nlohmann::ordered_json to_object(const TrajectoryProof& proof) {
  const bool proven = proof.status == Status::kProven;
  return {{"status", to_string(proof.status)},
          {"reason", proof.reason.str()},
          {"guaranteed", known(proven, proof.guaranteed)},
          {"t", known(std::isfinite(proof.t), proof.t)},
          {"parts", known(proven, proof.parts)},
          {"slices", known(proven, proof.slices)},
          {"clearance", known(proven && std::isfinite(proof.clearance), proof.clearance)},
          {"wall_s", proof.seconds}};
}

/// The scenario with the least factor, as a line of text; empty if there is no list.
std::string decides_line(std::size_t scenarios, const std::string& decides) {
  if (scenarios == 0) return "";
  return fmt::format("decides    {}, of {} scenarios that are proven one by one\n", decides,
                     scenarios);
}

void print_proof_of(const TrajectoryProof& proof, const Problem& problem, bool json) {
  const Answer& answer = proof.answer;
  const Trajectory& trajectory = answer.trajectory;
  if (json) {
    nlohmann::ordered_json object = {{"problem", problem.name},
                                     {"scheme", to_string(problem.motion->scheme)}};
    object.update(to_object(proof));
    object["value"] = known(std::isfinite(trajectory.value), trajectory.value);
    object["value_between_knots"] =
        known(std::isfinite(trajectory.value_between_knots), trajectory.value_between_knots);
    object["unit"] = answer.unit;
    if (!proof.decides.empty()) object["decides"] = proof.decides;
    object["collision"] = answer.collision;
    object["version"] = version();
    print_json(object);
  } else {
    fmt::print("{}  scheme {}{}\n{}\n", problem.name, to_string(problem.motion->scheme),
               answer.collision ? "" : "  collisions ignored", verdict_words(proof));
    if (std::isfinite(trajectory.value)) {
      fmt::print("value      {:>8.5f} {}: at the instants of the scheme\n", trajectory.value,
                 answer.unit);
    }
    if (std::isfinite(trajectory.value_between_knots)) {
      fmt::print("value_between_knots {:.5f} {}\n", trajectory.value_between_knots, answer.unit);
    }
    fmt::print("{}", guaranteed_line(proof));
    if (proof.status == Status::kProven) {
      fmt::print("{}", decides_line(static_cast<std::size_t>(proof.scenarios), proof.decides));
      fmt::print("clearance  {}\n", words_of_clearance(proof.clearance));
      fmt::print("slices     {}, {} parts between knots, in {:.3g} s\n", proof.slices, proof.parts,
                 proof.seconds);
    }
  }
}

}  // namespace

int certify_trajectory(const Problem& problem, const Eigen::MatrixXd& knots, const Options& options,
                       const std::string& certificate, bool json) {
  TrajectoryProofOptions how;
  how.keep_certificate = !certificate.empty();
  const TrajectoryProof proof = certify_trajectory(problem, knots, options, how);
  if (!proof.certificate.empty()) {
    write_file(certificate, proof.certificate);
  } else if (!certificate.empty()) {
    remark(certificate + ": not written: nothing is proven");
  }
  print_proof_of(proof, problem, json);
  return proof.status == Status::kProven ? kAnswered : kOtherStatus;
}

int report_proven(const TrajectoryProof& proof, bool json) {
  const bool another = std::isfinite(proof.searched);
  if (json) {
    auto object = nlohmann::ordered_json::parse(to_json(proof.answer));
    object["guaranteed"] = known(proof.status == Status::kProven, proof.guaranteed);
    object["proof"] = to_object(proof);
    object["proof"]["searched"] = known(another, proof.searched);
    object["proof"]["rejection"] = proof.rejection;
    object["proof"]["held"] = proof.held;
    print_json(object);
  } else {
    fmt::print("{}", summary(proof.answer));
    if (another) {
      fmt::print("searched   {:>8.5f} {}: another trajectory; {}\n", proof.searched,
                 proof.answer.unit, proof.rejection);
    }
    if (proof.held) fmt::print("held       the default posture: more is proven of no other\n");
    fmt::print("{}{}\n", guaranteed_line(proof),
               proof.status == Status::kProven ? "proven" : "not proven: " + verdict_words(proof));
  }
  return proof.status == Status::kProven && proof.answer.answered() ? kAnswered : kOtherStatus;
}

int verify_trajectory_file(const std::string& file, const std::string& problem, int threads,
                           bool json) {
  const VerifiedTrajectory proof = verify_trajectory_certificate(
      file, [&](const std::string& name) { return load_problem(problem.empty() ? name : problem); },
      threads);
  if (json) {
    nlohmann::ordered_json object = {
        {"problem", proof.problem},
        {"status", proof.verified() ? "verified" : "rejected"},
        {"reason", proof.rejection},
        {"guaranteed", proof.guaranteed},
        {"unit", proof.unit},
        {"t", known(proof.t >= 0, proof.t)},
        {"collision", proof.collision},
        {"clearance", known(proof.verified() && std::isfinite(proof.clearance), proof.clearance)},
        {"knots", proof.knots.rows()},
        {"parts", proof.parts},
        {"slices", proof.slices},
        {"wall_s", proof.seconds},
        {"version", proof.version}};
    if (proof.scenarios > 0) object["decides"] = proof.decides;
    print_json(object);
  } else {
    fmt::print("{}{}\n", proof.problem, proof.collision ? "" : "  collisions ignored");
    const std::string when = proof.t >= 0 ? fmt::format("t = {:.5g} s: ", proof.t) : "";
    fmt::print("{}\n", proof.verified() ? "verified" : "rejected: " + when + proof.rejection);
    if (std::isfinite(proof.guaranteed)) {
      fmt::print("guaranteed {:>8.5f} {}{}\n", proof.guaranteed, proof.unit,
                 !proof.verified() ? ", as claimed"
                 : proof.t_h > 0   ? ": proven at the peak"
                                   : ": proven at every instant");
    }
    if (proof.verified()) fmt::print("{}", decides_line(proof.scenarios, proof.decides));
    if (proof.verified()) fmt::print("clearance  {}\n", words_of_clearance(proof.clearance));
    fmt::print("slices     {}, {} parts between knots\n", proof.slices, proof.parts);
    fmt::print("checked in {:.3g} s, written by maxwrench {}\n", proof.seconds, proof.version);
  }
  return proof.verified() ? kAnswered : kOtherStatus;
}

}  // namespace maxwrench
