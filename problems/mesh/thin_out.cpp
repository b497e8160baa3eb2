#include "problems/mesh/thin_out.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace maxwrench {
namespace {

constexpr double kSame = 1e-6;  ///< of the extent: points that are nearer are one

using Cell = std::array<long, 3>;

Triangles merged(const Triangles& mesh, const Eigen::Vector3d& low, double size) {
  Triangles result{{}, {}, mesh.colour};
  std::map<Cell, int> index_of;
  std::vector<int> index(mesh.points.size()), count;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Eigen::Array<long, 3, 1> at =
        ((mesh.points[i] - low) / size).array().floor().cast<long>();
    const auto [entry, added] =
        index_of.emplace(Cell{at[0], at[1], at[2]}, static_cast<int>(result.points.size()));
    index[i] = entry->second;
    if (added) {
      result.points.push_back(mesh.points[i]);
      count.push_back(1);
    } else {
      const auto k = static_cast<std::size_t>(index[i]);
      result.points[k] += (mesh.points[i] - result.points[k]) / ++count[k];
    }
  }
  std::set<Cell> known;
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    const Eigen::Vector3i moved =
        triangle.unaryExpr([&index](int i) { return index[static_cast<std::size_t>(i)]; });
    Cell sorted{moved[0], moved[1], moved[2]};
    std::sort(sorted.begin(), sorted.end());
    if (sorted[0] == sorted[1] || sorted[1] == sorted[2] || !known.insert(sorted).second) continue;
    result.triangles.push_back(moved);
  }
  return result;
}

}  // namespace

Triangles thinned_out(const Triangles& mesh, std::size_t most) {
  if (mesh.points.empty()) return mesh;
  Eigen::Vector3d low = mesh.points.front(), high = low;
  for (const Eigen::Vector3d& x : mesh.points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double extent = std::max((high - low).maxCoeff(), 1e-12);
  Triangles result = merged(mesh, low, kSame * extent);
  // A surface through n^3 cells has some n^2 triangles.
  double cells = 1.5 * std::sqrt(static_cast<double>(most));
  for (; result.triangles.size() > most && cells > 1; cells *= 0.8) {
    result = merged(mesh, low, extent / cells);
  }
  return result;
}

}  // namespace maxwrench
