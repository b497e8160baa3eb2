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

/// All solutions of the inverse kinematics of the dependent coordinates,
///
///     X_e(theta_r, y) = X,     six equations in d <= 6 complex numbers y,
///
/// at a complex theta_r in general position and at a few real ones. Almost every theta_r, real or
/// not, has the same number of solutions, and they are continuous along almost every path: a
/// complex path misses the points at which two of them meet (coefficient-parameter continuation,
/// Sommese and Wampler 2005). So the real ones among the ends of all paths to a theta_r are all
/// postures there.
///
/// The first solution is real. A damped Newton's method finds it from the guess or from random
/// points. The others come by monodromy. A loop is a random closed path of theta_r and of the axes
/// of the chain, or of X. All known solutions are tracked around it; at its end they are permuted,
/// and some have become new solutions. The set {(theta_r, axes, y)} is connected, so loops lead
/// from each solution to every other one. A general chain of six has a known number of solutions,
/// with which the search ends; they are tracked to this chain. For other chains the list counts as
/// complete after several loops in a row without a new solution.
class IkStartSystem {
 public:
  explicit IkStartSystem(const Problem& problem);

  /// Whether this is the start system of the problem: chain, pose and limits of theta_r are the
  /// same.
  bool supports(const Problem& problem) const;

  const ToolChain& chain() const { return chain_; }
  const Pose<double>& pose() const { return pose_; }
  /// Whether a posture that reaches the pose is known.
  bool reaches() const { return first_.has_value(); }
  /// theta_r and the real solutions there from which all others were found.
  const IkSolutionSet& first() const { return *first_; }
  /// The number of solutions, real or not.
  int solutions() const { return static_cast<int>(generic_.size()); }

  /// All solutions at theta_r, by paths from the theta_r in general position.
  void go_from_generic(const Eigen::VectorXd& theta_r, PathTracker& tracker,
                       IkSolutionSet& node) const;
  /// The nodes at real theta_r, spread evenly over the limits. Each is computed at its first use,
  /// by any thread.
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
  void seek_more(Continuation<Complex>& continuation, Random& random);
  void find_generic();
  void circle(const ToolChain& chain, const VectorX<Complex>& here, std::size_t most,
              bool moves_pose, Random& random, std::vector<Six<Complex>>& list) const;
  bool deform(Random& random);
  void spread();

  ToolChain chain_;
  Pose<double> pose_;
  Eigen::VectorXd theta_r_min_, theta_r_max_;
  Six<double> middle_{}, reach_{};  ///< the range in which y is searched
  std::optional<IkSolutionSet> first_;
  VectorX<Complex> generic_theta_r_;
  std::vector<Six<Complex>> generic_;
  std::vector<Eigen::VectorXd> places_;
  std::unique_ptr<Lazy[]> lazy_;
};

/// The problem's start system if it is valid for the problem, else a new one.
std::shared_ptr<const IkStartSystem> serving_start_system(const Problem& problem);

}  // namespace maxwrench
