#pragma once

#include <limits>
#include <string>
#include <vector>

#include "solvers/solve/case.h"
#include "maxwrench/posture.h"

namespace maxwrench {

/// The names of the integrators that serve the virtual tank on a problem; none if there is no
/// experiment, as with a second contact or a measure that is no wrench of the polytope.
std::vector<std::string> served_integrators(const Problem& problem, const std::string& measure);

/// `Row` of a case with an integrator: what the virtual tank, without imperfections, makes of the
/// task's default posture, which a task in time holds throughout. kReached with a reading, whether
/// or not it was held; kNoneFound if the posture was lost.
struct TankRow : Verdict {
  Case choice;
  const char* unit = "";                                      ///< of both
  double planned = std::numeric_limits<double>::quiet_NaN();  ///< c'h that the posture or plan has
  /// c'h_e of the load cell: the mean of the hold, the least along a path, that at t_h of a heave.
  double reading = std::numeric_limits<double>::quiet_NaN();
  std::string missed;       ///< why it was not held; empty: it was
  Eigen::VectorXd theta_r;  ///< of a plan knot by knot
  long evaluations = 0;     ///< of the derivatives
  double wall_s = 0;

  bool has_value() const { return status == Status::kReached; }
};

/// As `simulate` does it. Throws std::invalid_argument as `resolve` and `resolve_plan`, and on an
/// integrator that does not serve.
TankRow run_experiment(const Problem& problem, const Case& c);

/// The cells of `value_columns`: beta is the reading, yardstick what was planned.
std::vector<std::string> values(const Problem& problem, const TankRow& row);

}  // namespace maxwrench
