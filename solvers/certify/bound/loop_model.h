#pragma once

#include <optional>
#include <vector>

#include "solvers/certify/bound/loop_posture.h"

namespace maxwrench {

/// Rows that depend only on a stretch of the chain of coordinates. On the grid of the control
/// points of all coordinates, the first coordinate changes slowest, and grid point v is point (v /
/// repeat) mod f.size() of these rows.
struct LoopPart {
  enum class Kind {
    kLoads,     ///< f = [rows of tau; the same rows of a]
    kForces,    ///< f = rows of tau
    kEquations  ///< f = rows of the equations
  };
  Kind kind;
  MultiAffine f;
  int from;  ///< where the stretch begins
  std::vector<int> rows;
  Eigen::Index repeat;
};

/// tau = tau_d + J_2'C_2 w_2 at t = 0, a = J'c plus the change of J_2'C_2 w_2 per unit of t, and
/// the equations f(x) = 0, as sums of parts.
///
/// With `ContactForces::kOfBase`, tau = tau_d - A tau_d,f and a = J'c - A (J'c)_f, where f are the
/// base's linear rows, which are left out, and A are the levers. The balance of the other rows is
/// B u = tau + t a + A B_f u.
struct LoopModel {
  /// Keeps a reference to the problem. Throws std::invalid_argument with one line if there are too
  /// many control points. `left_out`: the coordinate about the yaw, or none. Without it only the
  /// joints of the chain have rows: those of the base depend on its own yaw.
  explicit LoopModel(const Problem& problem, ContactForces forces = ContactForces::kShares,
                     std::optional<int> left_out = std::nullopt);

  /// Takes the equations out.
  void leave_equations();

  LoopCoordinates coordinates;
  std::vector<LoopPart> parts;
  std::optional<MultiAffine> levers;  ///< A column by column, along the second arm; `kOfBase`
  std::vector<int> dropped;           ///< rows of tau without parts
  Eigen::Index n = 0;                 ///< rows of tau_d
  Eigen::Index m = 0;                 ///< equations
  Eigen::Index size = 0;              ///< control points
  Eigen::VectorXd tau, a, f;          ///< magnitudes of the rows

 private:
  using Kind = LoopPart::Kind;

  void add_loads(LoopPosture& posture);
  void add_levers(LoopPosture& posture);
  void add_joints(LoopPosture& posture);
  void add_joint(LoopPosture& posture, int joint, int from);
  void add_equations(LoopPosture& posture);
  void add_part(Kind kind, int from, int to, const std::vector<int>& rows,
                const MultiAffine::Sample& sample);
  std::vector<int> new_equations(Eigen::Index count);

  const Problem& problem_;
};

}  // namespace maxwrench
