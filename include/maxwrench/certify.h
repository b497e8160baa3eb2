#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "maxwrench/solve.h"
#include "maxwrench/verification.h"

/// @file
/// Proves the largest capability of a task, and checks such proofs.

namespace maxwrench {

/// The options of `certify`.
struct ProofOptions {
  double gap = 1e-3;              ///< the proof ends if bound - value <= gap |value|; at least 1e-8
  double seconds = 60;            ///< time limit of the proof, which begins after the search [s]
  bool keep_certificate = false;  ///< whether to write `Proof::certificate`
  /// Called from time to time with the bound and the best value so far.
  std::function<void(double bound, double value)> progress = {};
};

/// A proof of the largest capability of a static task. The status is
///
/// * kProven: the gap is at most the requested one, or no posture has a value;
/// * kBracket: the bound holds, but the gap is larger; the reason says which limit was reached;
/// * that of `answer` if the best posture could not be verified.
struct Proof : Verdict {
  Answer answer;             ///< the best posture known, evaluated again
  double bound = kInfinity;  ///< no posture within the limits has a larger value; infinite: none
  std::string search;        ///< the search that was used
  long boxes = 0;            ///< number of boxes of theta_r that were bounded
  long colliding = 0;        ///< number of these in which every posture collides
  double search_s = 0;       ///< wall time of the search [s]
  double seconds = 0;        ///< wall time of the proof after the search [s]
  /// The contents of a certificate file, which may be binary. Empty unless it was requested, and if
  /// there is no value or no bound.
  std::string certificate;

  /// Returns (bound - value)/|value|; infinite without a value or a bound.
  double gap() const;
};

/// Returns what keeps a task from having a certificate: forces of a second contact of a list,
/// currents, any wrenches of a list, or any wrenches that leave out free axes of a base whose pose
/// follows in closed form. Empty if nothing does.
std::string why_no_certificate(const Problem& task, Wrench wrench = Wrench::kPure);

/// Searches for the best posture, and proves by branch and bound over all of theta_r how much
/// larger a value can be.
///
/// Collisions are always avoided; `Options::check_collision` has no effect. To allow collisions,
/// set `Robot::collision` to null. `Options::interrupted` ends first the search, then the proof.
///
/// @param task     a static task that `make_capability_bound` supports
/// @param options  measure, wrench, search, threads and others, as for `solve`; the default of the
///                 budget is `kUsualBudget`
/// @param how      gap, time limit and certificate
/// @return the proof; without time or interruptions the same at any number of threads
/// @throws std::invalid_argument as `solve` and `make_capability_bound`; also for a gap or seconds
///         out of range, and for a certificate of a task that has none, `why_no_certificate`.
Proof certify(const Problem& task, const Options& options = {}, const ProofOptions& how = {});

/// A certificate and the result of its check. The claims count only if it is verified.
struct VerifiedProof : Verification {
  std::string version;            ///< the version of maxwrench that wrote the certificate
  std::string problem;            ///< the name of the task
  std::string measure;            ///< the measure
  Wrench wrench = Wrench::kPure;  ///< the allowed wrenches
  bool collision = true;          ///< whether postures that collide do not count
  std::string unit;               ///< unit of value and bound
  Eigen::VectorXd theta_r;        ///< the posture
  double value = 0;               ///< its value
  double bound = 0;               ///< no posture has a larger value
  double seconds = 0;             ///< wall time of reading and checking [s]

  /// Returns (bound - value)/|value|.
  double gap() const;
};

/// Checks a certificate file with code that is independent of the code that wrote it.
///
/// Every bound is evaluated anew in interval arithmetic from the data of the task.
///
/// @param file     the file, with the contents `Proof::certificate`
/// @param load     returns the task; it gets the name that the certificate gives. `load_problem`
///                 reads it from its files
/// @param threads  as `Options::threads`
/// @throws std::invalid_argument, with one line, if the file cannot be read, is damaged or is no
///         certificate, if the check does not support the task, or as `load`.
VerifiedProof verify_certificate(const std::filesystem::path& file,
                                 const std::function<Problem(const std::string& name)>& load,
                                 int threads = 0);

}  // namespace maxwrench
