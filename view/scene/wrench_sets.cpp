#include <set>
#include <stdexcept>

#include "maxwrench/wrench_set.h"
#include "solvers/solve/format.h"
#include "view/scene/parts.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

/// A torque or force below this share of c is rounding.
constexpr double kNone = 1e-9;

/// The row of the force or of the torque; -1 if c is both.
int first_row(const Vector6d& c) {
  if (c.tail<3>().norm() < kNone) return 0;
  return c.head<3>().norm() < kNone ? 3 : -1;
}

/// The forces or torques without any other component that do work: in a plane, those along it.
/// Others have no limit.
Matrix6Xd working_directions(const Problem& task, const Posture& posture, int row) {
  Matrix6Xd W = task.W_any;
  for (auto wrench : W.colwise()) {
    wrench.head<3>() = posture.turn * wrench.head<3>();
    wrench.tail<3>() = posture.turn * wrench.tail<3>();
  }
  // W is orthonormal: W W' e = e where e is one of its wrenches.
  const Eigen::Matrix3d shares = W.middleRows<3>(row) * W.middleRows<3>(row).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(shares);
  const Eigen::Index count = (solver.eigenvalues().array() > 1 - kNone).count();
  Matrix6Xd E = Matrix6Xd::Zero(6, count);
  E.middleRows<3>(row) = solver.eigenvectors().rightCols(count);
  return E;
}

/// Each edge of the set once, as two indices of vertices.
ordered_json edges_of(const WrenchSet& set) {
  std::set<std::pair<int, int>> edges;
  for (const std::vector<int>& face : set.faces) {
    for (std::size_t i = 0; i < face.size(); ++i) {
      const int a = face[i], b = face[(i + 1) % face.size()];
      if (a != b) edges.emplace(std::min(a, b), std::max(a, b));
    }
  }
  ordered_json list = ordered_json::array();
  for (const auto& [a, b] : edges) {
    list.push_back(a);
    list.push_back(b);
  }
  return list;
}

/// Calls `set_along` with all directions and, if the set has no end, with those that do work.
template <class SetAlong>
auto bounded_set(const Problem& task, const Posture& posture, int row, const SetAlong& set_along,
                 Matrix6Xd& E) {
  E = Matrix6Xd::Identity(6, 6).middleCols(row, 3);
  auto set = set_along(E);
  if (set.status != Status::kUnbounded) return set;
  E = working_directions(task, posture, row);
  return E.cols() > 0 ? set_along(E) : set;
}

ordered_json polytope_json(const Problem& task, const Posture& posture, int row,
                           const Case& choice) {
  Matrix6Xd E;
  const WrenchSet set = bounded_set(
      task, posture, row,
      [&](const Matrix6Xd& along) {
        WrenchSetOptions options;
        options.E = along;
        options.wrench = choice.wrench;
        if (choice.measure == "l2_polytope") options.measure = choice.measure;
        return force_polytope(task, posture, options);
      },
      E);
  if (set.status != Status::kOptimal) return nullptr;
  const Eigen::MatrixXi triangles = set.triangles;
  return {{"vertices", drawn_columns(E.middleRows<3>(row) * set.vertices)},
          {"triangles", std::vector<int>(triangles.data(), triangles.data() + triangles.size())},
          {"edges", edges_of(set)}};
}

ordered_json ellipsoid_json(const Problem& task, const Posture& posture, int row, Wrench wrench) {
  Matrix6Xd E;
  const WrenchEllipsoid set = bounded_set(
      task, posture, row,
      [&](const Matrix6Xd& along) { return force_ellipsoid(task, posture, along, wrench); }, E);
  if (set.status != Status::kOptimal) return nullptr;
  return {{"centre", drawn_columns(E.middleRows<3>(row) * set.centre)},
          {"axes", drawn_columns(E.middleRows<3>(row) * set.axes)},
          {"radii", drawn_columns(set.radii)}};
}

/// Null if the robot or its contact does not have such a set.
template <class Make>
ordered_json if_supported(const Make& make) {
  try {
    return make();
  } catch (const std::invalid_argument&) {
    return nullptr;
  }
}

}  // namespace

ordered_json wrench_sets_json(const Problem& task, const Posture& posture, const Case& choice) {
  const int row = first_row(task.c);
  if (row < 0) return nullptr;
  ordered_json sets;
  sets["of"] = row == 0 ? "force" : "torque";
  sets["polytope"] = if_supported([&] { return polytope_json(task, posture, row, choice); });
  sets["ellipsoid"] =
      if_supported([&] { return ellipsoid_json(task, posture, row, choice.wrench); });
  const bool none = sets["polytope"].is_null() && sets["ellipsoid"].is_null();
  return none ? ordered_json(nullptr) : sets;
}

}  // namespace maxwrench
