#pragma once

#include <vector>

#include "lib/bound/loop_posture.h"

namespace maxwrench {

/// Rows that depend on a stretch of the chain of coordinates alone. On the grid of the control
/// points of all, of which the first coordinate changes slowest, point v of all is point
/// (v / repeat) mod f.size() of these.
struct LoopPart {
  enum class Kind {
    kLoads,     ///< f = [rows of tau; the same rows of a]
    kForces,    ///< f = rows of tau
    kEquations  ///< f = rows of the equations
  };
  Kind kind;
  MultiAffine f;
  int from, to;  ///< the stretch
  std::vector<int> rows;
  Eigen::Index repeat = 1;
};

/// tau = tau_d + J_2'C_2 w_2, a = J'c and the equations f(x) = 0 as sums of parts.
struct LoopModel {
  /// Keeps a reference. Throws std::invalid_argument, in one line, if there are too many.
  explicit LoopModel(const Problem& problem);

  LoopCoordinates coordinates;
  std::vector<LoopPart> parts;
  Eigen::Index n = 0;         ///< rows of tau_d
  Eigen::Index m = 0;         ///< of the equations
  Eigen::Index size = 1;      ///< control points
  Eigen::VectorXd tau, a, f;  ///< magnitudes

 private:
  using Kind = LoopPart::Kind;

  void add_loads(LoopPosture& posture);
  void add_joints(LoopPosture& posture);
  void add_equations(LoopPosture& posture);
  void add_part(Kind kind, int from, int to, const std::vector<int>& rows,
                const MultiAffine::Sample& sample);
  std::vector<int> new_equations(Eigen::Index count);

  const Problem& problem_;
};

/// The equations over a box, about its centre m: with s_i = sin(x_i - m_i) of turning coordinates,
/// x_i - m_i of sliding ones, |s_i| <= w_i,
///
///     f(x) = f_0 + D s + rest,   |rest| <= rho,
///
/// from the coefficients of f in (1, cos(x_i - m_i) less the middle of its range, s_i), of which
/// those of higher order are summed up.
class LoopLinear {
 public:
  explicit LoopLinear(const LoopModel& model);

  /// Cuts off what no x with f(x) = 0 of the box has; false: it has none.
  bool shrink(Eigen::VectorXd& lower, Eigen::VectorXd& upper);
  /// Rows M f, the first `rank` of which are some s_i/w_i and a linear combination of others, and
  /// the others next to zero.
  void precondition(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
  const Eigen::MatrixXd& M() const { return M_; }
  int rank() const { return rank_; }

 private:
  void expand(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
  void centre(const LoopPart& part, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
  void eliminate();
  bool propagate(const Eigen::MatrixXd& A, const Eigen::VectorXd& e, const Eigen::VectorXd& rho);
  bool narrow(Eigen::VectorXd& lower, Eigen::VectorXd& upper);

  const LoopModel& model_;
  Eigen::MatrixXd coefficients_, D_, A_, M_;
  Eigen::VectorXd weights_, f_0_, rho_, w_, low_, high_, e_, reduced_rho_;
  int rank_ = 0;
  double gain_ = 0;
};

}  // namespace maxwrench
