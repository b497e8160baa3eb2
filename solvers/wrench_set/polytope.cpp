#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "lib/math/quick_hull.h"
#include "maxwrench/interruption.h"
#include "solvers/wrench_set/boundary.h"
#include "solvers/wrench_set/frame.h"

namespace maxwrench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// In coordinates in which the set has the size of 1: a point counts as beyond a facet from here
/// on.
constexpr double kBeyond = 1e-9;
/// Likewise, a vertex of a facet is within this distance of it: the first of these with which the
/// facets close. Where facets nearly meet in one point, another tells them apart.
constexpr double kOn[] = {1e-8, 1e-7, 2e-9};

/// Grows a polytope from its support until each facet of the hull of the points is proven.
class PolytopeGrowth {
 public:
  PolytopeGrowth(const Problem& task, const Posture& posture, const WrenchSetOptions& options)
      : support_(task, posture, options), k_(options.E.cols()), most_(options.most_facets) {}

  WrenchSet run() {
    WrenchSet set;
    const auto frame = find_frame(support_, k_, points_);
    if (frame) frame_ = *frame;
    const bool grown = frame && (q() == 0 || grow());
    support_.report(set);
    if (grown && q() == 0) fill_point(set);
    if (grown && q() > 0) fill(set);
    if (!grown && set.status == Status::kOptimal) {
      set.conclude(Status::kBudgetExhausted,
                   "the set is not complete after " + std::to_string(most_) + " facets");
    }
    return set;
  }

 private:
  int q() const { return frame_.dimension(); }

  /// The hull of the points in coordinates y.
  Hull hull() const {
    Eigen::MatrixXd y(q(), static_cast<Eigen::Index>(y_.size()));
    for (std::size_t i = 0; i < y_.size(); ++i) {
      y.col(static_cast<Eigen::Index>(i)) = y_[i].head(q());
    }
    if (q() > 1) return quick_hull(y);
    Hull ends;
    for (const double sign : {-1.0, 1.0}) {
      Eigen::Index end = 0;
      (sign * y.row(0)).maxCoeff(&end);
      ends.facets.push_back({VectorXd::Constant(1, sign), {static_cast<int>(end)}});
    }
    return ends;
  }

  /// Whether the vertices of a facet lie on a half space that holds for the whole set.
  bool proven(const HullFacet& facet) const {
    return std::any_of(half_spaces_.begin(), half_spaces_.end(), [&](const HalfSpace& half_space) {
      return std::all_of(facet.vertices.begin(), facet.vertices.end(), [&](int i) {
        const Vector3d& y = y_[static_cast<std::size_t>(i)];
        return std::abs(half_space.normal.dot(y) - half_space.offset) <= kBeyond;
      });
    });
  }

  bool grow() {
    for (const SupportPoint& point : points_) y_.push_back(frame_.coordinates(point.f));
    for (std::size_t before = 0; before < y_.size();) {
      before = y_.size();
      const Hull found = hull();
      for (const HullFacet& facet : found.facets) {
        if (proven(facet)) continue;
        end_if_interrupted();
        if (static_cast<int>(half_spaces_.size()) == most_) return false;
        if (!push(facet, before)) return false;
      }
    }
    return true;
  }

  /// Solves the program along the normal of a facet. Keeps its half space, and its point if it is
  /// beyond the facet and not one of those found since `before`.
  bool push(const HullFacet& facet, std::size_t before) {
    const VectorXd d = frame_.to_frame.transpose() * facet.normal;
    const double length = d.norm();
    auto point = support_.farthest(d / length);
    if (!point) return false;
    HalfSpace half_space{Vector3d::Zero(), point->value * length - d.dot(frame_.origin)};
    half_space.normal.head(q()) = facet.normal;
    half_spaces_.push_back(half_space);
    directions_.push_back(d / length);
    values_.push_back(point->value);
    double reached = -kInfinity;
    for (const int i : facet.vertices) {
      reached = std::max(reached, half_space.normal.dot(y_[static_cast<std::size_t>(i)]));
    }
    const Vector3d y = frame_.coordinates(point->f);
    const bool known =
        std::any_of(y_.begin() + static_cast<std::ptrdiff_t>(before), y_.end(),
                    [&](const Vector3d& other) { return (y - other).norm() < kBeyond; });
    if (half_space.normal.dot(y) <= reached + kBeyond || known) return true;
    y_.push_back(y);
    points_.push_back(std::move(*point));
    return true;
  }

  void fill_point(WrenchSet& set) const {
    const SupportPoint& point = points_.front();
    set.vertices = point.f;
    set.efforts = point.u;
    set.wrenches = point.h;
    set.normals.resize(k_, 0);
    set.flat_normals = frame_.normals;
    set.flat_offsets = point.f;
  }

  void fill(WrenchSet& set) const {
    std::optional<Boundary> boundary;
    for (const double on : kOn) {
      if (!boundary) boundary = boundary_of(y_, half_spaces_, q(), on);
    }
    if (!boundary) {
      set.conclude(Status::kNumericalError, "the facets found do not close");
      return;
    }
    set.dimension = q();
    const auto V = static_cast<Eigen::Index>(boundary->vertices.size());
    const auto F = static_cast<Eigen::Index>(boundary->facets.size());
    set.vertices.resize(k_, V);
    set.efforts.resize(points_.front().u.size(), V);
    set.wrenches.resize(6, V);
    for (Eigen::Index i = 0; i < V; ++i) {
      const SupportPoint& point =
          points_[static_cast<std::size_t>(boundary->vertices[static_cast<std::size_t>(i)])];
      set.vertices.col(i) = point.f;
      set.efforts.col(i) = point.u;
      set.wrenches.col(i) = point.h;
    }
    set.normals.resize(k_, F);
    set.offsets.resize(F);
    for (Eigen::Index i = 0; i < F; ++i) {
      const auto facet = static_cast<std::size_t>(boundary->facets[static_cast<std::size_t>(i)]);
      set.normals.col(i) = directions_[facet];
      set.offsets[i] = values_[facet];
    }
    set.faces = boundary->faces;
    set.flat_normals = frame_.normals;
    set.flat_offsets = frame_.normals.transpose() * frame_.origin;
    fill_triangles(*boundary, set);
  }

  /// Triangles, as fans about the first vertex of each face, and the volume.
  void fill_triangles(const Boundary& boundary, WrenchSet& set) const {
    std::vector<std::vector<int>> polygons;
    if (q() == 3) polygons = boundary.faces;
    if (q() == 2) {
      polygons.emplace_back();
      for (const auto& edge : boundary.faces) polygons.front().push_back(edge.front());
    }
    std::vector<Eigen::Vector3i> triangles;
    for (const std::vector<int>& polygon : polygons) {
      for (std::size_t i = 2; i < polygon.size(); ++i) {
        triangles.emplace_back(polygon[0], polygon[i - 1], polygon[i]);
      }
    }
    const auto at = [&](int i) -> const Vector3d& {
      return y_[static_cast<std::size_t>(boundary.vertices[static_cast<std::size_t>(i)])];
    };
    set.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
    double volume = q() == 1 ? std::abs(at(1).x() - at(0).x()) : 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const Eigen::Vector3i& t = triangles[i];
      set.triangles.col(static_cast<Eigen::Index>(i)) = t;
      if (q() == 2) {
        volume += (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).z() / 2;
      } else {
        const Vector3d& from = at(0);
        volume += (at(t[0]) - from).dot((at(t[1]) - from).cross(at(t[2]) - from)) / 6;
      }
    }
    // The edges' own volume: that of the triangular factor, whose rounding a Gram matrix would
    // square.
    const Eigen::MatrixXd R = Eigen::HouseholderQR<Eigen::MatrixXd>(frame_.edges).matrixQR();
    set.volume = volume * std::abs(R.diagonal().prod());
  }

  WrenchSupport support_;
  Eigen::Index k_;
  int most_;
  AffineFrame frame_;
  std::vector<SupportPoint> points_;
  std::vector<Vector3d> y_;             ///< coordinates of the points
  std::vector<HalfSpace> half_spaces_;  ///< in coordinates y
  std::vector<VectorXd> directions_;    ///< their normals in coordinates f
  std::vector<double> values_;          ///< their offsets in coordinates f
};

}  // namespace

WrenchSet force_polytope(const Problem& task, const Posture& posture,
                         const WrenchSetOptions& options) {
  if (options.most_facets < 4) {
    throw std::invalid_argument("most_facets: got " + std::to_string(options.most_facets) +
                                ", expected 4 or more");
  }
  PolytopeGrowth growth(task, posture, options);
  WrenchSet set;
  if (posture.status == Status::kValid) return growth.run();
  static_cast<Verdict&>(set) = posture;
  return set;
}

}  // namespace maxwrench
