#pragma once

#include <memory>
#include <string>

#include "maxwrench/types.h"

namespace maxwrench {

struct Problem;
class Equations;
class FormModel;

/// What multipliers prove of the values of a measure over boxes of theta_r. One object serves one
/// thread.
class ValueProof {
 public:
  virtual ~ValueProof() = default;

  /// Numbers of a multiplier.
  virtual int width() const = 0;
  /// No value is larger, in any posture.
  virtual double ceiling() const = 0;
  /// If no value in the box exceeds `high`, none exceeds max(low, what is returned), which is at
  /// most `high`.
  virtual double most(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                      const double* multiplier, double low, double high) = 0;
  virtual std::unique_ptr<ValueProof> clone() const = 0;
};

/// Of a problem, its model and its equations, which outlive it. With W = c, t is a value only if
/// tau_d + t J'c is in the set of what actuators balance, whose support is s, and f(x) = 0. So for
/// any [lambda; nu]
///
///     t <= U(lambda, nu) = s(lambda) + max over control points v, and t in {low, high}, of
///                          t (1 - lambda'a_v) - lambda'tau_v - nu'f_v,
///
/// as the values (tau_d, J'c, f) lie in the hull of control points; and with equations, where the
/// ends may be infinite, if lambda'a_v > 0 at all of them, t <= max over v of (s(lambda) -
/// lambda'tau_v - nu'f_v)/lambda'a_v. Throws std::invalid_argument, in one line, for measures that
/// it does not know.
std::unique_ptr<ValueProof> make_pure_proof(const Problem& problem, const FormModel& model,
                                            const Equations& equations, const std::string& measure);

/// Any wrench, L-infinity polytope: the base's forces give it. With y and K of `FormModel`, and u
/// the thrusters' forces, beta = o_0 + y'B_b u, and joints exert tau_0 + K B_b u. So for any mu
///
///     beta <= U(mu) = sum_j max over limits of mu_j e_j + max over control points v of
///                     o_0 - mu'tau_0 + sum_k max over limits of u_k (B_b'(y - K'mu))_k.
std::unique_ptr<ValueProof> make_any_proof(const Problem& problem, const FormModel& model);

/// Either of them.
std::unique_ptr<ValueProof> make_value_proof(const Problem& problem, const FormModel& model,
                                             const Equations& equations, const std::string& measure,
                                             Wrench wrench);

}  // namespace maxwrench
