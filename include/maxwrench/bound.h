#pragma once

#include <memory>
#include <string>
#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

struct Problem;

/// Why no posture of a box is better than `high`.
struct BoxProof {
  enum class Kind {
    kNone,        ///< nothing is known: the box is too large for a bound
    kMultiplier,  ///< U(multiplier) <= high
    kCollision,   ///< all of it collides, the bodies of `pair`; high is -infinity
    kNoPosture    ///< all of it was cut off; high is -infinity
  };
  Kind kind = Kind::kNone;
  double high = kInfinity;     ///< [N or N m]
  Eigen::VectorXd multiplier;  ///< lambda of the measure's program, or mu of the joints
  int pair = -1;               ///< of the robot's `CollisionChecker`
  /// Where it is well cut: a half along this coordinate collides; -1: no such is known. Proves
  /// nothing.
  int axis = -1;
  /// Where a larger box came to its end, to start from in its parts; proves nothing.
  std::vector<int> basis;

  /// Nothing is known but that no value exceeds `most`.
  void forget(double most) {
    kind = Kind::kNone;
    high = most;
    pair = -1;
  }
  /// Takes over that U(lambda) is a bound, if it is lower.
  void improve(double U, const Eigen::VectorXd& lambda) {
    if (!(U < high)) return;
    kind = Kind::kMultiplier;
    high = U;
    multiplier = lambda;
  }
};

/// A part of a box that was cut off: no x in it fulfils the equations f(x) = 0 of what follows from
/// theta_r, as multiplier'f(x) > 0 in all of it.
struct BoxCut {
  int axis = -1;           ///< the coordinate; -1: all of the box
  bool upper = false;      ///< x_axis >= at was cut off; else x_axis <= at
  double at = 0, end = 0;  ///< from there to where the box ended
  Eigen::VectorXd multiplier;
};

/// An upper bound of an objective over boxes of theta_r. One object serves one thread.
class Bound {
 public:
  virtual ~Bound() = default;

  /// Boxes may have more coordinates than theta_r, x = [theta_r; what follows]: turns the limits of
  /// theta_r into those of x, which hold at least one of all postures of each value.
  virtual void extend(Eigen::VectorXd& lower, Eigen::VectorXd& upper) const {
    static_cast<void>(lower);
    static_cast<void>(upper);
  }
  /// Cuts off parts of a box without a posture, one after another; false: it has none. `cuts`, if
  /// not null, gets them.
  virtual bool shrink(Eigen::VectorXd& lower, Eigen::VectorXd& upper, std::vector<BoxCut>* cuts) {
    static_cast<void>(lower);
    static_cast<void>(upper);
    static_cast<void>(cuts);
    return true;
  }

  /// No value is larger, at any theta_r within its limits.
  virtual double ceiling() const = 0;

  /// Whoever asks knows that no value in the box lower <= theta_r <= upper exceeds `high`, and does
  /// not care for those up to `low`: afterwards none exceeds max(low, proof.high), where proof.high
  /// <= high. `proof` comes with the multiplier and basis of a box that contains this one, or none.
  virtual void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low,
                        double high, BoxProof& proof) = 0;

  /// An independent copy without memory.
  virtual std::unique_ptr<Bound> clone() const = 0;
};

/// Of the value of a measure, linf_polytope, l2_polytope or ellipsoid, over postures of a problem,
/// which outlives it. Throws std::invalid_argument, in one line, for what it does not serve: other
/// measures; any wrenches but with linf_polytope and a base whose free axes are as many as they;
/// tasks in time; where joints follow from theta_r or there is a second contact any wrenches,
/// contact forces that nothing limits, or any with the ellipsoid, and chains that are too long.
std::unique_ptr<Bound> make_capability_bound(const Problem& problem, const std::string& measure,
                                             Wrench wrench);
std::unique_ptr<Bound> make_capability_bound(const Problem&&, const std::string&, Wrench) = delete;

}  // namespace maxwrench
