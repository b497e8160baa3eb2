#pragma once

#include <functional>
#include <memory>

#include "maxwrench/status.h"
#include "maxwrench/types.h"

namespace maxwrench {

class Tally;
class Measure;
struct KnotRows;
struct Problem;

/// A function f(theta_r) that a `Search` maximises over lower() <= theta_r <= upper(). One object
/// serves one thread.
class Objective {
 public:
  virtual ~Objective() = default;
  virtual const Eigen::VectorXd& lower() const = 0;
  virtual const Eigen::VectorXd& upper() const = 0;

  /// f(theta_r), or -infinity where it has no value; `verdict` then says why.
  /// `gradient`, if given, gets d f/d theta_r (at a kink one of several one-sided derivatives), NaN
  /// where f has no value.
  virtual double evaluate(const Eigen::VectorXd& theta_r, Eigen::VectorXd* gradient = nullptr) = 0;
  /// Rows on theta_r beside its bounds; null: there are none.
  virtual const KnotRows* rows() const { return nullptr; }
  /// M(theta_r), d×d, positive definite where f has a value: how far a step really moves,
  /// |d theta|^2 = d theta_r' M d theta_r. Identity unless the objective knows better. At the point
  /// of the last evaluation it costs none; anywhere else it may cost one, which no budget counts.
  virtual void metric(const Eigen::VectorXd& theta_r, Eigen::MatrixXd& M) {
    M.setIdentity(theta_r.size(), theta_r.size());
  }
  /// Of the last evaluation: kOptimal, or why there is no value.
  virtual const Verdict& verdict() const = 0;

  /// An independent copy without memory of earlier evaluations (no warm start), so that what it
  /// returns depends on its own calls only.
  virtual std::unique_ptr<Objective> clone() const = 0;

  int dimension() const { return static_cast<int>(lower().size()); }
};

using MeasureMaker = std::function<std::unique_ptr<Measure>()>;

/// f(theta_r) = beta of a measure at the postures of a problem, which outlives the objective. No
/// value where the posture is invalid or the program has no optimum. `tally`, if given, counts.
std::unique_ptr<Objective> make_capability_objective(const Problem& problem, Wrench wrench,
                                                     MeasureMaker make, bool check_collision = true,
                                                     std::shared_ptr<Tally> tally = nullptr);
std::unique_ptr<Objective> make_capability_objective(
    const Problem&& problem, Wrench wrench, MeasureMaker make, bool check_collision = true,
    std::shared_ptr<Tally> tally = nullptr) = delete;

}  // namespace maxwrench
