#pragma once

#include <limits>
#include <string>
#include <vector>

#include "maxwrench/solve.h"

/// @file
/// Trade-offs between tasks of one robot at one pose.

namespace maxwrench {

/// One of several tasks of a posture, and how it is measured.
struct Goal {
  Problem task;                          ///< a static task
  std::string measure = Case().measure;  ///< its measure
  Wrench wrench = Wrench::kPure;         ///< its allowed wrenches
  std::string solver = "";               ///< its solver, as `Case::solver`
};

/// A posture that was found for some weights.
struct FrontPoint {
  double phi = 0;           ///< the angle of the weights [rad]; NaN for more than two tasks
  Eigen::VectorXd weights;  ///< w, a number for each task [its unit]
  Eigen::VectorXd theta_r,  ///< the posture (r)
      beta;                 ///< the value of each task there [its unit]
  double t = 0;             ///< min beta_k / w_k over the tasks with w_k > 0
  /// No posture has a larger t, so none has beta_k > bound w_k for all k. Infinite: not known.
  double bound = std::numeric_limits<double>::infinity();
};

/// The front of two tasks, or one posture for several.
///
/// The status is kBestFound, kNoneFound if a task has no positive value, or kBudgetExhausted if it
/// was interrupted.
struct Front : Verdict {
  std::vector<Answer> own;  ///< each task alone: its best posture
  /// Of two tasks: the points of the front from the best one of the first task to that of the
  /// second. None of them is dominated: no other is better in one task and not worse in the other.
  std::vector<FrontPoint> points;
  /// The posture with the largest worst share of each task's own best value; its t is this share.
  FrontPoint compromise;
  long dominated = 0;    ///< number of points that were left out
  long evaluations = 0;  ///< number of evaluations of all searches
  double wall_s = 0;     ///< wall time [s]
};

/// The largest number of weights of a front.
inline constexpr int kMostFrontPoints = 1000;

/// The options of `pareto`.
struct FrontPlan {
  int points = 9;      ///< number of weights of two tasks, at least 2; 0: only the compromise
  bool bound = false;  ///< whether `certify` proves a bound for each weight
  double gap = 1e-3,   ///< the gap that ends such a proof, as `ProofOptions::gap`
      seconds = 60;    ///< the time that ends it, as `ProofOptions::seconds`
};

/// Computes what one posture gives to several tasks of one robot at one pose.
///
/// For the weights w = (beta_1* cos phi, beta_2* sin phi), with the own best values beta* and phi
/// evenly from 0 to 90 degrees, it maximises
///
///     t = min_k beta_k(theta_r) / w_k
///
/// over theta_r. Unlike a weighted sum this reaches the dents of a front. Each search begins at the
/// best postures of the tasks, and again at the postures of all other weights. Lower ends of the
/// intervals of a task count in that task alone.
///
/// @param goals    two or more static tasks with the same robot, end effector, pose and theta_r
/// @param plan     the number of points, and proofs
/// @param options  search, seed, budget and others, of each weight; the default search is
///                 `general_search`. Measure, wrench and solver are those of the goals
/// @return the front; the same at any number of threads
/// @throws std::invalid_argument if the tasks do not suit each other, for a proof of other values
///         than `linf_polytope` with pure wrenches of one contact, or as `solve`
Front pareto(const std::vector<Goal>& goals, const FrontPlan& plan = {},
             const Options& options = {});

/// Returns the front as text of several lines.
std::string summary(const Front& front);

/// Returns the front as a JSON object on one line.
std::string to_json(const Front& front);

/// Returns the points, and the compromise as the last row, as CSV.
std::string front_csv(const Front& front);

}  // namespace maxwrench
