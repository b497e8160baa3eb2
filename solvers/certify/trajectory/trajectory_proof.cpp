#include "maxwrench/trajectory_proof.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include "maxwrench/batch.h"
#include "maxwrench/strategies.h"
#include "maxwrench/version.h"
#include "solvers/certify/trajectory/edge_program.h"
#include "solvers/solve/method.h"
#include "solvers/solve/scenario_alone.h"
#include "verify/trajectory/provable.h"
#include "verify/trajectory/verify_trajectory.h"

namespace maxwrench {
namespace {

using ProofClock = std::chrono::steady_clock;

/// There are more parts while the proof loses more than this share.
constexpr double kLossOfParts = 1e-4;
constexpr int kMostParts = 350;
/// Without a lag the loss falls with the square of the number, so no more are worth their time.
constexpr int kMostPartsWithoutLag = 200;
/// The loss falls a little slower than expected.
constexpr double kMoreThanNeeded = 1.1;
/// The least growth of the number of parts.
constexpr double kFewMore = 1.5;
/// Once there is a proof, the value v is bisected until at most this times 1 + |v| can be gained.
constexpr double kWorthRaising = 1e-5;
/// Shares of the limits' ranges for the enclosures, tried one after another.
constexpr double kSlacks[] = {3e-6, 2e-5, 1e-4, 5e-4, 3e-3};

double seconds_from(ProofClock::time_point start) {
  return std::chrono::duration<double>(ProofClock::now() - start).count();
}

void require_provable_case(const Problem& task, const Options& options) {
  require_provable_task(task);
  if (options.measure != "linf_polytope") {
    throw std::invalid_argument("measure: got " + options.measure +
                                ", expected linf_polytope for a proof in time");
  }
  if (options.wrench != Wrench::kPure) {
    throw std::invalid_argument("wrench: got any, expected pure for a proof in time");
  }
}

void require_parts(int parts) {
  if (parts == 0 || (parts >= 2 && parts <= kMostParts)) return;
  throw std::invalid_argument(
      fmt::format("parts: got {}, expected 0 or a number from 2 to {}", parts, kMostParts));
}

/// One proof, from its task to its certificate.
class TrajectoryProver {
 public:
  /// `t_h`: the peak of an impulse; 0: the best one.
  TrajectoryProver(const Problem& task, const Eigen::MatrixXd& knots, const Options& options,
                   const TrajectoryProofOptions& how, int t_h = 0)
      : task_(task), how_(how), threads_(thread_count(options.threads)) {
    if (!options.check_collision) task_.robot.collision = nullptr;
    proof_.answer = evaluate(task_, knots, options);
    claim_.version = version();
    claim_.problem = task.name;
    claim_.collision = task_.robot.collision != nullptr;
    claim_.digest = motion_digest(task_);
    claim_.knots = knots;
    claim_.dependent = dependent_places(task_, knots);
    if (task.motion->impulse) claim_.t_h = t_h > 0 ? t_h : proof_.answer.trajectory.t_h;
  }

  TrajectoryProof run() {
    const auto start = ProofClock::now();
    if (keeps_limits()) prove_wrench();
    // A base that cannot follow the path, for instance.
    if (proof_.status != Status::kProven && proof_.status != Status::kInvalidPosture &&
        proof_.answer.status == Status::kInvalidPosture) {
      proof_.t = std::numeric_limits<double>::quiet_NaN();
      proof_.conclude(Status::kInvalidPosture, proof_.answer.reason.str());
    }
    proof_.seconds = seconds_from(start);
    if (how_.keep_certificate && proof_.status == Status::kProven) {
      proof_.certificate = certificate_text(best_);
    }
    return std::move(proof_);
  }

  /// What is proven, after `run`.
  const TrajectoryCertificate& best() const { return best_; }

 private:
  void refuse(Status status, const std::string& reason, double t) {
    proof_.t = t >= 0 ? t : std::numeric_limits<double>::quiet_NaN();
    proof_.conclude(status, t >= 0 ? fmt::format("t = {:.5g} s: {}", t, reason) : reason);
  }

  bool keeps_limits() {
    if (!claim_.dependent.allFinite()) {
      refuse(Status::kInvalidPosture, "the dependent joints do not reach the path", -1);
      return false;
    }
    model_.emplace(task_, claim_.knots, claim_.dependent);
    TrajectoryVerification apart;
    const MotionFault fault = check_motion_and_clearance(*model_, apart);
    if (!fault.reason.empty()) {
      refuse(Status::kInvalidPosture, fault.reason, fault.t);
      return false;
    }
    proof_.clearance = apart.clearance;
    return true;
  }

  /// With as many parts as the margins need; with fewer of them if the proof fails with those.
  void prove_wrench() {
    const int usual = task_.motion->impulse ? 50 : 25;
    const int most_parts = task_.motion->thruster_lag > 0 ? kMostParts : kMostPartsWithoutLag;
    if (task_.motion->impulse && claim_.t_h == 0) claim_.t_h = std::max(1, task_.motion->t_h);
    std::vector<int> fewer;  // with efforts that were not tried
    for (int parts = how_.parts > 0 ? how_.parts : usual;;) {
      EdgeProgram program(task_, claim_.knots, parts, claim_.t_h);
      const EdgeEfforts& most = program.most();
      if (most.status == Status::kInfeasible) {
        refuse(most.status, most.reason.str(), most.t);
        break;
      }
      const EdgeEfforts efforts = program.solve(kSlacks[0]);
      const double growth = growth_of_parts(most, efforts);
      if (growth == 1 || parts >= most_parts) {
        if (prove_with(program, parts, efforts)) return;
      } else if (efforts.status == Status::kOptimal) {
        fewer.push_back(parts);
      }
      if (parts >= most_parts) break;
      parts = static_cast<int>(
          std::min(std::ceil(std::max(growth, kFewMore) * parts), static_cast<double>(most_parts)));
    }
    for (; !fewer.empty(); fewer.pop_back()) {
      EdgeProgram program(task_, claim_.knots, fewer.back(), claim_.t_h);
      if (prove_with(program, fewer.back(), program.solve(kSlacks[0]))) return;
    }
  }

  /// By how much the number of parts should grow so that the margins cost at most `kLossOfParts`:
  /// they fall with its square, those of commands in proportion to it.
  double growth_of_parts(const EdgeEfforts& most, const EdgeEfforts& efforts) const {
    if (most.status != Status::kOptimal || efforts.status != Status::kOptimal) return 2;
    const double loss = (most.value - efforts.value) / std::abs(most.value);
    if (!(loss > kLossOfParts)) return 1;
    const double ratio = loss / kLossOfParts;
    return std::max(kFewMore,
                    kMoreThanNeeded * (task_.motion->thruster_lag > 0 ? ratio : std::sqrt(ratio)));
  }

  /// Whether there is a certificate with these parts. `efforts`: those of the first slack.
  bool prove_with(EdgeProgram& program, int parts, EdgeEfforts efforts) {
    const EdgeEfforts& most = program.most();
    if (most.status != Status::kOptimal) refuse(most.status, most.reason.str(), most.t);
    for (const double slack : kSlacks) {
      if (slack != kSlacks[0]) efforts = program.solve(slack);
      if (efforts.status == Status::kInfeasible) break;
      if (efforts.status != Status::kOptimal) continue;
      claim_.parts = parts;
      claim_.y = efforts.y;
      claim_.w = efforts.w;
      claim_.value = efforts.value;
      const MotionFault fault = keep_if_proven();
      if (fault.reason.empty()) {
        if (claim_.w.size() == 0 && most.status == Status::kOptimal) raise(most.value);
        return true;
      }
      refuse(Status::kNumericalError, "not enclosed: " + fault.reason, fault.t);
    }
    if (proof_.reason.empty()) {
      refuse(Status::kNumericalError, "no efforts have the margin that a proof needs", -1);
    }
    return false;
  }

  /// The efforts have a margin, so along a path they may exert more than the value that they were
  /// found for, unless the certificate also holds the wrench at the edges.
  void raise(double most) {
    double low = claim_.value;
    while (most - low > kWorthRaising * (1 + std::abs(most))) {
      claim_.value = (low + most) / 2;
      (keep_if_proven().reason.empty() ? low : most) = claim_.value;
    }
  }

  /// By all checks of `verify`: the motion has passed its own.
  MotionFault keep_if_proven() {
    TrajectoryVerification check;
    MotionFault fault = check_efforts(*model_, claim_, threads_, check);
    if (!fault.reason.empty()) return fault;
    proof_.conclude(Status::kProven);
    proof_.t = std::numeric_limits<double>::quiet_NaN();
    proof_.guaranteed = claim_.value;
    proof_.parts = claim_.parts;
    proof_.slices = check.slices;
    best_ = claim_;
    return fault;
  }

  Problem task_;
  const TrajectoryProofOptions& how_;
  const int threads_;
  std::optional<TrajectoryModel> model_;
  TrajectoryCertificate claim_, best_;
  TrajectoryProof proof_;
};

/// Proves one scenario after the other.
TrajectoryProof prove_scenarios(const Problem& given, const Eigen::MatrixXd& knots,
                                const Options& options, const TrajectoryProofOptions& how) {
  Problem task = given;
  if (!options.check_collision) task.robot.collision = nullptr;
  TrajectoryProof all;
  all.answer = evaluate(task, knots, options);
  all.conclude(Status::kProven);
  all.guaranteed = kInfinity;
  std::vector<TrajectoryCertificate> claims;
  for (int i = 0; i < scenario_count(task); ++i) {
    const ScenarioTask one = scenario_alone(task, i);
    require_provable(one.task);
    TrajectoryProver prover(one.task, knots, options, how, all.answer.trajectory.t_h);
    const TrajectoryProof proof = prover.run();
    all.seconds += proof.seconds;
    all.slices += proof.slices;
    all.parts = std::max(all.parts, proof.parts);
    all.clearance = std::min(all.clearance, proof.clearance);
    if (proof.status != Status::kProven) {
      all.conclude(proof.status, one.name + ": " + proof.reason.str());
      all.t = proof.t;
      all.decides = one.name;
      all.guaranteed = std::numeric_limits<double>::quiet_NaN();
      return all;
    }
    ++all.scenarios;
    claims.push_back(prover.best());
    const double factor = least_factor(proof.guaranteed, one.length);
    if (!(factor < all.guaranteed)) continue;
    all.guaranteed = factor;
    all.decides = one.name;
  }
  if (how.keep_certificate) all.certificate = certificate_text(claims);
  return all;
}

}  // namespace

TrajectoryProof certify_trajectory(const Problem& task, const Eigen::MatrixXd& knots,
                                   const Options& options, const TrajectoryProofOptions& how) {
  require_provable_case(task, options);
  require_parts(how.parts);
  if (!task.scenarios.empty()) return prove_scenarios(task, knots, options, how);
  return TrajectoryProver(task, knots, options, how).run();
}

bool is_trajectory_certificate(const std::filesystem::path& file) {
  return is_trajectory_certificate(file.string());
}

VerifiedTrajectory verify_trajectory_certificate(
    const std::filesystem::path& file, const std::function<Problem(const std::string& name)>& load,
    int threads) {
  const auto start = ProofClock::now();
  const std::vector<TrajectoryCertificate> claims = read_trajectory_certificates(file.string());
  const TrajectoryCertificate& claim = claims.front();
  Problem task = load(claim.problem);
  if (!claim.collision) task.robot.collision = nullptr;
  VerifiedTrajectory result;
  const TaskVerification check = verify(task, claims, thread_count(threads));
  static_cast<TrajectoryVerification&>(result) = check;
  result.decides = check.decides;
  result.scenarios = task.scenarios.empty() ? 0 : claims.size();
  result.version = claim.version;
  result.problem = task.name;
  result.collision = claim.collision;
  result.unit = task.unit();
  result.knots = claim.knots;
  result.guaranteed = check.guaranteed;
  result.t_h = claim.t_h;
  result.parts = claim.parts;
  result.seconds = seconds_from(start);
  return result;
}

}  // namespace maxwrench
