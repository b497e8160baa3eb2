#pragma once

#include <Eigen/Dense>
#include <vector>

namespace maxwrench {

/// The request to the actuators at one instant.
struct EffortRequest {
  Eigen::MatrixXd B;             ///< n×m: maps efforts to control effort
  Eigen::VectorXd tau_c;         ///< n [N, N m], the control effort
  Eigen::VectorXd u_star;        ///< m, the preferred efforts
  Eigen::VectorXd lower, upper;  ///< m, limits of u or of its rate, whichever are tighter
};

struct EffortAnswer {
  Eigen::VectorXd u;       ///< m, always within the bounds
  double shortfall = 0;    ///< max |B u - tau_c| [N, N m]; zero up to rounding unless relaxed
  bool saturated = false;  ///< at least one effort is at a bound; one that is fixed does not count
  bool relaxed = false;    ///< no u within the bounds reaches tau_c
  bool converged = true;   ///< false: iteration limit of the active set; u is in bounds
  int iterations = 0;      ///< of the active set; zero if the pseudo-inverse was within the bounds
};

/// The paper's tracking program over u (m), in "Tracking Dynamic Trajectories",
///
///     min (u - u*)'Q(u - u*)   subject to   B u = tau_c,   lower <= u <= upper.
///
/// Within the bounds the answer is u* + B_Q^+ (tau_c - B u*), B_Q^+ = Q^-1 B'(B Q^-1 B')^-1. At the
/// bounds an active-set method solves the program without its equality, which the method of
/// multipliers imposes. If no u reaches tau_c, the request is relaxed: u is then nearest to
/// unbounded efforts v that reach it,
///
///     min over u, v of (v - u)'Q(v - u)   subject to   B v = tau_c,   lower <= u <= upper,
///
/// and among such u close to u*. The minimum over v is r'(B Q^-1 B')^-1 r with the shortfall r =
/// tau_c - B u. This norm measures forces and torques alike, by the additional efforts that they
/// would need. The object reuses its storage.
class EffortTracker {
 public:
  /// Q: m positive weights, its diagonal.
  explicit EffortTracker(const Eigen::VectorXd& Q);

  void solve(const EffortRequest& request, EffortAnswer& answer);

 private:
  bool pseudo_inverse(const EffortRequest& request, EffortAnswer& answer);
  void active_set(const EffortRequest& request, double scale, EffortAnswer& answer);
  void minimise_in_box(const EffortRequest& request, EffortAnswer& answer);
  void solve_free();
  bool step_towards_free(const EffortRequest& request, Eigen::VectorXd& u);
  bool release(const Eigen::VectorXd& u);

  Eigen::VectorXd Q_;
  Eigen::MatrixXd BQ_, S_, PB_, H_, H_free_;
  Eigen::LLT<Eigen::MatrixXd> factored_S_;
  Eigen::VectorXd f_, y_, first_, target_, gradient_, rhs_;
  std::vector<int> side_;  ///< for each effort: -1 or 1 at a bound, 0 free
  std::vector<int> free_;
};

}  // namespace maxwrench
