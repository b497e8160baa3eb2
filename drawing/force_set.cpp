#include "drawing/force_set.h"

#include <limits>
#include <stdexcept>

#include "lib/math/polygon.h"
#include "maxwrench/measure.h"
#include "maxwrench/problem.h"
#include "solvers/wrench_set/directions.h"

namespace maxwrench {
namespace {

/// The wrenches that span the outline.
Matrix6Xd outline_basis(const Problem& problem, Wrench wrench, View view) {
  if (wrench == Wrench::kAny) return problem.W_any;
  Matrix6Xd W = Matrix6Xd::Zero(6, 2);
  W.topRows<3>() = axes(view).transpose();
  return W;
}

}  // namespace

Eigen::Matrix<double, 2, 3> axes(View view) {
  Eigen::Matrix<double, 2, 3> result = Eigen::Matrix<double, 2, 3>::Zero();
  result(0, 0) = 1;
  result(1, view == View::kTop ? 1 : 2) = 1;
  return result;
}

bool in_view(const Vector6d& c, View view) {
  return std::abs((axes(view) * c.head<3>()).norm() - 1) < 1e-9;
}

ForceSet force_set(const Problem& problem, const Posture& posture, Measure& measure, Wrench wrench,
                   View view, bool curved, std::string name) {
  const Eigen::Matrix<double, 2, 3> P = axes(view);
  const Problem held = held_at(problem, posture.theta_r);
  if (!in_view(held.c, view)) {
    throw std::invalid_argument("plot: c of " + problem.name +
                                " is not a force in the plane of the picture");
  }
  ForceSet set;
  set.name = std::move(name);
  set.wrench = wrench;
  Capability capability;
  WrenchProgram along_c = make_wrench_program(problem, wrench);
  set_posture(posture, along_c);
  measure.evaluate(posture, along_c, false, capability);
  const bool has_value = capability.status == Status::kOptimal;
  set.beta = has_value ? capability.beta : std::numeric_limits<double>::quiet_NaN();
  if (has_value) set.h = P * capability.h.head<3>();

  WrenchProgram program = program_along(problem, posture, outline_basis(held, wrench, view));
  const Eigen::Index own = program.W.cols();
  const Support support =
      [&](const Eigen::Vector2d& d) -> std::optional<std::pair<double, Eigen::Vector2d>> {
    program.c_w.head(own) = program.W.topRows<3>().transpose() * (P.transpose() * d);
    measure.evaluate(posture, program, false, capability);
    if (capability.status != Status::kOptimal) return std::nullopt;
    return std::make_pair(capability.beta, Eigen::Vector2d(P * capability.h.head<3>()));
  };
  set.outline = polygon_from_support(support, curved ? 1e-4 : 1e-9);
  return set;
}

}  // namespace maxwrench
