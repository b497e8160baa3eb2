#pragma once

#include <limits>
#include <string>
#include <vector>

#include "maxwrench/types.h"

/// @file
/// What binds: the limits that determine a value, and what more of each would give.

namespace maxwrench {

struct Answer;

/// Which limit of a quantity binds.
enum class LimitSide {
  kLower,   ///< the lower limit
  kUpper,   ///< the upper limit
  kSmaller  ///< the smaller of both absolute limits, as in W_u of the ellipsoid
};
/// Returns the name of a side in files: "min", "max" or "smaller".
const char* to_string(LimitSide side);

/// A limit with its multiplier.
struct LimitRate {
  std::string
      name;  ///< the actuator, coordinate of theta_r, pair of bodies or force of the contact
  std::string unit;                    ///< unit of the limit: "N", "N m", "m" or "rad"
  LimitSide side = LimitSide::kUpper;  ///< which limit of it
  double limit = 0;                    ///< the limit [unit]
  /// d value/d limit [N or N m of the value, per unit of the limit]: at least zero at an upper
  /// limit, at most zero at a lower one.
  double rate = 0;
};

/// A limit that binds at a posture. A number that is not known is NaN.
struct BindingLimit : LimitRate {
  double share = 0;  ///< rate * limit: the limit's part of the value [N or N m]
  /// By how much the value grows if this limit alone moves outward by 10 % of its magnitude [N or
  /// N m]: the program is solved again. For the ellipsoid it is 0.1 `share`.
  double gain = std::numeric_limits<double>::quiet_NaN();
  /// The derivative for a rising limit. It differs from `rate_down` only at a kink, where several
  /// facets of {B u} are active; `rate` lies between both. With several wrench columns both come
  /// from solving again with the limit moved by 1e-4 of its magnitude.
  double rate_up = std::numeric_limits<double>::quiet_NaN();
  double rate_down = std::numeric_limits<double>::quiet_NaN();  ///< the same for a falling limit
  /// By how much the limit may rise while the value changes at `rate_up` [unit]: until other limits
  /// take over, both limits of the actuator meet, or no efforts balance the posture.
  double up = std::numeric_limits<double>::quiet_NaN();
  double down = std::numeric_limits<double>::quiet_NaN();  ///< the same for a falling limit
};

/// The value as a sum [N or N m]:
///
///     beta = sum of all `BindingLimit::share` + weight + buoyancy + trim + other + error
///
/// The four loads are the parts of lambda'tau_d.
struct ValueBudget {
  double weight = 0,  ///< of all links
      buoyancy = 0,   ///< of all links
      trim = 0,       ///< floats and ballast
      other = 0,      ///< the rest of tau_d: drag, inertia and uncertain loads
      error = 0;      ///< what is missing; zero up to rounding
};

/// What a limit is worth at a best posture if the posture may change with it.
struct BestPostureRates {
  /// Why there are no rates; empty: there are.
  std::string missing;
  /// All limits with a multiplier: of efforts, theta_r, dependent joints, clearances and forces of
  /// the contact. The greatest effect of a relative change comes first.
  std::vector<LimitRate> limits;
  /// The largest entry of c - sum_j mu_j grad g_j, see `explain` [1; N or N m per rad or m].
  double residual = std::numeric_limits<double>::quiet_NaN();
  /// Whether the multipliers are the only ones. If not, the rates are some of several one-sided
  /// ones.
  bool unique = true;
};

/// The efforts of least |W_u u| that hold a share of the wrench.
struct LeastEfforts {
  std::string missing;  ///< why there are none; empty: there are
  double share = 1;     ///< the share of the answer's wrench that they hold
  Eigen::VectorXd u;    ///< efforts (m) [N or N m]
  double norm = 0;      ///< |W_u u|
  double vertex_norm =
      std::numeric_limits<double>::quiet_NaN();  ///< |W_u u| of the answer's efforts
  double balance = 0;                            ///< max |B u - tau_d - share J'h| [N, N m]
  /// u'W_u^2 u less the least u'W_u^2 v over all efforts v within the limits with B v = B u: zero
  /// at the optimum.
  double gap = 0;
};

/// The limits that bind at an instant of a task in time.
struct InstantLimits {
  double t = 0;                   ///< time [s]
  std::vector<LimitRate> limits;  ///< limits with a multiplier, largest effect first
  std::string scenario = {};      ///< of a list of scenarios: the one that they belong to
};

/// What binds at an answer.
struct Explanation {
  std::string unit;                                        ///< unit of the value
  double beta = std::numeric_limits<double>::quiet_NaN();  ///< the value
  /// Of a list of scenarios, the one that decides; empty: the task has no list.
  std::string scenario;
  /// Why the binding limits are not known; empty: they are.
  std::string missing;
  /// The limits that bind, those with the largest gain first.
  std::vector<BindingLimit> limits;
  std::string ranges_missing;  ///< why up and down are not known; empty: they are
  bool kink = false;           ///< whether rates for rising and falling limits differ
  ValueBudget budget;          ///< the value as a sum
  BestPostureRates best;       ///< rates with the posture optimised again
  LeastEfforts efforts;        ///< the least efforts beside the answer's, which are a vertex
  std::vector<InstantLimits> instants;  ///< of a task in time; `limits` is then empty
};

/// The options of `explain`.
struct ExplainOptions {
  double share = 1;  ///< the share of the wrench that the least efforts hold, from 0 to 1
};

/// Says which limits determine a value.
///
/// **At the posture.** With lambda of the optimum and d = -B'lambda (m), actuator i is at its upper
/// limit if d_i > 0 and d beta/d u_max,i = d_i; it is at its lower limit if d_i < 0 and d beta/d
/// u_min,i = d_i; if d_i = 0, neither binds. The limits of the second contact's forces bind with
/// s = c_w + (J'W)'lambda in the same way. beta is the sum
///
///     beta = sum_i d_i u_limit,i + sum_j s_j w_limit,j + lambda'tau_d.
///
/// The L2 polytope is the same program with (I, J(B^+)', B^+ tau_d) in place of (B, J, tau_d). For
/// the ellipsoid and the weighted transmission ratio, with e = W_u u and limits s_i = 1/W_u,ii,
///
///     d beta/d s_i = (beta - lambda'tau_d) e_i^2/s_i.
///
/// **Range**, for one wrench column: the ray tau_d + a x leaves facet k of {B u} at x_k = (b_k -
/// n_k'tau_d)/(n_k'a), which moves by max(n_k'B_i, 0)/(n_k'a) per u_max,i and min(n_k'B_i,
/// 0)/(n_k'a) per u_min,i. beta = min x_k is concave in each limit: of several active facets the
/// least rate holds for a rising limit and the largest for a falling one.
///
/// **At a best posture** with the rows g_j <= 0 of facets, limits and clearances that are active
/// there, the multipliers mu >= 0 of least residual in c = sum_j mu_j grad g_j over (theta_r, w)
/// give d beta*/d limit = -sum_j mu_j d g_j/d limit. They are reported if the residual is below
/// 1e-6 (1 + |beta|). They belong to this local optimum: a mirror image of the same value has rates
/// of its own.
///
/// **Least efforts**: min |W_u u|^2 subject to B u = tau_d + share J'h within the limits. W_u,ii is
/// one over the smaller of both absolute limits; if that is 0, over the larger one; if it is
/// infinite or both are 0, it is 1.
///
/// **Task in time**: for each instant, the limits with their multipliers at this instant alone.
///
/// **List of scenarios**: all of this for the scenario that decides, with its limits, wrench and
/// loads. A `gain` is that of this scenario, so another one may allow less of it. The rates at a
/// best posture are those of the whole list, for pure wrenches; a limit counts in the scenarios in
/// which its actuator is not lost.
///
/// What does not exist for the answer's measure, wrench or task says so in its `missing`.
///
/// @param answer   the answer of `evaluate`, `evaluate_posture` or `solve`
/// @param options  the share of the least efforts
/// @return the explanation; each number is checked against the data of the task
/// @throws std::invalid_argument if the answer has no task, or the share is not from 0 to 1.
Explanation explain(const Answer& answer, const ExplainOptions& options = {});

/// Returns the explanation as text of several lines: words first, then numbers.
std::string summary(const Explanation& explanation);

/// Returns the explanation as a JSON object on one line. A number or part that is missing is null.
std::string to_json(const Explanation& explanation);

/// Returns the JSON object of the answer with the explanation under the key `explanation`.
std::string to_json(const Answer& answer, const Explanation& explanation);

}  // namespace maxwrench
