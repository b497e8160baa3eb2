#include "lib/math/distance.h"

#include <algorithm>

namespace maxwrench {

Between segment_to_segment(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1,
                           const Eigen::Vector3d& b0, const Eigen::Vector3d& b1) {
  // The squared distance |r + s u - t v|^2 is convex in (s, t). Its minimum over the square is
  // either inside, at the closest points of the two lines, or on an edge, at an end point of one
  // segment.
  const Eigen::Vector3d u = a1 - a0, v = b1 - b0, r = a0 - b0;
  double best = kInfinity, best_s = 0, best_t = 0;
  const auto consider = [&](double s, double t) {
    const double squared = (r + s * u - t * v).squaredNorm();
    if (squared >= best) return;
    best = squared;
    best_s = s;
    best_t = t;
  };
  const auto along = [](const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
    const double squared = direction.squaredNorm();
    return squared > 0 ? std::clamp(-from.dot(direction) / squared, 0.0, 1.0) : 0.0;
  };
  consider(along(r, u), 0);
  consider(along(r - v, u), 1);
  consider(0, along(-r, v));
  consider(1, along(-r - u, v));
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
  const double determinant = uu * vv - uv * uv;
  if (determinant > 1e-12 * uu * vv) {  // if nearly parallel, an end point is as close, to 1e-6
    const double s = (uv * r.dot(v) - vv * r.dot(u)) / determinant;
    const double t = (uu * r.dot(v) - uv * r.dot(u)) / determinant;
    if (s > 0 && s < 1 && t > 0 && t < 1) consider(s, t);
  }
  return {a0 + best_s * u, b0 + best_t * v};
}

Between segment_to_box(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1,
                       const Eigen::Vector3d& half_sizes) {
  const Eigen::Vector3d v = p1 - p0;
  const auto inside = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return x.cwiseMax(-half_sizes).cwiseMin(half_sizes);
  };
  // Half the derivative of the squared distance along the segment. It is piecewise linear and
  // increasing; its breakpoints are where the segment crosses the plane of a face.
  const auto slope = [&](double t) {
    const Eigen::Vector3d x = p0 + t * v;
    return (x - inside(x)).dot(v);
  };
  double low = 0, high = 1;
  double slope_low = slope(low), slope_high = slope(high);
  if (slope_low >= 0) return {p0, inside(p0)};
  if (slope_high <= 0) return {p1, inside(p1)};
  for (int i = 0; i < 3; ++i) {
    if (v[i] == 0) continue;
    for (const double face : {-half_sizes[i], half_sizes[i]}) {
      const double t = (face - p0[i]) / v[i];
      if (!(t > low && t < high)) continue;
      const double slope_t = slope(t);
      (slope_t < 0 ? low : high) = t;
      (slope_t < 0 ? slope_low : slope_high) = slope_t;
    }
  }
  const Eigen::Vector3d x = p0 + (low + (high - low) * slope_low / (slope_low - slope_high)) * v;
  return {x, inside(x)};
}

}  // namespace maxwrench
