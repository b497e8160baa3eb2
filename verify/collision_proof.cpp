#include "verify/collision_proof.h"

#include <algorithm>

namespace maxwrench {
namespace {

/// An upper bound of the distance [m] by which x is beyond the reach of a box; negative within the
/// reach. Convex in x.
double beyond(const std::array<Narrow, 3>& x, const Eigen::Vector3d& half_sizes, double reach) {
  double most = -kInfinity;
  Narrow square;
  for (std::size_t i = 0; i < 3; ++i) {
    const double out = Narrow::above(x[i].magnitude() - half_sizes[static_cast<Eigen::Index>(i)]);
    if (!(out < kInfinity)) return kInfinity;  // or NaN
    most = std::max(most, out);
    if (out > 0) square += Narrow(out) * Narrow(out);
  }
  return Narrow::above((most <= 0 ? most : root_above(square.high)) - reach);
}

bool is_thin(const InnerBody& core) { return (core.half_sizes.array() > 0).count() <= 1; }

/// The corners of a box and the points midway between them. For a segment, the points at its
/// quarters.
std::vector<Eigen::Vector3d> points_of(const InnerBody& core) {
  const int steps = is_thin(core) ? 2 : 1;
  const auto most = [&](int axis) { return core.half_sizes[axis] > 0 ? steps : 0; };
  std::vector<Eigen::Vector3d> points;
  for (int i = -most(0); i <= most(0); ++i) {
    for (int j = -most(1); j <= most(1); ++j) {
      for (int k = -most(2); k <= most(2); ++k) {
        points.push_back(Eigen::Vector3d(i, j, k).cwiseProduct(core.half_sizes) / steps);
      }
    }
  }
  return points;
}

/// The points whose convex hull a core is, in its axes.
std::vector<Eigen::Vector3d> solid_corners(const InnerBody& core) {
  if (!core.points.empty()) return core.points;
  std::vector<Eigen::Vector3d> corners;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) {
        corners.push_back(Eigen::Vector3d(x, y, z).cwiseProduct(core.half_sizes));
      }
    }
  }
  return corners;
}

/// Whether some row has a term of a variable other than 1.
bool moves(const FormShape& shape, std::size_t variable,
           const std::vector<std::array<FormRow, 3>>& points) {
  for (const std::array<FormRow, 3>& point : points) {
    for (const FormRow& row : point) {
      for (const int index : row.index) {
        if (shape.digit(index, variable) != 0) return true;
      }
    }
  }
  return false;
}

/// Subtracted from the reach, because points are moved into link axes with rounded numbers.
constexpr double kHair = 1e-9;

/// A box of a pair with a hull is cut into this many parts at most, cuts included.
constexpr int kMostParts = 1000;

}  // namespace

bool CollisionProof::collides(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                              int pair) {
  const CollisionChecker* const checker = problem_.robot.collision.get();
  if (checker == nullptr || pair < 0 || pair >= checker->pairs()) return false;
  const std::vector<Movers>& both = movers(pair);
  if (!both.empty() && !both[0].solid.empty()) {
    int left = kMostParts;
    return with_hull_in_parts(lower, upper, both, left);
  }
  set_products(model_.shape(), (lower + upper) / 2, terms_);
  for (const Movers& each : both) {
    if (!set_box(lower, upper, each)) continue;
    for (const auto& point : each.points) {
      if (may_be_close(each, point) && is_close(each, point)) return true;
    }
  }
  return false;
}

/// Of coordinates that move no point any value will do. Their boxes may be too wide to enclose.
bool CollisionProof::set_box(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                             const Movers& movers) {
  lower_ = lower;
  upper_ = upper;
  lower_(movers.others).setZero();
  upper_(movers.others).setZero();
  return box_.set(lower_, upper_);
}

const std::vector<CollisionProof::Movers>& CollisionProof::movers(int pair) {
  const auto found = known_.find(pair);
  if (found != known_.end()) return found->second;
  std::vector<Movers>& both = known_[pair];
  InnerBodyPair bodies;
  if (problem_.robot.collision->inner_bodies(pair, bodies)) {
    both.push_back(movers(bodies.a, bodies.b, bodies.reach));
    both.push_back(movers(bodies.b, bodies.a, bodies.reach));
  }
  return both;
}

CollisionProof::Movers CollisionProof::movers(const InnerBody& core, const InnerBody& other,
                                              double reach) const {
  Movers result;
  result.half_sizes = other.half_sizes;
  result.reach = reach - kHair;
  const auto add = [&](const Eigen::Vector3d& x, bool point) {
    const FormVector seen = model_.seen(core.link, model_.constant(x), other.link, point);
    const FormVector in_core = point ? model_.into(other.placement, seen)
                                     : transposed(model_.matrix(other.placement.R)) * seen;
    const std::vector<double>& far = model_.far();
    result.points.push_back(
        {FormRow(in_core[0], far), FormRow(in_core[1], far), FormRow(in_core[2], far)});
  };
  result.into_hull = !other.points.empty();
  if (result.into_hull || !core.points.empty()) {
    for (const Eigen::Vector3d& x : solid_corners(core)) {
      result.solid.push_back(core.placement.R * x + core.placement.p);
    }
    result.other_solid = solid_corners(other);
    add(Eigen::Vector3d::Zero(), true);
    for (int i = 0; i < 3; ++i) add(Eigen::Vector3d::Unit(i), false);
  } else {
    for (const Eigen::Vector3d& x : points_of(core)) {
      add(core.placement.R * x + core.placement.p, true);
    }
  }
  const FormShape& shape = model_.shape();
  for (std::size_t i = 0; i < shape.terms.size(); ++i) {
    (moves(shape, i, result.points) ? result.moving : result.others)
        .push_back(shape.coordinates[i]);
  }
  return result;
}

/// Whether the bodies collide throughout the box, or throughout each of its halves, and so on.
bool CollisionProof::with_hull_in_parts(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                                        const std::vector<Movers>& both, int& left) {
  if (--left < 0) return false;
  const Answer answer = with_hull(lower, upper, both);
  if (answer != Answer::kUnknown) return answer == Answer::kYes;
  int widest = -1;
  for (const int i : both[0].moving) {
    if (widest < 0 || upper[i] - lower[i] > upper[widest] - lower[widest]) widest = i;
  }
  if (widest < 0) return false;
  const double middle = (lower[widest] + upper[widest]) / 2;
  if (!(middle > lower[widest] && middle < upper[widest])) return false;
  Eigen::VectorXd end = upper, start = lower;
  end[widest] = start[widest] = middle;
  return with_hull_in_parts(lower, end, both, left) && with_hull_in_parts(start, upper, both, left);
}

CollisionProof::Answer CollisionProof::with_hull(const Eigen::VectorXd& lower,
                                                 const Eigen::VectorXd& upper,
                                                 const std::vector<Movers>& both) {
  set_products(model_.shape(), (lower + upper) / 2, terms_);
  bool near = false;
  for (const Movers& each : both) {
    const std::vector<Eigen::Vector3d> points = choose_points(each);
    if (points.empty()) continue;
    near = true;
    if (!set_box(lower, upper, each)) continue;
    for (const Eigen::Vector3d& x : points) {
      if (stays_close(each, x)) return Answer::kYes;
    }
  }
  return near ? Answer::kUnknown : Answer::kNo;
}

/// Points of a core, in the axes of its link: the one nearest to the middle of the other core's
/// corners, and the one nearest to the other core, at the centre of the box. None if the cores are
/// out of reach there. In ordinary arithmetic: any point will do.
std::vector<Eigen::Vector3d> CollisionProof::choose_points(const Movers& movers) const {
  Pose<double> pose;
  for (int i = 0; i < 3; ++i) {
    const auto row = static_cast<std::size_t>(i);
    pose.p[i] = value_near(movers.points[0][row], terms_);
    for (int j = 0; j < 3; ++j) {
      pose.R(i, j) = value_near(movers.points[static_cast<std::size_t>(j + 1)][row], terms_);
    }
  }
  std::vector<Eigen::Vector3d> placed;
  for (const Eigen::Vector3d& x : movers.solid) placed.emplace_back(pose.R * x + pose.p);
  const NearestMeans nearest = nearest_means(placed, movers.other_solid);
  const double apart = (nearest.a.of(placed) - nearest.b.of(movers.other_solid)).norm();
  if (!(apart - 2 * kHair < movers.reach)) return {};
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& x : movers.other_solid) middle += x;
  middle /= static_cast<double>(movers.other_solid.size());
  const Eigen::Vector3d deep = nearest_means(placed, {middle}).a.of(movers.solid);
  return {nearest.a.of(movers.solid), deep};
}

/// Control points that differ in coordinates that move nothing are the same.
bool CollisionProof::stays_close(const Movers& movers, const Eigen::Vector3d& x) {
  const FormShape& shape = model_.shape();
  for (std::size_t i = 0; i < 3; ++i) {
    x_[i].assign(static_cast<std::size_t>(shape.size), 0.0);
    add_to(x_[i], movers.points[0][i], 1.0);
    for (std::size_t k = 0; k < 3; ++k) {
      add_to(x_[i], movers.points[k + 1][i], x[static_cast<Eigen::Index>(k)]);
    }
    box_.over_box(x_[i]);
  }
  std::vector<std::size_t> still;
  for (std::size_t i = 0; i < shape.terms.size(); ++i) {
    if (std::count(movers.others.begin(), movers.others.end(), shape.coordinates[i])) {
      still.push_back(i);
    }
  }
  for (std::size_t v = 0; v < x_[0].size(); ++v) {
    const auto repeats = [&](std::size_t i) { return shape.digit(static_cast<int>(v), i) != 0; };
    if (std::any_of(still.begin(), still.end(), repeats)) continue;
    const std::array<Narrow, 3> at = {x_[0][v], x_[1][v], x_[2][v]};
    const bool near = movers.into_hull ? is_near_hull(movers, at)
                                       : beyond(at, movers.half_sizes, movers.reach) < 0;
    if (!near) return false;
  }
  return true;
}

/// Whether x is within reach of a mean of the hull's points. Any mean will do: first the last one.
bool CollisionProof::is_near_hull(const Movers& movers, const std::array<Narrow, 3>& x) {
  const auto is_near = [&](const WeightedMean& mean) {
    Narrow weights;
    std::array<Narrow, 3> sum;
    for (std::size_t k = 0; k < mean.size; ++k) {
      if (!(mean.weight[k] > 0)) return false;
      weights += mean.weight[k];
      const Eigen::Vector3d& corner = movers.other_solid[mean.index[k]];
      for (std::size_t i = 0; i < 3; ++i) {
        sum[i] += mean.weight[k] * Narrow(corner[static_cast<Eigen::Index>(i)]);
      }
    }
    if (!(weights.low > 0)) return false;
    Narrow square;
    for (std::size_t i = 0; i < 3; ++i) {
      const double apart = (x[i] - sum[i] / weights).magnitude();
      if (!(apart < kInfinity)) return false;  // or NaN
      square += Narrow(apart) * Narrow(apart);
    }
    return root_above(square.high) < movers.reach;
  };
  const auto fits = [&](std::size_t index) { return index < movers.other_solid.size(); };
  if (std::all_of(mean_.index.begin(), mean_.index.end(), fits) && is_near(mean_)) return true;
  const Eigen::Vector3d middle((x[0].low + x[0].high) / 2, (x[1].low + x[1].high) / 2,
                               (x[2].low + x[2].high) / 2);
  mean_ = nearest_means({middle}, movers.other_solid).b;
  return is_near(mean_);
}

/// Whether the point is close at the centre of the box, without an enclosure. Only then a proof is
/// attempted.
bool CollisionProof::may_be_close(const Movers& movers, const std::array<FormRow, 3>& point) const {
  std::array<Narrow, 3> x;
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = value_near(point[i], terms_);
  }
  return beyond(x, movers.half_sizes, movers.reach) < 0;
}

bool CollisionProof::is_close(const Movers& movers, const std::array<FormRow, 3>& point) {
  for (std::size_t i = 0; i < 3; ++i) {
    x_[i].assign(static_cast<std::size_t>(model_.shape().size), 0.0);
    add_to(x_[i], point[i], 1.0);
    box_.over_box(x_[i]);
  }
  for (std::size_t v = 0; v < x_[0].size(); ++v) {
    const std::array<Narrow, 3> x = {x_[0][v], x_[1][v], x_[2][v]};
    if (!(beyond(x, movers.half_sizes, movers.reach) < 0)) return false;
  }
  return true;
}

}  // namespace maxwrench
