#pragma once

#include <memory>
#include <string>
#include <vector>

#include "maxwrench/types.h"
#include "verify/form.h"

namespace maxwrench {

struct Problem;
class Equations;
class FormModel;

/// Bounds on the values of a measure over boxes of a posture's coordinates, from multipliers. Not
/// thread-safe: use one object for each thread.
class ValueProof {
 public:
  virtual ~ValueProof() = default;

  /// The number of entries of a multiplier; for a list of scenarios, of each part.
  virtual int width() const = 0;
  /// The number of further entries that all parts share.
  virtual int shared() const { return 0; }
  /// An upper bound of the value at every posture.
  virtual double ceiling() const = 0;
  /// If no value in the box exceeds `high`, no value exceeds max(low, the result). The result is at
  /// most `high`. The multiplier has `parts` parts.
  virtual double most(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                      const double* multiplier, std::size_t parts, double low, double high) = 0;
  virtual std::unique_ptr<ValueProof> clone() const = 0;
};

/// Keeps references to a problem, its model and its equations, which must outlive the object. With
/// W = c, t is a value only if f(x) = 0 and tau_d + t J'c is in the set that the actuators can
/// balance. Let s be the support of this set. Then for any [lambda; nu]
///
///     t <= U(lambda, nu) = s(lambda) + max over control points v, and t in {low, high}, of
///                          t (1 - lambda'a_v) - lambda'tau_v - nu'f_v,
///
/// because the values of (tau_d, J'c, f) lie in the convex hull of their control points. With
/// equations, where low and high may be infinite, also
///
///     t <= max over v of (s(lambda) - lambda'tau_v - nu'f_v)/lambda'a_v
///
/// if lambda'a_v > 0 at all v. With shares of the forces of a second contact, `ContactLimits`,
/// tau_d and J'c include these forces. Throws std::invalid_argument, in one line, for measures that
/// it does not support.
std::unique_ptr<ValueProof> make_pure_proof(const Problem& problem, const FormModel& model,
                                            const Equations& equations, const std::string& measure);

/// For the L-infinity polytope and a second contact whose force F follows from the base. With the
/// levers A and the thrusters' forces u on the base, F = B_f u - tau_f - t a_f, where f are the
/// base's linear rows. The balance of the other rows is B u_joints = tau - A tau_f + t (a - A a_f)
/// + K u, K = A B_f - B. So for any lambda, with the support s of the joints' efforts, and any nu
///
///     t <= s(lambda) + max over control points v, t in {low, high} and u within limits of
///          t (1 - lambda'a_v) - lambda'tau_v - lambda'K_v u - nu'f_v,
///
/// where tau and a are those of the balance; and the bound with lambda'a_v > 0 as above. The
/// entries of lambda of the linear rows do not matter. If c has no force, |t c| is at most the
/// torque of the loads and thrusters in the base's angular rows.
std::unique_ptr<ValueProof> make_braced_proof(const Problem& problem, const FormModel& model,
                                              const Equations& equations);

/// The rows tau and a of this balance, n; those of the base's linear axes are zero.
struct BracedRows {
  std::vector<Form> tau, a;
  std::vector<FormVector> levers;
};
BracedRows braced_rows(const FormModel& model, const Vector6d& c);

/// For any wrench and the L-infinity polytope. The forces on the base determine the value: with y
/// and K of `FormModel` and the thrusters' forces u, beta = o_0 + y'B_b u, and joints exert tau_0 +
/// K B_b u. So for any mu
///
///     beta <= U(mu) = sum_j max over limits of mu_j e_j + max over control points v of
///                     o_0 - mu'tau_0 + sum_k max over limits of u_k (B_b'(y - K'mu))_k.
std::unique_ptr<ValueProof> make_any_proof(const Problem& problem, const FormModel& model);

/// For a list of scenarios, pure wrenches and the L-infinity polytope. A value t satisfies tau_s +
/// t a_s in {B u} within the limits of s, up to the tolerance of ends, for every scenario s. So any
/// lambda_s of some of them add up to a bound of the kind of the first one. A part of a multiplier
/// is [wrench, limits, case of each load, z of the ball, lambda_s]; they share nu.
std::unique_ptr<ValueProof> make_list_proof(const Problem& problem, const FormModel& model,
                                            const Equations& equations);

/// For any wrenches with dependent joints and the L-infinity polytope. Let h be the wrench's
/// components across c, A = J'W those of J' along them, and h = M u - p + rho, |rho| <= R, the law
/// of `FreeWrenchLimits` over a box. For any lambda and nu
///
///     t <= max over control points v, t in {low, high}, u within limits and |rho| <= R of
///          t (1 - lambda'a_v) + lambda'B u - lambda'tau_v - nu'f_v
///             - lambda'A_v (M u - p + rho).
///
/// The entries of a multiplier are [lambda; nu; the lambda of the law]. Throws
/// std::invalid_argument, in one line, for efforts without limits.
std::unique_ptr<ValueProof> make_free_proof(const Problem& problem, const FormModel& model,
                                            const Equations& equations);

/// One of those above, as the measure and the wrench require.
std::unique_ptr<ValueProof> make_value_proof(const Problem& problem, const FormModel& model,
                                             const Equations& equations, const std::string& measure,
                                             Wrench wrench);

}  // namespace maxwrench
