#include <algorithm>
#include <array>
#include <cmath>

#include "lib/math/gjk.h"
#include "lib/robot/chain.h"
#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/bound/exact_posture.h"

namespace maxwrench {
namespace {

/// The depth [m] within reach that the whole box must have. It exceeds the rounding errors of
/// collision checks.
constexpr double kDepth = 1e-6;

/// Pairs with a hull and more control points than this (8 joints that turn) have no proof: they
/// would take too much time, and are many.
constexpr Eigen::Index kMostBesideHull = 6561;

/// The coordinates of a posture that move one link relative to the other.
Coordinates between_links(const Problem& problem, int a, int b) {
  std::vector<char> carries(problem.robot.joints.size(), 0);
  for (const int from : {a, b}) {
    for (int link = from; link > 0;
         link = problem.robot.joints[static_cast<std::size_t>(link - 1)].parent) {
      carries[static_cast<std::size_t>(link - 1)] ^= 1;
    }
  }
  const std::vector<int> joints = moved_joints(problem);
  Coordinates some;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const int joint = joints[i];
    if (joint < 0 || !carries[static_cast<std::size_t>(joint)]) continue;
    some.index.push_back(static_cast<int>(i));
    some.turns.push_back(problem.robot.joints[static_cast<std::size_t>(joint)].type ==
                         JointType::kRevolute);
  }
  return some;
}

/// The rows of (R, p) of link a in the axes of link b, 12, column by column.
MultiAffine relative_pose(const Problem& problem, int a, int b) {
  ExactPosture posture(problem);
  const Eigen::VectorXd rest =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(moved_joints(problem).size()));
  return {between_links(problem, a, b), rest, [&](const ExtendedVector& at) {
            posture.set(at);
            const auto& links = posture.links();
            const Pose<Extended> pose =
                links[static_cast<std::size_t>(b)].inverse() * links[static_cast<std::size_t>(a)];
            ExtendedVector rows(12);
            for (int i = 0; i < 3; ++i) rows.segment<3>(3 * i) = pose.R.col(i);
            rows.tail<3>() = pose.p;
            return rows;
          }};
}

/// How far x [m], in the axes of a core, is beyond the core's reach; negative within it. Convex.
double beyond(const Eigen::Vector3d& half_sizes, double reach, const Eigen::Vector3d& x) {
  const Eigen::Vector3d outside = x.cwiseAbs() - half_sizes;
  const double most = outside.maxCoeff();
  return (most <= 0 ? most : outside.cwiseMax(0).norm()) - reach;
}

/// A core that moves in the axes of another core's link. The points tried are its corners and
/// midpoints. If one of the two is a hull, they are found at the centre of each box.
struct Mover {
  int pair;
  InnerBody core, other;
  double reach;
  double far;  ///< centres farther apart than this are out of reach
  MultiAffine path;
  std::vector<Eigen::Vector3d> points;  ///< in the axes of their link; none with a hull
  Pose<double> into;                    ///< the other's link -> its core
  ConvexCore solid, other_solid;        ///< the cores, if one of them is a hull
  Pose<double> middle;                  ///< of the other core, in its own axes
};

bool is_hull(const InnerBody& core) { return !core.points.empty(); }

bool is_segment(const InnerBody& core) {
  return !is_hull(core) && (core.half_sizes.array() > 0).count() <= 1;
}

double radius_of(const InnerBody& core) {
  if (!is_hull(core)) return core.half_sizes.norm();
  double farthest = 0;
  for (const Eigen::Vector3d& x : core.points) farthest = std::max(farthest, x.norm());
  return farthest;
}

ConvexCore solid_of(const InnerBody& core) {
  ConvexCore solid;
  solid.half_sizes = core.half_sizes;
  solid.points.resize(static_cast<Eigen::Index>(core.points.size()), 3);
  for (std::size_t i = 0; i < core.points.size(); ++i) {
    solid.points.row(static_cast<Eigen::Index>(i)) = core.points[i].transpose();
  }
  return solid;
}

/// The same for a core that may be a hull. Any mean of the hull's points can prove that x is within
/// reach.
double beyond(const Mover& mover, const Eigen::Vector3d& x) {
  if (!is_hull(mover.other)) return beyond(mover.other.half_sizes, mover.reach, x);
  return (x - point_near(mover.other_solid, x, mover.reach)).norm() - mover.reach;
}

std::vector<Eigen::Vector3d> points_of(const InnerBody& core) {
  const int steps = is_segment(core) ? 2 : 1;
  std::array<int, 3> most{};
  for (int i = 0; i < 3; ++i) {
    most[static_cast<std::size_t>(i)] = core.half_sizes[i] > 0 ? steps : 0;
  }
  std::vector<Eigen::Vector3d> points;
  for (int i = -most[0]; i <= most[0]; ++i) {
    for (int j = -most[1]; j <= most[1]; ++j) {
      for (int k = -most[2]; k <= most[2]; ++k) {
        const Eigen::Vector3d at = Eigen::Vector3d(i, j, k).cwiseProduct(core.half_sizes) / steps;
        points.emplace_back(core.placement.R * at + core.placement.p);
      }
    }
  }
  return points;
}

Mover mover(const Problem& problem, int pair, const InnerBody& core, const InnerBody& other,
            double reach) {
  Mover result{pair,
               core,
               other,
               reach - kDepth,
               reach + radius_of(core) + radius_of(other),
               relative_pose(problem, core.link, other.link),
               {},
               other.placement.inverse(),
               {},
               {},
               {}};
  if (!is_hull(core) && !is_hull(other)) {
    result.points = points_of(core);
    return result;
  }
  result.solid = solid_of(core);
  result.other_solid = solid_of(other);
  if (is_hull(other)) result.middle.p = result.other_solid.points.colwise().mean().transpose();
  return result;
}

using Movers = std::vector<Mover>;

class CollisionBound final : public Bound {
 public:
  CollisionBound(const Problem& problem, std::shared_ptr<const Movers> movers, int left_out)
      : problem_(problem),
        joints_(moved_joints(problem)),
        movers_(std::move(movers)),
        left_out_(left_out),
        centre_(problem.robot),
        q_(problem.contact ? problem.contact->q_rest : resting_joints(problem.robot)) {
    for (const Mover& mover : *movers_) corners_.emplace_back(mover.path);
  }

  double ceiling() const override { return kInfinity; }

  void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double /*low*/,
                double high, BoxProof& proof) override {
    proof.high = high;
    proof.axis = -1;
    place(lower, upper);
    nearest_ = -1;
    near_ = kLever * widest(lower, upper, left_out_);
    for (int i = 0; i < static_cast<int>(movers_->size()); ++i) {
      if (!collides(i, lower, upper)) continue;
      proof.kind = BoxProof::Kind::kCollision;
      proof.high = -kInfinity;
      proof.pair = (*movers_)[static_cast<std::size_t>(i)].pair;
      return;
    }
    if (nearest_ >= 0) proof.axis = cut(nearest_, lower, upper);
    if (left_out_ >= 0 && collides_at_middle(lower, upper)) proof.axis = left_out_;
  }

  std::unique_ptr<Bound> clone() const override {
    return std::make_unique<CollisionBound>(problem_, movers_, left_out_);
  }

 private:
  /// Moves everything to the centre of a box.
  void place(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      if (joints_[i] >= 0) q_[joints_[i]] = (lower[at] + upper[at]) / 2;
    }
    centre_.set_joints(q_);
  }

  /// Whether bodies collide throughout the box with the coordinate that is left out at its middle.
  bool collides_at_middle(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
    part_lower_ = lower;
    part_upper_ = upper;
    part_lower_[left_out_] = part_upper_[left_out_] = (lower[left_out_] + upper[left_out_]) / 2;
    place(part_lower_, part_upper_);
    for (int i = 0; i < static_cast<int>(movers_->size()); ++i) {
      if (collides(i, part_lower_, part_upper_)) return true;
    }
    return false;
  }

  /// A coordinate along which one half of the box collides, not much narrower than the widest one;
  /// -1 if there is none.
  int cut(int mover, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
    const double most = widest(lower, upper, left_out_);
    for (const int i : (*movers_)[static_cast<std::size_t>(mover)].path.coordinates().index) {
      if (i == left_out_ || upper[i] - lower[i] < kThinnest * most) continue;
      for (const bool second : {false, true}) {
        part_lower_ = lower;
        part_upper_ = upper;
        (second ? part_lower_ : part_upper_)[i] = (lower[i] + upper[i]) / 2;
        place(part_lower_, part_upper_);
        if (collides(mover, part_lower_, part_upper_)) return i;
      }
    }
    return -1;
  }

  /// Remembers the mover that comes nearest.
  void consider(int mover, double by) {
    if (!(by < near_)) return;
    near_ = by;
    nearest_ = mover;
  }

  /// Sets the points to try. They are within reach at the centre of the box; otherwise not all
  /// control points can be.
  void choose_points(int i) {
    tried_.clear();
    const Mover& mover = (*movers_)[static_cast<std::size_t>(i)];
    const Pose<double>& a = centre_.links()[static_cast<std::size_t>(mover.core.link)];
    const Pose<double>& b = centre_.links()[static_cast<std::size_t>(mover.other.link)];
    const Eigen::Vector3d between =
        a.R * mover.core.placement.p + a.p - (b.R * mover.other.placement.p + b.p);
    const double far = mover.far + std::max(near_, 0.0);
    if (between.squaredNorm() > far * far) return;
    const Pose<double> pose = mover.into * (b.inverse() * a);
    if (mover.points.empty()) return choose_closest(i, pose);
    double least = 0;
    for (const Eigen::Vector3d& x : mover.points) {
      const double by = beyond(mover.other.half_sizes, mover.reach, pose.R * x + pose.p);
      consider(i, by);
      if (by >= least) continue;
      least = by;
      tried_.assign(1, x);
    }
  }

  /// The point closest to the other core. Where the cores intersect, first the one closest to its
  /// middle, which is deeper.
  void choose_closest(int i, const Pose<double>& pose) {
    const Mover& mover = (*movers_)[static_cast<std::size_t>(i)];
    const Pose<double> at = pose * mover.core.placement;
    const double near = mover.reach + std::max(near_, 0.0);
    if (!closer_than(mover.solid, at, mover.other_solid, {}, near)) return;
    const Between between = closest_points(mover.solid, at, mover.other_solid, {});
    consider(i, between.distance() - mover.reach);
    const Pose<double> back = pose.inverse();
    if (between.distance() == 0) {
      const Eigen::Vector3d x = closest_points(mover.solid, at, {}, mover.middle).on_a;
      tried_.emplace_back(back.R * x + back.p);
    } else if (!(between.distance() < mover.reach)) {
      return;
    }
    tried_.emplace_back(back.R * between.on_a + back.p);
  }

  bool collides(int i, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
    choose_points(i);
    if (tried_.empty()) return false;
    const Mover& mover = (*movers_)[static_cast<std::size_t>(i)];
    if (!(spread(mover.path.coordinates(), lower, upper) <= kMostSpread)) return false;
    const Eigen::MatrixXd& P = corners_[static_cast<std::size_t>(i)].over(lower, upper);
    return std::any_of(tried_.begin(), tried_.end(),
                       [&](const Eigen::Vector3d& x) { return stays_close(mover, P, x); });
  }

  static bool stays_close(const Mover& mover, const Eigen::MatrixXd& P, const Eigen::Vector3d& x) {
    for (Eigen::Index v = 0; v < P.cols(); ++v) {
      const Eigen::Map<const Eigen::Matrix3d> R(P.col(v).data());
      const Eigen::Vector3d at = R * x + P.col(v).tail<3>();
      if (!(beyond(mover, mover.into.R * at + mover.into.p) < 0)) return false;
    }
    return true;
  }

  /// m per rad (or m per m): how far a body may move while a coordinate crosses half a box.
  static constexpr double kLever = 0.1;
  /// A share of the widest coordinate: narrower coordinates are not cut.
  static constexpr double kThinnest = 0.1;

  const Problem& problem_;
  const std::vector<int> joints_;
  std::shared_ptr<const Movers> movers_;
  const int left_out_;
  std::vector<ControlPoints> corners_;
  Kinematics<double> centre_;
  Eigen::VectorXd q_, part_lower_, part_upper_;
  std::vector<Eigen::Vector3d> tried_;  ///< points in the axes of their link
  double near_ = 0;                     ///< how near [m] the nearest mover came at the last centre
  int nearest_ = -1;  ///< the nearest mover; -1: none is as near as the box could bring it
};

/// `verify` finds its own point of the inner bodies. Without a reach, which of the points in both
/// of them is deep enough is a matter of luck.
bool has_proof_with_hull(const Problem& problem, const InnerBodyPair& bodies) {
  return bodies.reach > kDepth &&
         between_links(problem, bodies.a.link, bodies.b.link).points() <= kMostBesideHull;
}

}  // namespace

std::unique_ptr<Bound> make_collision_bound(const Problem& problem, std::optional<int> left_out) {
  const CollisionChecker* const checker = problem.robot.collision.get();
  auto movers = std::make_shared<Movers>();
  for (int pair = 0; checker != nullptr && pair < checker->pairs(); ++pair) {
    InnerBodyPair bodies;
    if (!checker->inner_bodies(pair, bodies)) continue;
    const bool a = is_segment(bodies.a), b = is_segment(bodies.b);
    const bool hull = is_hull(bodies.a) || is_hull(bodies.b);
    if (hull && !has_proof_with_hull(problem, bodies)) continue;
    if (hull || a || !b) movers->push_back(mover(problem, pair, bodies.a, bodies.b, bodies.reach));
    if (hull || b || !a) movers->push_back(mover(problem, pair, bodies.b, bodies.a, bodies.reach));
  }
  if (movers->empty()) return nullptr;
  return std::make_unique<CollisionBound>(problem, std::move(movers), left_out.value_or(-1));
}

}  // namespace maxwrench
