#pragma once

#include <functional>
#include <vector>

#include "lib/trajectory/canonical_equations.h"
#include "solvers/pontryagin/extremal_flow.h"
#include "solvers/pontryagin/least_effort_motion.h"

namespace maxwrench {

/// A solution of the two-point boundary value problem: the states z, without nu, at the beginnings
/// of N intervals of the same duration, and the mass.
struct Extremal {
  std::vector<Eigen::VectorXd> nodes;  ///< N, of 4 n numbers
  double m = 0;                        ///< mass of the payload [kg]
  double nu = 0;                       ///< integral of y'g at the end; 1 where m is free
  TransferIndex index;                 ///< of which it is an extremal
};

/// Multiple shooting: Newton's method on
///
///     z_k+1 = Phi(z_k, m),   q, v at both ends,   and nu(T) = 1 or m as given,
///
/// where Phi is the flow over one interval (`ExtremalFlow`) with its derivatives.
class Shooting {
 public:
  /// The problem must outlive this object. `spend` is called before each evaluation of all
  /// intervals; false: none is left, and the method ends without a solution.
  ///
  /// @throws std::invalid_argument as `CanonicalEquations`.
  Shooting(const Problem& problem, std::function<bool()> spend);

  /// The costates that a motion needs, for a mass that stays (see
  /// `CanonicalEquations::costate_of`). There is an interval between each pair of its knots.
  Extremal guess(const SplineMotion& motion, double m);
  /// Newton's method from an extremal of another index or mass. Returns the number of its steps, or
  /// -1 if it does not converge; `extremal` is then unchanged.
  ///
  /// @param extremal   where to begin; receives the solution
  /// @param free_mass  whether nu(T) = 1 determines the mass
  /// @param most_steps  the most steps
  int solve(Extremal& extremal, bool free_mass, int most_steps);

  /// Whether nothing was left to spend.
  bool ended() const { return ended_; }
  /// The equations, with the index of an extremal.
  CanonicalEquations& equations(const Extremal& extremal);
  /// The states at `per_interval` equal steps of each interval, the last one at T.
  std::vector<Eigen::VectorXd> sample(const Extremal& extremal, int per_interval);
  double duration() const;  ///< T [s]

 private:
  bool evaluate(const Extremal& extremal, bool free_mass, bool with_slopes);
  double residual() const { return scaled_.lpNorm<Eigen::Infinity>(); }

  const Problem& problem_;
  std::function<bool()> spend_;
  CanonicalEquations equations_;
  ExtremalFlow flow_;
  double given_m_ = 0;
  double nu_ = 0;
  Eigen::VectorXd F_, scaled_;
  Eigen::MatrixXd J_, slopes_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  double share_ = 1;    ///< of the last step of Newton's method
  bool ended_ = false;  ///< nothing is left to spend
};

}  // namespace maxwrench
