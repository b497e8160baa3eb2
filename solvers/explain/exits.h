#pragma once

#include <vector>

#include "maxwrench/explain.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {

/// How beta changes with one limit: see `BindingLimit`.
struct LimitRange {
  double rate_up = 0, rate_down = 0, up = kInfinity, down = kInfinity;
};

/// Where the ray tau_d + a x of a wrench program with one column leaves the facets of {B u}.
///
/// A side n'tau <= b of a facet pair with n'a > 0 is left at x = (b - n'tau_d)/(n'a), one with n'a
/// < 0 is entered there. A limit of u_i moves b by max(n'B_i, 0) per u_max,i and by min(n'B_i, 0)
/// per u_min,i. So x moves linearly with each limit, beta is the least exit, and the posture stays
/// feasible while no entry exceeds it and n'tau_d <= b on the sides with n'a = 0.
class Exits {
 public:
  /// The program, with facets and one column, must outlive this object.
  explicit Exits(const WrenchProgram& program);
  /// How the least exit changes with a limit of u_i.
  LimitRange range(Eigen::Index i, LimitSide limit) const;

 private:
  struct Side {
    Eigen::Index pair;
    double sign;   ///< n = sign N_pair
    double slope;  ///< n'a; 1 where it is zero
    double x;      ///< exit or entry; the slack b - n'tau_d where n'a is zero
  };
  double moves(const Side& side, Eigen::Index i, LimitSide limit) const;

  const Zonotope& set_;
  Eigen::MatrixXd NtB_;  ///< without rounding
  double beta_ = kInfinity;
  std::vector<Side> exits_, entries_, parallel_;
};

}  // namespace maxwrench
