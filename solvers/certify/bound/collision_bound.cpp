#include <algorithm>
#include <array>
#include <cmath>

#include "lib/robot/chain.h"
#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/bound/exact_posture.h"

namespace maxwrench {
namespace {

/// The depth [m] within reach that the whole box must have. It exceeds the rounding errors of
/// collision checks.
constexpr double kDepth = 1e-6;

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
/// midpoints.
struct Mover {
  int pair;
  InscribedBox core, other;
  double reach;
  double far;  ///< centres farther apart than this are out of reach
  MultiAffine path;
  std::vector<Eigen::Vector3d> points;  ///< in the axes of their link
  Pose<double> into;                    ///< the other's link -> its core
};

bool is_segment(const InscribedBox& core) { return (core.half_sizes.array() > 0).count() <= 1; }

std::vector<Eigen::Vector3d> points_of(const InscribedBox& core) {
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

Mover mover(const Problem& problem, int pair, const InscribedBox& core, const InscribedBox& other,
            double reach) {
  return {pair,
          core,
          other,
          reach - kDepth,
          reach + core.half_sizes.norm() + other.half_sizes.norm(),
          relative_pose(problem, core.link, other.link),
          points_of(core),
          other.placement.inverse()};
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

  /// The point that is deepest within reach at the centre of the box. Null if no point is within
  /// reach; then not all control points can be. Remembers the mover that comes nearest.
  const Eigen::Vector3d* deepest(int i) {
    const Mover& mover = (*movers_)[static_cast<std::size_t>(i)];
    const Pose<double>& a = centre_.links()[static_cast<std::size_t>(mover.core.link)];
    const Pose<double>& b = centre_.links()[static_cast<std::size_t>(mover.other.link)];
    const Eigen::Vector3d between =
        a.R * mover.core.placement.p + a.p - (b.R * mover.other.placement.p + b.p);
    const double far = mover.far + std::max(near_, 0.0);
    if (between.squaredNorm() > far * far) return nullptr;
    const Pose<double> pose = mover.into * (b.inverse() * a);
    const Eigen::Vector3d* found = nullptr;
    double least = 0;
    for (const Eigen::Vector3d& x : mover.points) {
      const double by = beyond(mover.other.half_sizes, mover.reach, pose.R * x + pose.p);
      if (by < near_) {
        near_ = by;
        nearest_ = i;
      }
      if (by >= least) continue;
      least = by;
      found = &x;
    }
    return found;
  }

  bool collides(int i, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
    const Eigen::Vector3d* const x = deepest(i);
    if (x == nullptr) return false;
    const Mover& mover = (*movers_)[static_cast<std::size_t>(i)];
    if (!(spread(mover.path.coordinates(), lower, upper) <= kMostSpread)) return false;
    const Eigen::MatrixXd& P = corners_[static_cast<std::size_t>(i)].over(lower, upper);
    for (Eigen::Index v = 0; v < P.cols(); ++v) {
      const Eigen::Map<const Eigen::Matrix3d> R(P.col(v).data());
      const Eigen::Vector3d at = R * *x + P.col(v).tail<3>();
      const Eigen::Vector3d in_core = mover.into.R * at + mover.into.p;
      if (beyond(mover.other.half_sizes, mover.reach, in_core) >= 0) return false;
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
  double near_ = 0;   ///< how near [m] the nearest mover came at the last centre
  int nearest_ = -1;  ///< the nearest mover; -1: none is as near as the box could bring it
};

}  // namespace

std::unique_ptr<Bound> make_collision_bound(const Problem& problem, std::optional<int> left_out) {
  const CollisionChecker* const checker = problem.robot.collision.get();
  auto movers = std::make_shared<Movers>();
  for (int pair = 0; checker != nullptr && pair < checker->pairs(); ++pair) {
    InscribedBoxPair inscribed_boxes;
    if (!checker->inscribed_boxes(pair, inscribed_boxes)) continue;
    const bool a = is_segment(inscribed_boxes.a), b = is_segment(inscribed_boxes.b);
    if (a || !b)
      movers->push_back(
          mover(problem, pair, inscribed_boxes.a, inscribed_boxes.b, inscribed_boxes.reach));
    if (b || !a)
      movers->push_back(
          mover(problem, pair, inscribed_boxes.b, inscribed_boxes.a, inscribed_boxes.reach));
  }
  if (movers->empty()) return nullptr;
  return std::make_unique<CollisionBound>(problem, std::move(movers), left_out.value_or(-1));
}

}  // namespace maxwrench
