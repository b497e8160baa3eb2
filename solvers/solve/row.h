#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "solvers/solve/case.h"
#include "solvers/solve/searched.h"
#include "maxwrench/measure.h"
#include "maxwrench/posture.h"

namespace maxwrench {

/// A row counts as solved only if its recomputed residual is below this, relative to 1 + |beta|:
/// what the least exact solver (an interior point) reaches with room to spare.
inline constexpr double kRowTolerance = 1e-6;

/// The outcome of a case: the answer at one posture, re-checked from the problem's data.
struct Row : Verdict {
  Case choice;
  const char* unit = "";  ///< of beta
  Posture posture;
  Capability capability;
  Eigen::VectorXd gradient;  ///< d beta/d theta_r
  /// What any efforts reach at the posture with the same wrenches, in the unit of the wrench along
  /// c: beta of linf_polytope, which makes postures of different measures comparable. NaN if there
  /// is none.
  double yardstick = std::numeric_limits<double>::quiet_NaN();
  long evaluations = 0;
  std::vector<CallCount> calls;  ///< of the methods of the search
  /// Of the evaluations, those whose lower level ended without a verdict; not counted by searches
  /// of plans.
  long undecided = 0;
  BranchCounts branches;  ///< in sum over the evaluations; not counted by searches of plans
  double wall_s = 0;      ///< without the yardstick

  bool has_posture() const { return posture.J.size() > 0; }
  /// A value of the posture, which an interrupted search (kBudgetExhausted) may have too.
  bool has_value() const { return counts(status, capability.status); }
};

/// Evaluates a method at theta_r.
Row evaluate(const Problem& problem, const Method& method, const Eigen::VectorXd& theta_r,
             bool check_collision = true);

/// Searches the best posture and evaluates it anew: kBestFound, for only the lower level is
/// optimal. Same result at any thread count. If it was interrupted, the best so far with status
/// kBudgetExhausted.
Row solve(const Problem& problem, const Method& method, int threads,
          const std::function<void(long)>& progress = {}, Interruption* interruption = nullptr);

/// One line of CSV, and the header. The case comes first, then values; times are not values and
/// stand in a table of their own.
std::vector<std::string> value_columns();
std::vector<std::string> values(const Problem& problem, const Row& row);
std::vector<std::string> time_columns();
std::vector<std::string> times(const Case& c, long evaluations, double wall_s);

/// Numbers with all their digits, separated by blanks.
std::string exact_text(double value);
std::string exact_text(const Eigen::VectorXd& v);

}  // namespace maxwrench
