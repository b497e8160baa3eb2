#pragma once

#include <Eigen/Dense>
#include <vector>

namespace maxwrench {

/// What the actuators are asked for at one instant.
struct EffortRequest {
  Eigen::VectorXd tau_c;         ///< n [N, N m], the control effort
  Eigen::VectorXd u_star;        ///< m, efforts to stay close to
  Eigen::VectorXd lower, upper;  ///< m, limits of u and of its rate, whichever is closer
  /// n×n symmetric positive definite: how a control effort that cannot be had is approached. The
  /// inverse of M makes the accelerations nearest (Gauss's principle of least constraint).
  Eigen::MatrixXd P;
};

struct EffortAnswer {
  Eigen::VectorXd u;       ///< m, always within the bounds
  double shortfall = 0;    ///< max |B u - tau_c| [N, N m]; zero to rounding unless relaxed
  bool saturated = false;  ///< at least one effort is at a bound
  bool relaxed = false;    ///< no u within the bounds reaches tau_c
  int iterations = 0;      ///< of the active set
};

/// The paper's tracking program over u (m),
///
///     min (u - u*)'Q(u - u*)   subject to   B u = tau_c,   lower <= u <= upper.
///
/// Inside the bounds the answer is u* + B_Q^+ (tau_c - B u*), B_Q^+ = Q^-1 B'(B Q^-1 B')^-1. At
/// them an active-set method solves the program without its equality, which the method of
/// multipliers imposes. If no u reaches tau_c, the answer is the u that minimises (B u - tau_c)'P(B
/// u - tau_c), close to u*. Reuses its storage.
class EffortTracker {
 public:
  /// B n×m; Q: m positive weights, its diagonal.
  EffortTracker(const Eigen::MatrixXd& B, const Eigen::VectorXd& Q);

  void solve(const EffortRequest& request, EffortAnswer& answer);

 private:
  bool pseudo_inverse(const EffortRequest& request, EffortAnswer& answer);
  void minimise_in_box(const EffortRequest& request, EffortAnswer& answer);
  void solve_free();
  bool step_towards_free(const EffortRequest& request, Eigen::VectorXd& u);
  bool release(const Eigen::VectorXd& u);

  Eigen::MatrixXd B_, BQ_;
  Eigen::VectorXd Q_;
  bool full_rank_ = false;
  Eigen::LLT<Eigen::MatrixXd> BQB_;
  Eigen::MatrixXd H_, H_free_;
  Eigen::VectorXd f_, y_, target_, gradient_, rhs_;
  std::vector<int> side_;  ///< of each effort: -1 and 1 at a bound, 0 free
  std::vector<int> free_;
};

}  // namespace maxwrench
