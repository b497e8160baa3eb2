#include "lib/posture/ik/ik_start_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lib/math/random.h"
#include "lib/posture/ik/damped_newton.h"
#include "lib/posture/ik/path_tracker.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

/// The largest number of starting points of Newton's method for the first solution.
constexpr int kFirstStarts = 4000;
/// The search for solutions ends after this many loops without a new one.
constexpr int kIdleLoops = 10;
constexpr int kMostLoops = 300;
/// A chain of six joints has at most 16 solutions. The limit only stops a search that has gone
/// wrong.
constexpr std::size_t kMostSolutions = 64;
/// The number of solutions of a general chain of six with so many slides (Primrose 1986; Mavroidis
/// and Roth 1994).
constexpr std::array<std::size_t, 4> kGeneralSolutions = {16, 16, 8, 2};
/// [rad or m] Solutions of a chain of six that is deformed into this one are multiple ones if they
/// come closer than this.
constexpr double kMultiple = 1e-4;
/// Where rounding magnifies by more than this, they are infinite.
constexpr double kInfinite = 1e9;
/// The numbers of starting points of Newton's method for further real and for complex solutions.
constexpr int kRealStarts = 100;
constexpr int kComplexStarts = 200;
/// If a pivot of J_d is below this share of the largest, the solution is a multiple one at every
/// theta_r and is dropped.
constexpr double kSingularSolution = 1e-6;
constexpr double kPi = std::numbers::pi;

/// A stop of a loop: theta_r, and the y of the end effector pose that X takes.
struct Stop {
  VectorX<Complex> theta_r;
  Six<Complex> y{};
};

/// A random stop that is not near the real numbers.
Stop random_stop(const ToolChain& chain, const Stop& around, Random& random) {
  constexpr double kImaginary = 0.7;
  Stop stop = around;
  const auto moved = [&](double middle, double reach) {
    return Complex(middle + random.uniform(-reach, reach), random.uniform(-kImaginary, kImaginary));
  };
  for (Complex& theta : stop.theta_r) theta = moved(theta.re, 2);
  for (int i = 0; i < chain.unknowns(); ++i) {
    Complex& y = stop.y[static_cast<std::size_t>(i)];
    y = moved(y.re, chain.turns(i) ? 2 : 0.5);
  }
  return stop;
}

HomotopyPath<Complex> between(const Stop& from, const Stop& to) {
  HomotopyPath<Complex> path;
  path.from = from.theta_r;
  path.to = to.theta_r;
  path.bend.setConstant(path.from.size(), Complex(0.0));
  path.moves_pose = true;
  path.y_from = from.y;
  path.y_to = to.y;
  return path;
}

VectorX<Complex> complex_of(const Eigen::VectorXd& theta_r) {
  VectorX<Complex> result;
  assign(theta_r, result);
  return result;
}

/// Number i of the van der Corput sequence to a base.
double radical_inverse(int i, int base) {
  double result = 0, digit = 1.0 / base;
  for (; i > 0; i /= base, digit /= base) result += digit * (i % base);
  return result;
}

/// Adds y to the solutions if it is new.
bool keep(const ToolChain& chain, Six<Complex> y, std::vector<Six<Complex>>& list) {
  wrap(chain, y);
  if (list.size() >= kMostSolutions || contains(chain, list, y)) return false;
  list.push_back(y);
  return true;
}

}  // namespace

IkStartSystem::IkStartSystem(const Problem& problem)
    : chain_(problem),
      pose_(problem.pose),
      theta_r_min_(problem.theta_r_min.head(chain_.parameters())),
      theta_r_max_(problem.theta_r_max.head(chain_.parameters())) {
  find_first(problem);
  if (!first_) return;
  find_generic();
  if (generic_.empty()) {
    first_.reset();
    return;
  }
  spread();
}

bool IkStartSystem::supports(const Problem& problem) const {
  const auto r = chain_.parameters();
  return problem.redundancy() >= r && problem.pose.p == pose_.p && problem.pose.R == pose_.R &&
         problem.theta_r_min.head(r) == theta_r_min_ &&
         problem.theta_r_max.head(r) == theta_r_max_ && ToolChain(problem) == chain_;
}

/// Sets the range of y: any angle, joints within their limits, the base near the pose at theta_r.
void IkStartSystem::set_reach(const Problem& problem, const Eigen::VectorXd& theta_r) {
  const Eigen::Vector3d near = (problem.robot.mount.inverse() * pose_at(problem, theta_r)).p;
  for (int j = 0; j < chain_.unknowns(); ++j) {
    const auto k = static_cast<std::size_t>(j);
    const int z = chain_.place_in_z(j);
    middle_[k] = 0;
    reach_[k] = chain_.turns(j) ? kPi : 1;
    if (chain_.turns(j)) continue;
    if (z < 4) {
      middle_[k] = near[z];
      continue;
    }
    const Joint& joint = problem.robot.joints[static_cast<std::size_t>(z - 4)];
    if (!std::isfinite(joint.q_min) || !std::isfinite(joint.q_max)) continue;
    middle_[k] = (joint.q_min + joint.q_max) / 2;
    reach_[k] = (joint.q_max - joint.q_min) / 2;
  }
}

/// A random real y within its range.
Six<double> IkStartSystem::random_y(Random& random) const {
  Six<double> y{};
  for (int j = 0; j < chain_.unknowns(); ++j) {
    y[static_cast<std::size_t>(j)] = middle_[static_cast<std::size_t>(j)] +
                                     reach_[static_cast<std::size_t>(j)] * random.uniform(-1, 1);
  }
  return y;
}

/// Finds a first solution at the default from the guess or a random y, or else at a random theta_r.
/// Then finds other real solutions at that theta_r.
void IkStartSystem::find_first(const Problem& problem) {
  set_reach(problem, problem.theta_r_default);
  DampedNewton newton(chain_, pose_);
  Continuation<double> correction(chain_);
  Random random(1);
  IkSolutionSet node;
  node.theta_r = problem.theta_r_default.head(chain_.parameters());
  const Eigen::VectorXd at_default = node.theta_r;
  Six<double> y{};
  for (int j = 0; j < chain_.unknowns(); ++j) {
    const int z = chain_.place_in_z(j);
    y[static_cast<std::size_t>(j)] = z < 4 ? problem.guess_base[z] : problem.guess_q[z - 4];
  }
  for (int i = 0, after = 0; i < kFirstStarts && after < kRealStarts; ++i) {
    if (node.real.empty() && i > 0) {
      node.theta_r = at_default;
      for (Eigen::Index k = 0; k < at_default.size() && i % 2 == 0; ++k) {
        node.theta_r[k] = random.uniform(theta_r_min_[k], theta_r_max_[k]);
      }
      set_reach(problem, node.theta_r);
    }
    if (i > 0) y = random_y(random);
    after += node.real.empty() ? 0 : 1;
    if (!newton.run(node.theta_r, y) || !correction.correct(node.theta_r, pose_, y)) continue;
    if (correction.is_singular(kSingularSolution)) continue;
    wrap(chain_, y);
    if (!contains(chain_, node.real, y)) node.real.push_back(y);
  }
  if (!node.real.empty()) first_ = node;
}

/// Chooses a theta_r in general position, to which all first solutions are tracked, or most of
/// them.
void IkStartSystem::seek_generic(Continuation<Complex>& continuation, Random& random) {
  const Pose<Complex> pose = complex_of(pose_);
  const Stop base{complex_of(first_->theta_r), complex_of(first_->real[0])};
  HomotopyPath<Complex> path;
  path.from = base.theta_r;
  path.bend.setConstant(path.from.size(), Complex(0.0));
  path.pose = pose;
  for (int attempt = 0; attempt < 20 && generic_.size() < first_->real.size(); ++attempt) {
    path.to = random_stop(chain_, base, random).theta_r;
    std::vector<Six<Complex>> ends;
    for (const Six<double>& y : first_->real) {
      Six<Complex> end = complex_of(y);
      if (continuation.track(path, end)) keep(chain_, end, ends);
    }
    if (attempt > 0 && ends.size() <= generic_.size()) continue;
    generic_theta_r_ = path.to;
    generic_ = ends;
  }
}

/// Adds the solutions at theta_r in general position that Newton's method finds.
void IkStartSystem::seek_more(Continuation<Complex>& continuation, Random& random) {
  const Pose<Complex> pose = complex_of(pose_);
  const Stop base{complex_of(first_->theta_r), complex_of(first_->real[0])};
  for (int start = 0; start < kComplexStarts; ++start) {
    Six<Complex> y = random_stop(chain_, base, random).y;
    for (int i = 0; i < chain_.unknowns(); ++i) {
      if (chain_.turns(i)) y[static_cast<std::size_t>(i)].re = random.uniform(-kPi, kPi);
    }
    const bool arrived = continuation.seek(generic_theta_r_, pose, y);
    if (arrived && !continuation.is_singular(kSingularSolution)) keep(chain_, y, generic_);
  }
}

/// Tracks all known solutions around loops from `here`, until there are `most` of them or no new
/// ones. If `moves_pose`, every other loop also moves X along with one of the solutions, which
/// returns to itself.
void IkStartSystem::circle(const ToolChain& chain, const VectorX<Complex>& here, std::size_t most,
                           bool moves_pose, Random& random, std::vector<Six<Complex>>& list) const {
  Continuation<Complex> continuation(chain);
  for (int loop = 0, idle = 0; loop < kMostLoops && idle < kIdleLoops && list.size() < most;
       ++loop, ++idle) {
    const auto reference =
        static_cast<std::size_t>(random.uniform() * static_cast<double>(list.size()));
    const Stop base{here, list[reference]};
    const Stop first = random_stop(chain, base, random);
    const Stop second = random_stop(chain, base, random);
    std::array<HomotopyPath<Complex>, 3> ways = {between(base, first), between(first, second),
                                                 between(second, base)};
    for (HomotopyPath<Complex>& path : ways) {
      path.moves_pose = moves_pose && loop % 2 == 0;
      path.pose = complex_of(pose_);
    }
    const std::size_t known = list.size();
    for (std::size_t i = 0; i < known; ++i) {
      Six<Complex> y = list[i];
      const bool arrived = std::all_of(
          ways.begin(), ways.end(),
          [&](const HomotopyPath<Complex>& path) { return continuation.track(path, y); });
      if (arrived && !continuation.is_singular(kSingularSolution) && keep(chain, y, list)) {
        idle = -1;
      }
    }
  }
}

/// Finds all solutions of a chain of six whose axes are neither parallel nor meet, and tracks them
/// to this chain. Near a special geometry some are almost infinite or almost the same: loops of
/// theta_r and X do not lead from the others to them. Returns whether there are as many as theory
/// has.
bool IkStartSystem::deform(Random& random) {
  std::size_t slides = 0;
  for (int i = 0; i < chain_.unknowns(); ++i) slides += chain_.turns(i) ? 0 : 1;
  if (chain_.unknowns() < 6 || slides >= kGeneralSolutions.size()) return false;
  const ToolChain wide = chain_.deformable();
  Continuation<Complex> continuation(wide);
  HomotopyPath<Complex> path;
  path.pose = complex_of(pose_);
  path.from.setConstant(wide.parameters(), Complex(0.0));
  path.from.head(generic_theta_r_.size()) = generic_theta_r_;
  path.to = random_stop(wide, {path.from, generic_[0]}, random).theta_r;
  path.bend.setConstant(wide.parameters(), Complex(0.0));
  std::vector<Six<Complex>> list;
  for (Six<Complex> y : generic_) {
    if (continuation.track(path, y)) keep(wide, y, list);
  }
  if (list.empty()) return false;
  circle(wide, path.to, kGeneralSolutions[slides], false, random, list);
  std::swap(path.from, path.to);
  // Paths to infinity fail. A second way finds what fails on the first one by chance.
  for (int way = 0; way < 2 && generic_.size() < list.size(); ++way) {
    for (Six<Complex> y : list) {
      if (!continuation.track(path, y) || continuation.is_singular(kSingularSolution) ||
          continuation.is_far(y, kInfinite)) {
        continue;
      }
      wrap(chain_, y);
      if (!contains(chain_, generic_, y, kMultiple)) generic_.push_back(y);
    }
    for (Complex& bend : path.bend) bend = {random.uniform(-1, 1), random.uniform(-1, 1)};
  }
  return list.size() == kGeneralSolutions[slides];
}

void IkStartSystem::find_generic() {
  Continuation<Complex> continuation(chain_);
  Random random(2);
  seek_generic(continuation, random);
  if (generic_.empty()) seek_more(continuation, random);
  if (generic_.empty() || deform(random)) return;
  seek_more(continuation, random);
  circle(chain_, generic_theta_r_, kMostSolutions, true, random, generic_);
}

void IkStartSystem::spread() {
  static constexpr std::array<int, 10> kPrimes = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29};
  const auto r = static_cast<Eigen::Index>(chain_.parameters());
  const int count = r == 0 ? 1 : 32 << std::min<Eigen::Index>(r, 4);
  for (int i = 0; i < count; ++i) {
    Eigen::VectorXd place(r);
    for (Eigen::Index k = 0; k < r; ++k) {
      const double share = radical_inverse(i + 1, kPrimes[static_cast<std::size_t>(k) % 10]);
      place[k] = theta_r_min_[k] + share * (theta_r_max_[k] - theta_r_min_[k]);
    }
    places_.push_back(place);
  }
  lazy_ = std::make_unique<Lazy[]>(places_.size());
}

const IkSolutionSet& IkStartSystem::node(int i) const {
  Lazy& lazy = lazy_[static_cast<std::size_t>(i)];
  std::call_once(lazy.once, [&] {
    PathTracker tracker(chain_, pose_);
    go_from_generic(place(i), tracker, lazy.node);
  });
  return lazy.node;
}

void IkStartSystem::go_from_generic(const Eigen::VectorXd& theta_r, PathTracker& tracker,
                                    IkSolutionSet& node) const {
  HomotopyPath<Complex>& path = tracker.path();
  path.from = generic_theta_r_;
  assign(theta_r, path.to);
  node.theta_r = theta_r;
  // Another way is as good if a path fails by chance.
  for (const double side : {0.0, 1.0, -1.0}) {
    for (Eigen::Index k = 0; k < theta_r.size(); ++k) {
      path.bend[k] = Complex(0, side) * (path.to[k] - path.from[k]);
    }
    tracker.begin();
    for (const Six<Complex>& y : generic_) tracker.carry(y);
    tracker.finish(node);
    if (node.complete || theta_r.size() == 0) return;
  }
}

std::shared_ptr<const IkStartSystem> serving_start_system(const Problem& problem) {
  if (problem.start_system && problem.start_system->supports(problem)) return problem.start_system;
  return std::make_shared<const IkStartSystem>(problem);
}

void prepare_ik_solutions(Problem& problem) {
  if (!problem.dependent.empty()) problem.start_system = serving_start_system(problem);
}

}  // namespace maxwrench
