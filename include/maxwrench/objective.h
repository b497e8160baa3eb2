#pragma once

#include <functional>
#include <memory>

#include "maxwrench/status.h"
#include "maxwrench/types.h"

/// @file
/// The functions that searches maximise.

namespace maxwrench {

class Tally;
class Measure;
struct KnotRows;
struct Problem;

/// A function f(theta_r) that a `Search` maximises over lower() <= theta_r <= upper().
///
/// Use one object per thread.
class Objective {
 public:
  virtual ~Objective() = default;
  virtual const Eigen::VectorXd& lower() const = 0;  ///< Returns the lower bounds of theta_r.
  virtual const Eigen::VectorXd& upper() const = 0;  ///< Returns the upper bounds of theta_r.

  /// Evaluates the function.
  ///
  /// @param theta_r   the point
  /// @param gradient  if not null, receives d f/d theta_r: at a kink one of several one-sided
  ///                  derivatives, and NaN where f has no value
  /// @return f(theta_r), or -infinity where it has no value; `verdict` then gives the reason
  virtual double evaluate(const Eigen::VectorXd& theta_r, Eigen::VectorXd* gradient = nullptr) = 0;
  /// Returns linear constraints on theta_r in addition to its bounds, or null if there are none.
  virtual const KnotRows* rows() const { return nullptr; }
  /// Computes the metric M(theta_r) that measures how far a step moves the robot.
  ///
  /// The squared length of a step d theta_r is |d theta|^2 = d theta_r' M d theta_r. M is d×d, and
  /// positive definite where f has a value. The default is the identity. At the point of the last
  /// evaluation it costs no evaluation. Elsewhere it may cost one, which no budget counts.
  ///
  /// @param theta_r  the point (d)
  /// @param M        receives the metric
  virtual void metric(const Eigen::VectorXd& theta_r, Eigen::MatrixXd& M) {
    M.setIdentity(theta_r.size(), theta_r.size());
  }
  /// Returns the verdict of the last evaluation: kOptimal, or why there is no value.
  virtual const Verdict& verdict() const = 0;

  /// Returns an independent copy without memory of earlier evaluations.
  ///
  /// It has no warm start, so its values depend on its own calls only.
  virtual std::unique_ptr<Objective> clone() const = 0;

  /// Returns the number of coordinates of theta_r.
  int dimension() const { return static_cast<int>(lower().size()); }
};

/// A function that makes a measure; an objective and each of its clones call it.
using MeasureMaker = std::function<std::unique_ptr<Measure>()>;

/// Makes the objective f(theta_r) = beta of a measure at the postures of a problem.
///
/// It has no value where the posture is invalid or the program has no optimum.
///
/// @param problem          the task, which must outlive the objective
/// @param wrench           the allowed wrenches
/// @param make             makes the measure
/// @param check_collision  whether postures that collide are invalid
/// @param tally            if not null, counts postures and undecided evaluations
std::unique_ptr<Objective> make_capability_objective(const Problem& problem, Wrench wrench,
                                                     MeasureMaker make, bool check_collision = true,
                                                     std::shared_ptr<Tally> tally = nullptr);
/// Deleted: the problem must outlive the objective, and a temporary does not.
std::unique_ptr<Objective> make_capability_objective(
    const Problem&& problem, Wrench wrench, MeasureMaker make, bool check_collision = true,
    std::shared_ptr<Tally> tally = nullptr) = delete;

}  // namespace maxwrench
