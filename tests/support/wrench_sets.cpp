#include "tests/support/wrench_sets.h"

#include <map>

namespace maxwrench {
namespace {

using Eigen::Vector3d;

/// Each edge joins two faces, which pass it in opposite directions; V - E + F = 2.
void expect_closed(const WrenchSet& set) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& face : set.faces) {
    for (std::size_t i = 0; i < face.size(); ++i) ++edges[{face[i], face[(i + 1) % face.size()]}];
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  const auto faces = static_cast<Eigen::Index>(set.faces.size());
  EXPECT_EQ(set.vertices.cols() - static_cast<Eigen::Index>(edges.size()) / 2 + faces, 2);
}

/// Faces are counterclockwise from outside. Returns the volume as the sum over the facets of area
/// times distance from a vertex, over 3.
double expect_outward(const WrenchSet& set) {
  const Vector3d from = set.vertices.col(0);
  double volume = 0;
  Eigen::Index triangles = 0;
  for (std::size_t i = 0; i < set.faces.size(); ++i) {
    const auto& face = set.faces[i];
    const Vector3d normal = set.normals.col(static_cast<Eigen::Index>(i));
    Vector3d area = Vector3d::Zero();
    for (std::size_t j = 2; j < face.size(); ++j) {
      const Vector3d a = set.vertices.col(face[0]), b = set.vertices.col(face[j - 1]),
                     c = set.vertices.col(face[j]);
      area += (b - a).cross(c - a) / 2;
      EXPECT_EQ(set.triangles.col(triangles++), Eigen::Vector3i(face[0], face[j - 1], face[j]));
    }
    EXPECT_GT(normal.dot(area), 0);
    volume += area.dot(Vector3d(set.vertices.col(face[0])) - from) / 3;
  }
  EXPECT_EQ(triangles, set.triangles.cols());
  return volume;
}

/// The area of the polygon by its corners (k = 2 or 3).
double area_of(const WrenchSet& set) {
  Vector3d area = Vector3d::Zero();
  const auto at = [&](Eigen::Index i) {
    Vector3d x = Vector3d::Zero();
    x.head(set.vertices.rows()) = set.vertices.col(i) - set.vertices.col(0);
    return x;
  };
  for (Eigen::Index i = 2; i < set.vertices.cols(); ++i) area += at(i - 1).cross(at(i)) / 2;
  if (set.vertices.rows() == 2) return area.z();  // positive if counterclockwise
  return area.dot(Vector3d(set.flat_normals.col(0)));
}

}  // namespace

void expect_polytope(const WrenchSet& set) {
  ASSERT_EQ(set.status, Status::kOptimal) << set.reason.c_str();
  const Eigen::Index V = set.vertices.cols(), F = set.normals.cols(), k = set.vertices.rows();
  ASSERT_EQ(set.efforts.cols(), V);
  ASSERT_EQ(set.wrenches.cols(), V);
  ASSERT_EQ(set.offsets.size(), F);
  ASSERT_EQ(set.faces.size(), static_cast<std::size_t>(F));
  ASSERT_EQ(set.flat_normals.cols(), k - set.dimension);
  const double size = 1 + set.vertices.lpNorm<Eigen::Infinity>();
  for (Eigen::Index i = 0; i < F; ++i) {
    EXPECT_NEAR(set.normals.col(i).norm(), 1, 1e-12);
    const Eigen::VectorXd distance = set.vertices.transpose() * set.normals.col(i) -
                                     Eigen::VectorXd::Constant(V, set.offsets[i]);
    EXPECT_LE(distance.maxCoeff(), 1e-7 * size);
    for (const int j : set.faces[static_cast<std::size_t>(i)]) {
      EXPECT_NEAR(distance[j], 0, 1e-7 * size);
    }
  }
  for (Eigen::Index i = 0; i < set.flat_normals.cols(); ++i) {
    EXPECT_LE((set.vertices.transpose() * set.flat_normals.col(i)).maxCoeff(),
              set.flat_offsets[i] + 1e-7 * size);
    EXPECT_GE((set.vertices.transpose() * set.flat_normals.col(i)).minCoeff(),
              set.flat_offsets[i] - 1e-7 * size);
  }
  switch (set.dimension) {
    case 3:
      expect_closed(set);
      EXPECT_NEAR(expect_outward(set), set.volume, 1e-9 * set.volume);
      break;
    case 2:
      EXPECT_EQ(V, F);
      EXPECT_EQ(set.triangles.cols(), V - 2);
      EXPECT_NEAR(area_of(set), set.volume, 1e-9 * set.volume);
      break;
    case 1:
      EXPECT_EQ(V, 2);
      EXPECT_NEAR((set.vertices.col(1) - set.vertices.col(0)).norm(), set.volume,
                  1e-9 * set.volume);
      break;
    default:
      EXPECT_EQ(V, 1);
      EXPECT_EQ(F, 0);
      EXPECT_EQ(set.volume, 0);
  }
}

Stretch along(const WrenchSet& set, const Eigen::VectorXd& c) {
  Stretch interval{-kInfinity, kInfinity};
  const double size = 1 + set.vertices.lpNorm<Eigen::Infinity>();
  const auto cut = [&](double slope, double offset) {
    if (std::abs(slope) < 1e-12) {
      if (offset < -1e-7 * size) interval = {kInfinity, -kInfinity};
    } else if (slope > 0) {
      interval.max = std::min(interval.max, offset / slope);
    } else {
      interval.min = std::max(interval.min, offset / slope);
    }
  };
  for (Eigen::Index i = 0; i < set.normals.cols(); ++i) {
    cut(set.normals.col(i).dot(c), set.offsets[i]);
  }
  for (Eigen::Index i = 0; i < set.flat_normals.cols(); ++i) {
    const double slope = set.flat_normals.col(i).dot(c);
    cut(slope, set.flat_offsets[i]);
    cut(-slope, -set.flat_offsets[i]);
  }
  return interval;
}

double support_of(const WrenchSet& set, const Eigen::VectorXd& d) {
  return (set.vertices.transpose() * d).maxCoeff();
}

}  // namespace maxwrench
