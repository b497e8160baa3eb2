#pragma once

#include <vector>

#include "maxwrench/problem.h"
#include "verify/equations.h"
#include "verify/model.h"
#include "verify/value_proof.h"
#include "verify/weighted.h"

namespace maxwrench {

std::vector<FormRow> to_rows(const std::vector<Form>& forms, const std::vector<double>& far);

/// t <= (sum_k max |u_k| |B_k| + |tau_d|) / |J'c|, on the base's free axes, linear ones for a force
/// and angular ones for a torque. There |J'c| is at least |c|, reduced by the share that rotations
/// with rounded entries may take and by the part along axes that are not free. For a base whose
/// pose has a closed form; other axes may bear the wrench of others. Throws std::invalid_argument,
/// in one line, for a c that these axes do not limit.
double pure_ceiling(const Problem& problem, const FormModel& model, const Vector6d& c,
                    const Zonotope& set, const std::vector<Form>& tau);

/// The common part of the proofs of pure wrenches: with g_v and h_v at the control points v,
///
///     t <= s + max over v and t in {low, high} of t (1 - h_v) - g_v - nu'f_v,
///     t <= max over v of (s - g_v - nu'f_v)/h_v  if h_v > 0 at all v.
class ProofOverBox : public ValueProof {
 public:
  ProofOverBox(const FormModel& model, const Equations& equations)
      : model_(model), equations_(equations), box_(model.shape()), off_postures_(equations) {}

  double most(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, const double* multiplier,
              std::size_t parts, double low, double high) override;

 protected:
  /// Adds the coefficients of g and h to zeros, and returns an upper bound of s.
  virtual double combine(const double* multiplier, std::size_t parts, std::vector<Narrow>& g,
                         std::vector<Narrow>& h) = 0;
  /// Adds what is no form in all coordinates to g at the control points of the same box. False if
  /// it cannot be enclosed.
  virtual bool add_at_points(const Eigen::VectorXd& /*lower*/, const Eigen::VectorXd& /*upper*/,
                             const double* /*multiplier*/, std::vector<Narrow>& /*g*/) {
    return true;
  }
  /// The entries of nu.
  virtual const double* nu(const double* multiplier, std::size_t parts) const = 0;

  const FormModel& model_;
  const Equations& equations_;

 private:
  double by_ends(double support, double low, double high) const;
  double by_ratio(double support) const;

  BoxForms box_;
  EquationsOverBox off_postures_;
  std::vector<Narrow> tau_, a_;
};

}  // namespace maxwrench
