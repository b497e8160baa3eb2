#include "solvers/certify/proof.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "lib/math/random.h"
#include "lib/scenario/current_load.h"
#include "maxwrench/problem.h"
#include "solvers/certify/bound/loop_posture.h"
#include "solvers/certify/proof_recorder.h"
#include "solvers/solve/method.h"
#include "verify/certificate.h"
#include "verify/equations.h"
#include "verify/incumbent.h"
#include "verify/model.h"
#include "verify/verify.h"

namespace maxwrench {
namespace {

/// The gap of a proof is reached up to this share.
constexpr double kGapRounding = 1e-6;

/// The gap of a proof, which of a value of zero is infinite unless the bound is zero, too.
double relative_gap(double bound, double value) {
  return bound == value ? 0 : (bound - value) / std::abs(value);
}

/// The answer at another point of the same search, if it has a value; else it has none.
Answer answer_at(const Eigen::VectorXd& theta_r, const Options& options, const Answer& answer) {
  Answer other = evaluate(*answer.task, theta_r, options);
  if (!other.has_value()) return other;
  other.conclude(Status::kBestFound);
  other.choice = answer.choice;
  other.evaluations = answer.evaluations;
  other.calls = answer.calls;
  other.stopped = answer.stopped;
  other.undecided = answer.undecided;
  other.ik_solutions = answer.ik_solutions;
  other.wall_s = answer.wall_s;
  return other;
}

/// Replaces the answer of a search by that at a better point, if this one can be verified. It is
/// still what the search with the bounds found.
void take_better(const Eigen::VectorXd& theta_r, const Options& options, Answer& answer) {
  Answer better = answer_at(theta_r, options, answer);
  if (!better.has_value() || (answer.has_value() && better.beta() <= answer.beta())) return;
  answer = std::move(better);
}

/// Moves a posture that the check of a certificate would reject, such as one that touches itself:
/// the last digit may decide whether it collides. Tries points at random that are farther and
/// farther away, and keeps the first one that the check accepts.
void settle_posture(const Options& options, Answer& answer) {
  constexpr double kNear = 1e-13, kFar = 1e-7;  // [rad or m]
  constexpr int kTrials = 256;
  const Problem& problem = *answer.task;
  const FormModel model(problem, posture_coordinates(problem, claim_of(answer)));
  const Equations equations(problem, model);
  const auto accepted = [&](const Answer& one) {
    return reject_incumbent(problem, model, equations, claim_of(one)).empty();
  };
  if (accepted(answer)) return;
  Random random(options.seed);
  const Eigen::VectorXd centre = answer.posture.theta_r;
  for (int trial = 0; trial < kTrials; ++trial) {
    Eigen::VectorXd theta_r = centre;
    const double size = kNear * std::pow(kFar / kNear, static_cast<double>(trial) / kTrials);
    for (double& x : theta_r) x += size * random.uniform(-1, 1);
    theta_r = theta_r.cwiseMax(problem.theta_r_min).cwiseMin(problem.theta_r_max);
    Answer near = answer_at(theta_r, options, answer);
    if (!near.has_value() || !accepted(near)) continue;
    answer = std::move(near);
    return;
  }
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
  if (recorder && proof.answer.has_value()) settle_posture(c, proof.answer);
  return proof;
}

std::string why_no_certificate(const Problem& task, Wrench wrench) {
  if (task.contact_columns() > 0 && !task.scenarios.empty()) {
    return "a list with forces of a second contact";
  }
  if (wrench == Wrench::kAny && !task.scenarios.empty()) return "any wrenches of a list";
  const auto free_axes = static_cast<Eigen::Index>(task.robot.base_axes.size());
  if (wrench == Wrench::kAny && task.dependent.empty() && task.W_any.cols() != free_axes) {
    return "any wrenches that leave out some components";
  }
  return has_current(task.scenarios) ? "a task with currents" : "";
}

Proof certify(const Problem& task, const Options& options, const ProofOptions& how) {
  if (!how.keep_certificate) return certify(task, options, how, nullptr);
  if (const std::string got = why_no_certificate(task, options.wrench); !got.empty()) {
    throw std::invalid_argument("keep_certificate: got " + got + ", expected one without");
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
