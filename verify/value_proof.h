#pragma once

#include <memory>
#include <string>

#include "maxwrench/problem.h"
#include "verify/box_forms.h"
#include "verify/model.h"

namespace maxwrench {

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

/// Of a problem and its model, which outlive it. With W = c, t is a value only if tau_d + t J'c is
/// in the set of what actuators balance, whose support is s. So for any lambda
///
///     t <= U(lambda) = s(lambda) + max over control points v, and t in {low, high}, of
///                      t (1 - lambda'a_v) - lambda'tau_v,
///
/// as the values (tau_d, J'c) lie in the hull of control points. Throws std::invalid_argument, in
/// one line, for measures that it does not know.
std::unique_ptr<ValueProof> make_pure_proof(const Problem& problem, const FormModel& model,
                                            const std::string& measure);

/// Any wrench, L-infinity polytope: the base's forces give it. With y and K of `FormModel`, and u
/// the thrusters' forces, beta = o_0 + y'B_b u, and joints exert tau_0 + K B_b u. So for any mu
///
///     beta <= U(mu) = sum_j max over limits of mu_j e_j + max over control points v of
///                     o_0 - mu'tau_0 + sum_k max over limits of u_k (B_b'(y - K'mu))_k.
std::unique_ptr<ValueProof> make_any_proof(const Problem& problem, const FormModel& model);

/// Either of them.
std::unique_ptr<ValueProof> make_value_proof(const Problem& problem, const FormModel& model,
                                             const std::string& measure, Wrench wrench);

}  // namespace maxwrench
