#include "solvers/wrench_set/frame.h"

#include <algorithm>

namespace maxwrench {
namespace {

/// A set that extends less than this times 1 + its largest coordinate along a direction is flat.
constexpr double kFlatExtent = 1e-9;

/// An orthonormal basis of the directions orthogonal to the columns of A (k×j).
Eigen::MatrixXd orthogonal_to(const Eigen::MatrixXd& A) {
  const Eigen::MatrixXd Q = Eigen::HouseholderQR<Eigen::MatrixXd>(A).householderQ();
  return Q.rightCols(A.rows() - A.cols());
}

/// Finds the ends of a set along the columns of `directions`: first the lower ones, then the upper
/// ones.
bool find_ends(WrenchSupport& support, const Eigen::MatrixXd& directions,
               std::vector<SupportPoint>& ends) {
  ends.clear();
  for (const double sign : {-1.0, 1.0}) {
    for (Eigen::Index i = 0; i < directions.cols(); ++i) {
      auto point = support.farthest(sign * directions.col(i));
      if (!point) return false;
      ends.push_back(std::move(*point));
    }
  }
  return true;
}

/// Makes the frame right-handed.
void orient(AffineFrame& frame) {
  const Eigen::Index k = frame.edges.rows(), q = frame.edges.cols();
  if (q == k && q > 1 && frame.edges.determinant() < 0) frame.edges.col(0).swap(frame.edges.col(1));
  if (q == 2 && k == 3) {
    const Eigen::Vector3d x = frame.edges.col(0), y = frame.edges.col(1);
    if (x.cross(y).dot(frame.normals.col(0)) < 0) frame.normals = -frame.normals;
  }
}

}  // namespace

Eigen::Vector3d AffineFrame::coordinates(const Eigen::VectorXd& f) const {
  Eigen::Vector3d y = Eigen::Vector3d::Zero();
  y.head(dimension()) = to_frame * (f - origin);
  return y;
}

std::optional<AffineFrame> find_frame(WrenchSupport& support, Eigen::Index k,
                                      std::vector<SupportPoint>& points) {
  AffineFrame frame;
  frame.edges.resize(k, 0);
  frame.normals = Eigen::MatrixXd::Identity(k, k);
  if (!find_ends(support, frame.normals, points)) return std::nullopt;
  double most = -1, size = 0;
  Eigen::VectorXd edge;
  for (Eigen::Index i = 0; i < k; ++i) {
    const Eigen::VectorXd& low = points[static_cast<std::size_t>(i)].f;
    const Eigen::VectorXd& high = points[static_cast<std::size_t>(i + k)].f;
    size = std::max({size, low.lpNorm<Eigen::Infinity>(), high.lpNorm<Eigen::Infinity>()});
    if (high[i] - low[i] <= most) continue;
    most = high[i] - low[i];
    frame.origin = low;
    edge = high - low;
  }
  std::vector<SupportPoint> ends;
  while (most > kFlatExtent * (1 + size)) {
    frame.edges.conservativeResize(Eigen::NoChange, frame.edges.cols() + 1);
    frame.edges.rightCols(1) = edge;
    frame.normals = orthogonal_to(frame.edges);
    if (!find_ends(support, frame.normals, ends)) return std::nullopt;
    most = 0;
    for (SupportPoint& end : ends) {
      const Eigen::VectorXd across = end.f - frame.origin;
      const double distance = (frame.normals.transpose() * across).norm();
      if (distance > most) {
        most = distance;
        edge = across;
      }
      points.push_back(std::move(end));
    }
  }
  if (frame.dimension() == 0) return frame;
  orient(frame);
  frame.to_frame = frame.edges.completeOrthogonalDecomposition().pseudoInverse();
  return frame;
}

}  // namespace maxwrench
