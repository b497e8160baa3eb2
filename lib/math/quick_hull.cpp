#include "lib/math/quick_hull.h"

#include <cstdio>
#include <memory>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace maxwrench {

Hull quick_hull(const Eigen::MatrixXd& points) {
  Hull hull;
  const auto d = static_cast<int>(points.rows()), n = static_cast<int>(points.cols());
  if (n <= d) return hull;
  // Qhull explains its failures at length.
  const std::unique_ptr<FILE, int (*)(FILE*)> nowhere(std::fopen("/dev/null", "w"), &std::fclose);
  if (!nowhere) return hull;
  Eigen::MatrixXd numbers = points;
  qhT state;
  qhT* qh = &state;
  qh_zero(qh, nowhere.get());
  char command[] = "qhull Pp";
  const int failed =
      qh_new_qhull(qh, d, n, numbers.data(), False, command, nowhere.get(), nowhere.get());
  if (failed == 0) {
    vertexT* vertex = nullptr;
    FORALLvertices hull.vertices.push_back(qh_pointid(qh, vertex->point));
    facetT* facet = nullptr;
    FORALLfacets {
      HullFacet next;
      next.normal = Eigen::Map<const Eigen::VectorXd>(facet->normal, d);
      vertexT** vertexp = nullptr;
      FOREACHvertex_(facet->vertices) next.vertices.push_back(qh_pointid(qh, vertex->point));
      hull.facets.push_back(std::move(next));
    }
  }
  qh_freeqhull(qh, !qh_ALL);
  int long_blocks = 0, long_bytes = 0;
  qh_memfreeshort(qh, &long_blocks, &long_bytes);
  return hull;
}

}  // namespace maxwrench
