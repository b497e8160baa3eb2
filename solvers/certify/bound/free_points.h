#pragma once

#include <Eigen/Cholesky>
#include <memory>
#include <optional>
#include <vector>

#include "maxwrench/zonotope.h"
#include "solvers/certify/bound/free_limits.h"
#include "solvers/certify/bound/loop_box.h"
#include "solvers/certify/bound/multiplier_program.h"

namespace maxwrench {

/// J'W of the free components of the wrench as multi-affine rows, on the stretches of a model.
struct FreeColumns {
  struct Part {
    MultiAffine f;  ///< the rows of the first component, then those of the next one
    std::vector<int> rows;
    Eigen::Index repeat;
  };

  /// The free components are those of `Problem::W_any` across c.
  FreeColumns(const Problem& problem, const LoopModel& model);

  Eigen::Index k = 0;  ///< free components
  std::vector<Part> parts;
  Eigen::MatrixXd sizes;  ///< magnitudes, n×k
};

/// What free components h of the wrench add to the rows of tau, A h with A = J'W, at the control
/// points of a box. For matrices P and N of the box,
///
///     h = P (B u - tau_m) + rho,   |rho| <= R,   N'A = 0 at the centre m.
///
/// The first equation follows from the balance B u = tau + t a + A h:
///
///     rho = -P (tau - tau_m) - P a t - (P A - 1) h.
///
/// At each control point, u within its limits and rho can be other ones: those of the largest
/// lambda'B u - lambda'A h.
class FreePoints {
 public:
  /// The patterns of u must be few: `few_patterns`. If those of u and rho are many, points have
  /// rho = 0.
  FreePoints(std::shared_ptr<const FreeColumns> columns, const LoopModel& model,
             std::shared_ptr<const Zonotope> set);
  /// Whether numbers of control points with patterns of so many numbers are `int`.
  static bool few_patterns(const LoopModel& model, Eigen::Index numbers);

  /// For values in [low, high], either of which may be infinite. Returns false if nothing limits h.
  /// The box of `loads` has been set; its rows are those of the centre afterwards.
  bool set(LoopBox& loads, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low,
           double high);
  /// Values of interest are within these finite limits.
  double least_t() const { return least_t_; }
  double most_t() const { return most_t_; }
  /// n×(n - k).
  const Eigen::MatrixXd& N() const { return N_; }
  /// The multiplier of the centre, from which P follows.
  const Eigen::VectorXd& centre_lambda() const { return centre_lambda_; }

  /// Subtracts the largest lambda'B u - lambda'A h from g at each control point.
  void weigh(const Eigen::VectorXd& lambda, Eigen::VectorXd& g);
  /// The pattern of the u and rho with the largest lambda'B u - lambda'A h at control point v,
  /// after `weigh`.
  int pattern(Eigen::Index v) const;
  /// Adds A h of a pattern at control point v, after `set`.
  void add(Eigen::Index v, int pattern, Eigen::VectorXd& load);
  /// Magnitudes of B u - A h (n).
  const Eigen::VectorXd& sizes() const { return sizes_; }

 private:
  void find_centre(LoopBox& loads, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
  void find_N();
  void find_P();

  const std::shared_ptr<const FreeColumns> columns_;
  const std::shared_ptr<const Zonotope> set_;
  const Eigen::Index n_, k_, m_;
  const bool rho_in_patterns_;
  std::vector<ControlPoints> corners_;
  std::vector<const Eigen::MatrixXd*> points_;
  FreeLimits limits_;
  MultiplierProgram centre_;  ///< for two points: the centre with least_t and with most_t
  Eigen::VectorXd tau_;       ///< at the centre, as are
  Eigen::MatrixXd A_;         ///< [a A]
  Eigen::MatrixXd off_;       ///< largest deviations of [tau a A] from it in the box
  Eigen::MatrixXd N_, P_, PB_, S_;
  Eigen::VectorXd R_, P_tau_, middle_, half_, centre_lambda_, lambda_, y_, own_, slopes_, sums_, u_,
      h_, sizes_;
  std::vector<Eigen::VectorXd> q_;  ///< lambda'A at all control points, of each component
  std::vector<int> basis_;
  Eigen::LLT<Eigen::MatrixXd> llt_;
  double least_t_ = 0, most_t_ = 0;
};

}  // namespace maxwrench
