#pragma once

#include <memory>
#include <string>
#include <vector>

#include "maxwrench/types.h"

/// @file
/// Upper bounds of a capability over boxes of theta_r, for proofs by branch and bound.

namespace maxwrench {

struct Problem;

/// The reason why no posture of a box has a larger value than `high`.
struct BoxProof {
  /// The kind of reason.
  enum class Kind {
    kNone,        ///< no reason: the box is too large for a bound
    kMultiplier,  ///< U(multiplier) <= high
    kCollision,   ///< the bodies of `pair` collide in all of the box; high is -infinity
    kNoPosture    ///< the equations exclude all of the box; high is -infinity
  };
  Kind kind = Kind::kNone;     ///< the kind of reason
  double high = kInfinity;     ///< the upper bound [N or N m]
  Eigen::VectorXd multiplier;  ///< lambda of the measure's program, or mu, one number per joint
  /// Of `kNoPosture`: nu'f(x) > 0 in all of the box. Empty if slices that were cut off contain it.
  Eigen::VectorXd nu;
  int pair = -1;  ///< pair of the robot's `CollisionChecker`; -1: none
  /// A coordinate along which to cut the box, because one half then collides; -1: none is known. It
  /// proves nothing.
  int axis = -1;
  /// The final basis of a larger box, a warm start for its parts. It proves nothing.
  std::vector<int> basis;

  /// Resets the proof to the bound `most`, without a reason.
  void forget(double most) {
    kind = Kind::kNone;
    high = most;
    pair = -1;
  }
  /// Stores the bound U = U(lambda) with its multiplier if it is lower than `high`.
  void improve(double U, const Eigen::VectorXd& lambda) {
    if (!(U < high)) return;
    kind = Kind::kMultiplier;
    high = U;
    multiplier = lambda;
  }
  /// Stores that the box has no posture.
  ///
  /// @param by  the `nu` that proves it, or empty
  void exclude(const Eigen::VectorXd& by) {
    kind = Kind::kNoPosture;
    high = -kInfinity;
    nu = by;
  }
};

/// A part of a box that was cut off because it has no posture.
///
/// No x in it satisfies the equations f(x) = 0 of the dependent coordinates, because
/// multiplier'f(x) > 0 in all of it.
struct BoxCut {
  int axis = -1;               ///< the coordinate of the cut; -1: all of the box was cut off
  bool upper = false;          ///< true: x_axis >= at was cut off; false: x_axis <= at
  double at = 0,               ///< one end of the part that was cut off
      end = 0;                 ///< its other end, the former limit of the box
  Eigen::VectorXd multiplier;  ///< the proof
};

/// An upper bound of an objective over boxes of theta_r.
///
/// Use one object per thread.
class Bound {
 public:
  virtual ~Bound() = default;

  /// Turns the limits of theta_r into the limits of the coordinates x of a box.
  ///
  /// Boxes may have more coordinates than theta_r: x = [theta_r; dependent coordinates]. For each
  /// value that postures have, the new limits contain at least one posture with this value.
  ///
  /// @param lower,upper  the limits, replaced in place
  virtual void extend(Eigen::VectorXd& lower, Eigen::VectorXd& upper) const {
    static_cast<void>(lower);
    static_cast<void>(upper);
  }
  /// Shrinks a box by cutting off parts without a posture, one after another.
  ///
  /// @param lower,upper  the limits of the box, replaced in place
  /// @param cuts         if not null, receives the parts that were cut off
  /// @return false if the box has no posture
  virtual bool shrink(Eigen::VectorXd& lower, Eigen::VectorXd& upper, std::vector<BoxCut>* cuts) {
    static_cast<void>(lower);
    static_cast<void>(upper);
    static_cast<void>(cuts);
    return true;
  }

  /// Returns the coordinate on which no value depends, apart from collisions; -1: none.
  ///
  /// Boxes are cut along it only where `BoxProof::axis` says so.
  virtual int left_out() const { return -1; }

  /// Returns a number that no value exceeds at any theta_r within its limits.
  virtual double ceiling() const = 0;

  /// Bounds the values in the box lower <= theta_r <= upper.
  ///
  /// The caller knows that no value in the box exceeds `high`, and ignores values up to `low`.
  /// After the call, no value in the box exceeds max(low, proof.high), and proof.high <= high.
  ///
  /// @param lower,upper  the limits of the box
  /// @param low          values up to this one do not matter
  /// @param high         a known upper bound
  /// @param proof        on entry, the multiplier and basis of a box that contains this one, or
  ///                     none; on return, the bound and its reason
  virtual void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low,
                        double high, BoxProof& proof) = 0;

  /// Returns an independent copy without memory of earlier calls.
  virtual std::unique_ptr<Bound> clone() const = 0;
};

/// Makes the upper bound of a measure over the postures of a static problem.
///
/// It supports the measures linf_polytope, l2_polytope and ellipsoid. `Wrench::kAny` requires
/// linf_polytope, no second contact, and either dependent joints and no list of scenarios, or a
/// base with as many free axes as there are wrench columns. The ellipsoid supports no forces of a
/// second contact.
///
/// @param problem  the task, which must outlive the bound
/// @param measure  the name of the measure
/// @param wrench   the allowed wrenches
/// @return the bound
/// @throws std::invalid_argument, with one line, for a case that is not supported: another measure
///         or wrench, a task in time, contact forces that nothing limits, a direction c that the
///         free axes of the base do not limit, or a chain that is too long.
std::unique_ptr<Bound> make_capability_bound(const Problem& problem, const std::string& measure,
                                             Wrench wrench);
/// Deleted: the problem must outlive the bound, and a temporary does not.
std::unique_ptr<Bound> make_capability_bound(const Problem&&, const std::string&, Wrench) = delete;

}  // namespace maxwrench
