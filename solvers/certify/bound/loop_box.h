#pragma once

#include "solvers/certify/bound/loop_model.h"

namespace maxwrench {

/// Adds values at the points of a stretch of the chain at their places on the grid of all
/// coordinates, `LoopPart::repeat`.
void spread_out(Eigen::Index repeat, const Eigen::VectorXd& values, Eigen::VectorXd& all);

/// The control points of a `LoopModel` over one box, on the grid of all coordinates.
class LoopBox {
 public:
  /// Keeps a reference to the model.
  explicit LoopBox(const LoopModel& model);
  explicit LoopBox(const LoopModel&&) = delete;

  /// Returns false if the box is too large for control points.
  bool set(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

  /// Computes g = lambda'tau + nu'f and h = lambda'a at all control points.
  void weigh(const Eigen::VectorXd& lambda, const Eigen::VectorXd& nu) {
    weigh(lambda, lambda, nu);
  }
  /// The same with another multiplier of a, for h = slopes'a.
  void weigh(const Eigen::VectorXd& lambda, const Eigen::VectorXd& slopes,
             const Eigen::VectorXd& nu);
  Eigen::VectorXd& g() { return g_; }
  const Eigen::VectorXd& h() const { return h_; }

  /// Computes tau, a and f at control point v.
  void read(Eigen::Index v);
  /// Computes tau, a and f at x.
  void evaluate(const Eigen::VectorXd& x);
  /// Computes tau, a and f at x, and limits of |tau_v - tau| and |a_v - a| of each row over all
  /// control points v: the sums of those of its parts.
  void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& off_tau, Eigen::VectorXd& off_a);
  const Eigen::VectorXd& tau() const { return tau_; }
  const Eigen::VectorXd& a() const { return a_; }
  const Eigen::VectorXd& f() const { return f_; }

 private:
  /// Adds up the values of all parts.
  template <class Values>
  void collect(const Values& values_of);

  const LoopModel& model_;
  std::vector<ControlPoints> corners_;
  std::vector<const Eigen::MatrixXd*> points_;
  Eigen::VectorXd g_, h_, sum_, own_, tau_, a_, f_;
};

}  // namespace maxwrench
