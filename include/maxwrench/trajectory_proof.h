#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <string>

#include "maxwrench/solve.h"
#include "maxwrench/verification.h"

/// @file
/// Proves what a trajectory exerts at every instant of time, and checks such proofs.

namespace maxwrench {

/// The options of `certify_trajectory`.
struct TrajectoryProofOptions {
  /// The number of parts into which each interval between knots is cut at first. There are more
  /// of them while the proof loses more than a share of 1e-4. 0: 25 along a path, 50 in an impulse.
  int parts = 0;
  bool keep_certificate = false;  ///< whether to write `TrajectoryProof::certificate`
};

/// A proof that a trajectory exerts a wrench at every instant. The status is
///
/// * kProven: `guaranteed` holds;
/// * kInvalidPosture: at `t` theta_r or its rate violates a limit, or two bodies collide;
/// * kInfeasible: at `t` no efforts within the limits balance the motion;
/// * kNumericalError: no efforts were found that a proof could enclose.
///
/// The reason says more.
struct TrajectoryProof : Verdict {
  Answer answer;  ///< the trajectory, evaluated at its instants and between knots
  /// The largest wrench along c that is proven [unit of the answer]. Along a path it is exerted at
  /// every instant, in an impulse at its peak. NaN: none.
  double guaranteed = std::numeric_limits<double>::quiet_NaN();
  double t = std::numeric_limits<double>::quiet_NaN();  ///< where the proof fails [s]; NaN: nowhere
  /// Of a list of scenarios: the one with the least proven factor, or the one without a proof.
  std::string decides;
  int scenarios = 0;             ///< number of proven scenarios of a list; 0: there is no list
  int parts = 0;                 ///< number of parts between knots: pieces of the efforts' splines
  long slices = 0;               ///< number of slices of time on which the efforts were enclosed
  double clearance = kInfinity;  ///< no bodies are closer than their margin plus this [m]
  double seconds = 0;            ///< wall time, without that of `answer` [s]
  std::string certificate;  ///< the contents of a certificate file. Empty unless it was requested
  /// Of `solve_proven`: value between knots of what the first search found, if another trajectory
  /// is the proven one [unit of the answer]; NaN: it is the proven one.
  double searched = std::numeric_limits<double>::quiet_NaN();
  std::string rejection;  ///< why the trajectory of `searched` is not proven
  /// Of `solve_proven`: the trajectory is the default posture, held: more is proven of no other.
  bool held = false;
};

/// Proves that a trajectory exerts a wrench at every instant, not only at samples.
///
/// Of a list of scenarios each is proven as a task of its own, and `guaranteed` is the least of
/// their factors.
///
/// The motion is the clamped cubic spline through the knots, whatever the scheme of the task. The
/// proof holds for all t: limits of efforts, of their rates, of commands where thrusters lag, of
/// theta_r and of its rates, and no collision. docs/algorithms/trajectory_proofs.md describes it.
///
/// @param task     a trajectory or an impulse of one contact, whose base's pose has a closed form
/// @param knots    its knots (k×r)
/// @param options  `threads` and `check_collision` count; the measure is linf_polytope and the
///                 wrench pure
/// @param how      number of parts, certificate
/// @throws std::invalid_argument, with one line, if the task is not supported, or as `evaluate`.
TrajectoryProof certify_trajectory(const Problem& task, const Eigen::MatrixXd& knots,
                                   const Options& options = {},
                                   const TrajectoryProofOptions& how = {});

/// Searches for the best trajectory that can be proven.
///
/// The best trajectory of `solve` may exceed a limit between its instants, or need efforts that
/// change faster there than their rates allow. The search then continues from it with tighter
/// limits and more instants; `searched` and `rejection` tell of the first. If more is proven of the
/// default posture, held throughout, the proof is that of this trajectory, and `held` is true.
///
/// @return the proof; its answer counts the evaluations and the time of all searches
TrajectoryProof solve_proven(const Problem& task, const Options& options = {},
                             const TrajectoryProofOptions& how = {});

/// A certificate of a trajectory and the result of its check. The claims count only if it is
/// verified.
struct VerifiedTrajectory : TrajectoryVerification {
  std::string version;        ///< the version of maxwrench that wrote the certificate
  std::string problem;        ///< the name of the task
  bool collision = true;      ///< whether bodies are kept apart
  std::string unit;           ///< unit of the value
  Eigen::MatrixXd knots;      ///< the knots (k×r)
  double guaranteed = 0;      ///< the wrench along c that is exerted, in an impulse at its peak
  std::string decides;        ///< of a list, the scenario with the least factor
  std::size_t scenarios = 0;  ///< number of scenarios of a list; 0: there is no list
  int t_h = 0;                ///< the knot of the peak of an impulse; 0: a path
  int parts = 0;              ///< as `TrajectoryProof::parts`
  double seconds = 0;         ///< wall time of reading and checking [s]
};

/// Returns whether a file is a certificate of a trajectory.
bool is_trajectory_certificate(const std::filesystem::path& file);

/// Checks a certificate of a trajectory.
///
/// The check shares nothing with the search for the efforts, nor with the model that evaluates
/// trajectories. `certify_trajectory` calls it as well: what it proves is what this accepts.
///
/// The arguments and exceptions are those of `verify_certificate`.
VerifiedTrajectory verify_trajectory_certificate(
    const std::filesystem::path& file, const std::function<Problem(const std::string& name)>& load,
    int threads = 0);

}  // namespace maxwrench
