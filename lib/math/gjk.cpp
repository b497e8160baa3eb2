#include "lib/math/gjk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace maxwrench {
namespace {

using Eigen::Vector3d;

/// GJK finds a distance in about ten steps. Cylinders, which are curved, need more.
constexpr int kMostIterations = 200;
/// A distance is known if its bounds differ by less than this, relative to it, plus the rounding
/// of the points.
constexpr double kRelative = 1e-13;
constexpr double kPointRounding = 4 * std::numeric_limits<double>::epsilon();

/// The row of the point farthest along d.
Eigen::Index farthest(const Eigen::Matrix<double, Eigen::Dynamic, 3>& points, const Vector3d& d) {
  const Eigen::Index count = points.rows();
  const double *x = points.data(), *y = x + count, *z = y + count;
  constexpr Eigen::Index kBlock = 64;
  std::array<double, kBlock> along;
  double most = -kInfinity;
  Eigen::Index row = 0;
  for (Eigen::Index begin = 0; begin < count; begin += kBlock) {
    const Eigen::Index size = std::min(kBlock, count - begin);
    double* const value = along.data();
    for (Eigen::Index i = 0; i < size; ++i) {
      value[i] = d[0] * x[begin + i] + d[1] * y[begin + i] + d[2] * z[begin + i];
    }
    const double best = Eigen::Map<const Eigen::VectorXd>(value, size).maxCoeff();
    if (!(best > most)) continue;
    most = best;
    row = begin + (std::find(value, value + size, best) - value);
  }
  return row;
}

/// The point of a core farthest along d, both in its own axes.
Vector3d support(const ConvexCore& core, const Vector3d& d) {
  if (core.points.rows() > 0) return core.points.row(farthest(core.points, d)).transpose();
  Vector3d x(std::copysign(core.half_sizes[0], d[0]), std::copysign(core.half_sizes[1], d[1]),
             std::copysign(core.half_sizes[2], d[2]));
  if (core.disc_radius > 0) {
    const double across = std::hypot(d[0], d[1]);
    if (across > 0) x.head<2>() += core.disc_radius / across * d.head<2>();
  }
  return x;
}

/// A point of the difference a - b, with the points of both that it comes from.
struct Corner {
  Vector3d w, on_a, on_b;
};

/// At most four corners, and the point v of their hull that is nearest to the origin: v is the sum
/// of weights times w. Every corner has a positive weight.
struct Simplex {
  std::array<Corner, 4> corners;
  std::array<double, 4> weights{};
  int size = 0;
  Vector3d v = Vector3d::Zero();
};

/// The best point so far among the hulls of some corners.
struct Nearest {
  double squared = kInfinity;
  std::array<double, 4> weights{};
  Vector3d v = Vector3d::Zero();

  /// The weights belong to the corners, and their sum is 1.
  void consider(const Simplex& simplex, const std::array<double, 4>& given) {
    Vector3d x = Vector3d::Zero();
    for (int i = 0; i < simplex.size; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (given[k] != 0) x += given[k] * simplex.corners[k].w;
    }
    const double s = x.squaredNorm();
    if (s >= squared) return;
    squared = s;
    weights = given;
    v = x;
  }
};

void consider_edge(const Simplex& simplex, std::size_t i, std::size_t j, Nearest& nearest) {
  const Vector3d &p = simplex.corners[i].w, u = simplex.corners[j].w - p;
  const double squared = u.squaredNorm();
  if (!(squared > 0)) return;
  const double t = -p.dot(u) / squared;
  if (!(t > 0 && t < 1)) return;
  std::array<double, 4> weights{};
  weights[i] = 1 - t;
  weights[j] = t;
  nearest.consider(simplex, weights);
}

void consider_triangle(const Simplex& simplex, std::size_t i, std::size_t j, std::size_t k,
                       Nearest& nearest) {
  const Vector3d& p = simplex.corners[i].w;
  const Vector3d u = simplex.corners[j].w - p, s = simplex.corners[k].w - p;
  const Vector3d normal = u.cross(s);
  const double squared = normal.squaredNorm();
  if (!(squared > 0)) return;
  // The foot of the origin on the plane is p + a u + b s.
  const double a = -p.cross(s).dot(normal) / squared, b = p.cross(u).dot(normal) / squared;
  if (!(a > 0 && b > 0 && a + b < 1)) return;
  std::array<double, 4> weights{};
  weights[i] = 1 - a - b;
  weights[j] = a;
  weights[k] = b;
  nearest.consider(simplex, weights);
}

/// Whether the origin is inside a simplex of four corners; if so, its weights.
bool origin_inside(const Simplex& simplex, std::array<double, 4>& weights) {
  const auto& c = simplex.corners;
  const Vector3d d = c[1].w - c[0].w, e = c[2].w - c[0].w, f = c[3].w - c[0].w;
  const double volume = d.dot(e.cross(f));
  if (volume == 0) return false;
  const Vector3d o = -c[0].w;
  const double a = o.dot(e.cross(f)) / volume, b = d.dot(o.cross(f)) / volume,
               g = d.dot(e.cross(o)) / volume;
  weights = {1 - a - b - g, a, b, g};
  return std::all_of(weights.begin(), weights.end(), [](double x) { return x >= 0; });
}

/// Sets v, and drops the corners that it does not need. The last corner is new, so the nearest
/// point lies on a face with this corner. Returns false if v comes no nearer than it was.
bool reduce(Simplex& simplex) {
  const auto last = static_cast<std::size_t>(simplex.size - 1);
  Nearest nearest;
  std::array<double, 4> inside{};
  if (simplex.size == 4 && origin_inside(simplex, inside)) {
    simplex.weights = inside;
    simplex.v.setZero();
    return true;
  }
  std::array<double, 4> alone{};
  alone[last] = 1;
  nearest.consider(simplex, alone);
  for (std::size_t i = 0; i < last; ++i) {
    consider_edge(simplex, i, last, nearest);
    for (std::size_t j = 0; j < i; ++j) consider_triangle(simplex, j, i, last, nearest);
  }
  if (simplex.size > 1 && !(nearest.squared < simplex.v.squaredNorm())) return false;
  simplex.v = nearest.v;
  int kept = 0;
  for (int i = 0; i < simplex.size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (nearest.weights[k] == 0) continue;
    simplex.corners[static_cast<std::size_t>(kept)] = simplex.corners[k];
    simplex.weights[static_cast<std::size_t>(kept++)] = nearest.weights[k];
  }
  simplex.size = kept;
  return true;
}

/// What is wanted of the distance.
enum class Nearness { kNear, kFar, kClosest };

/// Minimises |v| over a - b by the algorithm of Gilbert, Johnson and Keerthi. It stops as soon as
/// the distance is known to be below or above `reach`, or, if `reach` is negative, when the
/// closest points are known.
Nearness gjk(const ConvexCore& a, const Pose<double>& pose_a, const ConvexCore& b,
             const Pose<double>& pose_b, double reach, Simplex& simplex) {
  simplex.v = pose_a.p - pose_b.p;
  if (simplex.v.isZero(0)) simplex.v = Vector3d::UnitX();
  double size = 0;  // of the points in use, which their rounding is relative to
  for (int step = 0; step < kMostIterations; ++step) {
    const Vector3d d = -simplex.v;
    Corner corner;
    corner.on_a = pose_a.R * support(a, pose_a.R.transpose() * d) + pose_a.p;
    corner.on_b = pose_b.R * support(b, pose_b.R.transpose() * simplex.v) + pose_b.p;
    corner.w = corner.on_a - corner.on_b;
    // v.w / |v| is a lower bound of the distance.
    const double squared = simplex.v.squaredNorm(), least = simplex.v.dot(corner.w);
    if (reach >= 0 && least > 0 && least * least > reach * reach * squared) return Nearness::kFar;
    size = std::max({size, corner.on_a.cwiseAbs().maxCoeff(), corner.on_b.cwiseAbs().maxCoeff()});
    const double rounding = kPointRounding * size;
    const double known = kRelative * squared + rounding * std::sqrt(squared);
    if (simplex.size > 0 && squared - least <= known) break;
    simplex.corners[static_cast<std::size_t>(simplex.size++)] = corner;
    if (!reduce(simplex)) {
      --simplex.size;
      break;
    }
    const double reached = simplex.v.squaredNorm();
    if (reached <= rounding * rounding) {
      simplex.v.setZero();
      break;
    }
    if (reach >= 0 && reached < reach * reach) return Nearness::kNear;
  }
  if (reach < 0) return Nearness::kClosest;
  return simplex.v.isZero(0) || simplex.v.squaredNorm() < reach * reach ? Nearness::kNear
                                                                        : Nearness::kFar;
}

}  // namespace

bool closer_than(const ConvexCore& a, const Pose<double>& pose_a, const ConvexCore& b,
                 const Pose<double>& pose_b, double reach) {
  Simplex simplex;
  return gjk(a, pose_a, b, pose_b, reach, simplex) == Nearness::kNear;
}

Between closest_points(const ConvexCore& a, const Pose<double>& pose_a, const ConvexCore& b,
                       const Pose<double>& pose_b) {
  Simplex simplex;
  gjk(a, pose_a, b, pose_b, -1, simplex);
  Between between{Vector3d::Zero(), Vector3d::Zero()};
  for (int i = 0; i < simplex.size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    between.on_a += simplex.weights[k] * simplex.corners[k].on_a;
    between.on_b += simplex.weights[k] * simplex.corners[k].on_b;
  }
  if (simplex.v.isZero(0)) between.on_b = between.on_a;
  return between;
}

Vector3d point_near(const ConvexCore& core, const Vector3d& x, double reach) {
  Pose<double> at_x;
  at_x.p = x;
  Simplex simplex;
  gjk({}, at_x, core, {}, reach, simplex);
  Vector3d near = Vector3d::Zero();
  double sum = 0;
  for (int i = 0; i < simplex.size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    near += simplex.weights[k] * simplex.corners[k].on_b;
    sum += simplex.weights[k];
  }
  return near / sum;  // NaN if there is no corner: x is out of reach
}

}  // namespace maxwrench
