#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "lib/posture/ik/ik_solution_set.h"

namespace maxwrench {

class PathTracker;
class Random;
template <class T>
class Continuation;
struct Problem;

/// All solutions of the inverse kinematics of what follows,
///
///     X_e(theta_r, y) = X,     six equations in d <= 6 complex numbers y,
///
/// at a theta_r in general position, complex, and at a few real ones. There are as many at almost
/// every theta_r, real or not, and they follow continuously along almost every way: where the way
/// is complex, it meets none of the places at which two of them fall together
/// (coefficient-parameter continuation, Sommese and Wampler 2005). So the real ones among the ends
/// of all ways to a theta_r are all postures there.
///
/// The first solution is a real one, found by a damped Newton's method from the guess or from
/// random places. The others come by monodromy: all known ones are carried around a random loop in
/// (theta_r, X), which starts where the end effector stands by the first solution; at its end they
/// have changed places, and some stand at new ones. The set {(theta_r, y)} that the equations
/// describe for all X together is connected, as it is a product of lines, so loops lead from each
/// solution to each other one. When many loops in a row found nothing the list counts as complete.
class IkStartSystem {
 public:
  explicit IkStartSystem(const Problem& problem);

  /// Whether it is that of this problem: chain, pose and limits of theta_r are the same.
  bool serves(const Problem& problem) const;

  const ToolChain& chain() const { return chain_; }
  const Pose<double>& pose() const { return pose_; }
  /// Whether a posture is known that reaches the pose.
  bool reaches() const { return first_.has_value(); }
  /// theta_r and y of the posture that all others come from.
  const IkSolutionSet& first() const { return *first_; }
  /// How many solutions there are, real or not.
  int solutions() const { return static_cast<int>(generic_.size()); }

  /// All solutions at theta_r, by ways from the place in general position.
  void go_from_generic(const Eigen::VectorXd& theta_r, PathTracker& tracker,
                       IkSolutionSet& node) const;
  /// The real places, spread evenly over the limits of theta_r; each is computed when it is asked
  /// for first, by any thread.
  int nodes() const { return static_cast<int>(places_.size()); }
  const Eigen::VectorXd& place(int i) const { return places_[static_cast<std::size_t>(i)]; }
  const IkSolutionSet& node(int i) const;

 private:
  struct Lazy {
    std::once_flag once;
    IkSolutionSet node;
  };

  void find_first(const Problem& problem);
  void set_reach(const Problem& problem, const Eigen::VectorXd& theta_r);
  Six<double> random_y(Random& random) const;
  void seek_generic(Continuation<Complex>& continuation, Random& random);
  void find_generic();
  bool keep(Six<Complex> y);
  void spread();

  ToolChain chain_;
  Pose<double> pose_;
  Eigen::VectorXd theta_r_min_, theta_r_max_;
  Six<double> middle_{}, reach_{};  ///< where y is looked for
  std::optional<IkSolutionSet> first_;
  VectorX<Complex> generic_theta_r_;
  std::vector<Six<Complex>> generic_;
  std::vector<Eigen::VectorXd> places_;
  std::unique_ptr<Lazy[]> lazy_;
};

/// That of the problem if it serves, else a new one.
std::shared_ptr<const IkStartSystem> serving_start_system(const Problem& problem);

}  // namespace maxwrench
