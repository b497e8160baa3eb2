#include "solvers/certify/proof.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "lib/scenario/scenario_list.h"
#include "maxwrench/problem.h"
#include "solvers/certify/proof_recorder.h"
#include "solvers/solve/method.h"
#include "verify/certificate.h"
#include "verify/verify.h"

namespace maxwrench {
namespace {

/// The gap of a proof is reached up to this share.
constexpr double kGapRounding = 1e-6;

/// The gap of a proof, which of a value of zero is infinite unless the bound is zero, too.
double relative_gap(double bound, double value) {
  return bound == value ? 0 : (bound - value) / std::abs(value);
}

/// Replaces the answer of a search by that at a better point, if this one can be verified. It is
/// still what the search with the bounds found.
void take_better(const Eigen::VectorXd& theta_r, const Options& options, Answer& answer) {
  Answer better = evaluate(*answer.task, theta_r, options);
  if (!better.has_value() || (answer.has_value() && better.beta() <= answer.beta())) return;
  better.conclude(Status::kBestFound);
  better.choice = answer.choice;
  better.evaluations = answer.evaluations;
  better.calls = answer.calls;
  better.stopped = answer.stopped;
  better.undecided = answer.undecided;
  better.ik_solutions = answer.ik_solutions;
  better.wall_s = answer.wall_s;
  answer = std::move(better);
}

}  // namespace

std::unique_ptr<Bound> find_bound(const Problem& problem, const std::string& measure,
                                  Wrench wrench) {
  try {
    return make_capability_bound(problem, measure, wrench);
  } catch (const std::invalid_argument&) {
    return nullptr;
  }
}

Eigen::Index boxed_coordinates(const Problem& problem, const Bound& bound) {
  Eigen::VectorXd lower = problem.theta_r_min, upper = problem.theta_r_max;
  bound.extend(lower, upper);
  return lower.size();
}

CertifyResult prove(const Problem& problem, const Method& method, const Bound& bound,
                    const Candidate& incumbent, const CertifyOptions& options) {
  const auto objective =
      make_capability_objective(problem, method.choice.wrench, method.make_measure);
  return certify(*objective, bound, incumbent, options);
}

double Proof::gap() const {
  if (!answer.has_value()) return kInfinity;
  return relative_gap(bound, answer.capability.beta);
}

Proof certify(const Problem& task, const Options& options, const ProofOptions& how,
              ProofRecorder* recorder) {
  if (recorder) require_no_scenarios(task, "certificate");
  Options c = options;
  if (c.budget == 0) c.budget = kUsualBudget;
  c.check_collision = true;
  const auto limits = make_capability_bound(task, c.measure, c.wrench);  // first, as it may throw
  const Method method = resolve(task, c);
  CertifyOptions own;
  own.gap = how.gap;
  own.seconds = how.seconds;
  own.threads = thread_count(c.threads);
  own.interrupted = c.interrupted;
  own.progress = how.progress;
  if (recorder) own.sink = [recorder](const CertifiedBox& box) { recorder->add(box); };
  require_valid(own);
  Proof proof;
  proof.answer = solve(task, c);
  proof.search = proof.answer.choice.search;
  proof.search_s = proof.answer.wall_s;
  Candidate incumbent;
  if (proof.answer.has_value()) {
    incumbent = {proof.answer.posture.theta_r, proof.answer.capability.beta};
  }
  const CertifyResult result = prove(task, method, *limits, incumbent, own);
  static_cast<Verdict&>(proof) = result;
  proof.bound = result.bound;
  proof.boxes = result.boxes;
  proof.colliding = result.colliding;
  proof.seconds = result.seconds;
  if (result.best.value > incumbent.value) take_better(result.best.theta_r, c, proof.answer);
  if (result.best.value == -kInfinity) {
    if (proof.status == Status::kProven) proof.reason = "no posture has a value";
  } else if (!proof.answer.has_value()) {
    static_cast<Verdict&>(proof) = proof.answer;
  } else if (proof.status == Status::kProven && proof.gap() > how.gap * (1 + kGapRounding)) {
    proof.conclude(Status::kBracket, "a better posture could not be verified");
  }
  return proof;
}

Proof certify(const Problem& task, const Options& options, const ProofOptions& how) {
  if (!how.keep_certificate) return certify(task, options, how, nullptr);
  if (task.contact_columns() > 0) {
    throw std::invalid_argument(
        "keep_certificate: got a task with forces of a second contact, expected one without");
  }
  ProofRecorder recorder;
  Proof proof = certify(task, options, how, &recorder);
  if (proof.answer.has_value() && std::isfinite(proof.bound)) {
    proof.certificate = certificate_text(recorder.certificate(proof.answer, proof.bound, how.gap));
  }
  return proof;
}

double VerifiedProof::gap() const { return relative_gap(bound, value); }

VerifiedProof verify_certificate(const std::filesystem::path& file,
                                 const std::function<Problem(const std::string& name)>& load,
                                 int threads) {
  const auto start = std::chrono::steady_clock::now();
  const ProofCertificate claim = read_certificate(file.string());
  Problem task = load(claim.problem);
  if (!claim.collision) task.robot.collision = nullptr;
  VerifiedProof proof;
  static_cast<Verification&>(proof) = verify(task, claim, thread_count(threads));
  proof.version = claim.version;
  proof.problem = task.name;
  proof.measure = claim.measure;
  proof.wrench = claim.wrench;
  proof.collision = claim.collision;
  proof.unit = task.unit();
  // The coordinates of the certificate's posture begin with theta_r. They may be too few.
  proof.theta_r = claim.x.head(std::min(claim.x.size(), task.theta_r_min.size()));
  proof.value = claim.value;
  proof.bound = claim.bound;
  proof.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return proof;
}

}  // namespace maxwrench
