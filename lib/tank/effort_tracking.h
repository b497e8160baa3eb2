#pragma once

#include <Eigen/Dense>
#include <vector>

namespace maxwrench {

/// What the actuators are asked for at one instant.
struct EffortRequest {
  Eigen::MatrixXd B;             ///< n×m: efforts -> control effort
  Eigen::VectorXd tau_c;         ///< n [N, N m], the control effort
  Eigen::VectorXd u_star;        ///< m, efforts to stay close to
  Eigen::VectorXd lower, upper;  ///< m, limits of u and of its rate, whichever is closer
};

struct EffortAnswer {
  Eigen::VectorXd u;       ///< m, always within the bounds
  double shortfall = 0;    ///< max |B u - tau_c| [N, N m]; zero to rounding unless relaxed
  bool saturated = false;  ///< at least one effort is at a bound
  bool relaxed = false;    ///< no u within the bounds reaches tau_c
  bool converged = true;   ///< false: the active set ran out of iterations, u is within the bounds
  int iterations = 0;      ///< of the active set; zero: the pseudo-inverse was within the bounds
};

/// The paper's tracking program over u (m), in "Tracking Dynamic Trajectories",
///
///     min (u - u*)'Q(u - u*)   subject to   B u = tau_c,   lower <= u <= upper.
///
/// Inside the bounds the answer is u* + B_Q^+ (tau_c - B u*), B_Q^+ = Q^-1 B'(B Q^-1 B')^-1. At
/// them an active-set method solves the program without its equality, which the method of
/// multipliers imposes. If no u reaches tau_c, the request is relaxed: u is then nearest to efforts
/// v, free of bounds, that do,
///
///     min over u, v of (v - u)'Q(v - u)   subject to   B v = tau_c,   lower <= u <= upper,
///
/// and among such u close to u*. This is r'(B Q^-1 B')^-1 r of what is missing, r = tau_c - B u:
/// the efforts that would be needed besides measure forces and torques alike. Reuses its storage.
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
  std::vector<int> side_;  ///< of each effort: -1 and 1 at a bound, 0 free
  std::vector<int> free_;
};

}  // namespace maxwrench
