#include "solvers/certify/bound/loop_model.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace maxwrench {
namespace {

Coordinates part_of_chain(const Coordinates& chain, int from, int to) {
  Coordinates some;
  some.index.assign(chain.index.begin() + from, chain.index.begin() + to);
  some.turns.assign(chain.turns.begin() + from, chain.turns.begin() + to);
  return some;
}

}  // namespace

LoopModel::LoopModel(const Problem& problem, ContactForces forces, std::optional<int> left_out)
    : coordinates(problem, forces, left_out), n(problem.robot.velocities()), problem_(problem) {
  require_few_control_points(problem.name, coordinates.chain);
  size = coordinates.chain.points();
  tau = a = Eigen::VectorXd::Zero(n);
  LoopPosture posture(problem, coordinates);
  if (forces == ContactForces::kOfBase) add_levers(posture);
  add_loads(posture);
  add_joints(posture);
  add_equations(posture);
}

void LoopModel::add_part(Kind kind, int from, int to, const std::vector<int>& rows,
                         const MultiAffine::Sample& sample) {
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(coordinates.lower.size());
  LoopPart part{kind, MultiAffine(part_of_chain(coordinates.chain, from, to), rest, sample), from,
                rows, coordinates.chain.points(to)};
  const Eigen::VectorXd S = part.f.magnitudes(coordinates.lower, coordinates.upper);
  const auto count = static_cast<Eigen::Index>(rows.size());
  if (kind == Kind::kEquations) {
    f(rows) += S;
  } else {
    tau(rows) += S.head(count);
    if (kind == Kind::kLoads) a(rows) += S.tail(count);
  }
  parts.push_back(std::move(part));
}

void LoopModel::add_levers(LoopPosture& posture) {
  levers.emplace(part_of_chain(coordinates.chain, 0, coordinates.second.to),
                 Eigen::VectorXd::Zero(coordinates.lower.size()), [&](const ExtendedVector& x) {
                   posture.set(x);
                   return ExtendedVector(posture.levers().reshaped());
                 });
}

/// Rows of the base's linear axes depend on the yaw only, or on the stretch from the yaw to the
/// free coordinates if the wrench turns with the pose. The other rows of the base, those of joints
/// outside the chain, and the linear axes of a dependent base depend on everything up to the free
/// coordinates. The contact forces depend on the whole chain.
void LoopModel::add_loads(LoopPosture& posture) {
  const Robot& robot = problem_.robot;
  const auto axes = static_cast<int>(robot.base_axes.size());
  std::vector<int> pushed, others;
  for (int i = 0; i < static_cast<int>(n); ++i) {
    const bool slides = i < axes && robot.base_axes[static_cast<std::size_t>(i)] < 3;
    if (slides && levers) continue;  // they determine the contact's force
    if (slides && !coordinates.base_is_dependent) {
      pushed.push_back(i);
    } else if (coordinates.resting != i - axes &&
               std::find(coordinates.joints.begin(), coordinates.joints.end(), i - axes) ==
                   coordinates.joints.end()) {
      others.push_back(i);
    }
  }
  if (coordinates.resting) {
    dropped = pushed;
    dropped.insert(dropped.end(), others.begin(), others.end());
    return;
  }
  const auto add = [&](int from, int to, const std::vector<int>& rows) {
    if (rows.empty()) return;
    add_part(Kind::kLoads, from, to, rows, [&](const ExtendedVector& x) {
      posture.set(x);
      ExtendedVector values(2 * static_cast<Eigen::Index>(rows.size()));
      values << posture.loads().head(n)(rows), posture.loads().tail(n)(rows);
      if (levers) {
        const MatrixX<Extended> A = posture.levers()(rows, Eigen::all);
        values.head(A.rows()) -= A * posture.loads().head<3>();
        values.tail(A.rows()) -= A * posture.loads().segment<3>(n);
      }
      return values;
    });
  };
  const auto& yaw = coordinates.yaw;
  add(yaw.from, problem_.free.wrench_turns ? coordinates.free.to : yaw.to, pushed);
  add(0, coordinates.free.to, others);
  if (coordinates.shares.count() == 0) return;
  pushed.insert(pushed.end(), others.begin(), others.end());
  const bool grow = coordinates.forces_grow();
  add_part(grow ? Kind::kLoads : Kind::kForces, 0, coordinates.shares.to, pushed,
           [&](const ExtendedVector& x) {
             posture.set(x);
             const ExtendedVector forces = posture.forces()(pushed);
             if (!grow) return forces;
             ExtendedVector both(2 * forces.size());
             both << forces, posture.forces_by_t()(pushed);
             return both;
           });
}

/// The row of a joint of the chain depends on the coordinates behind it.
void LoopModel::add_joints(LoopPosture& posture) {
  const LoopCoordinates::Stretch& first = coordinates.first;
  if (coordinates.resting) add_joint(posture, *coordinates.resting, first.from);
  for (int i = first.from; i < first.to; ++i) {
    add_joint(posture, coordinates.joints[static_cast<std::size_t>(i - first.from)], i + 1);
  }
}

void LoopModel::add_joint(LoopPosture& posture, int joint, int from) {
  const int row = static_cast<int>(problem_.robot.base_axes.size()) + joint;
  add_part(Kind::kLoads, from, coordinates.free.to, {row}, [&](const ExtendedVector& x) {
    posture.set(x);
    ExtendedVector values(2);
    values << posture.loads()[row], posture.loads()[n + row];
    return values;
  });
}

void LoopModel::leave_equations() {
  std::erase_if(parts, [](const LoopPart& part) { return part.kind == Kind::kEquations; });
  m = 0;
  f.resize(0);
}

std::vector<int> LoopModel::new_equations(Eigen::Index count) {
  std::vector<int> rows(static_cast<std::size_t>(count));
  std::iota(rows.begin(), rows.end(), static_cast<int>(m));
  m += count;
  f.conservativeResize(m);
  f.tail(count).setZero();
  return rows;
}

/// Adds the two sides of the base's equations, split at the middle of the chain; and those of the
/// second arm and of the pose that it touches.
void LoopModel::add_equations(LoopPosture& posture) {
  using Side = std::function<ExtendedVector()>;
  posture.set(ExtendedVector::Zero(coordinates.lower.size()));
  const auto add = [&](int from, int to, const std::vector<int>& rows, const Side& side) {
    add_part(Kind::kEquations, from, to, rows, [&](const ExtendedVector& x) {
      posture.set(x);
      return side();
    });
  };
  if (!coordinates.base_is_dependent) {
    const int from = coordinates.yaw.from, to = coordinates.free.to;
    const int k =
        std::clamp((from + to) / 2 - coordinates.first.from, 0, coordinates.first.count());
    const int cut = coordinates.first.from + k;
    const std::vector<int> rows = new_equations(posture.left(k).size());
    add(from, cut, rows, [&] { return posture.left(k); });
    add(cut, to, rows, [&] { return ExtendedVector(-posture.right(k)); });
  }
  if (!problem_.contact) return;
  const std::vector<int> rows = new_equations(posture.touching().size());
  add(0, coordinates.second.to, rows, [&] { return posture.touching(); });
  add(coordinates.first.from, coordinates.regrasp.to, rows,
      [&] { return ExtendedVector(-posture.touched()); });
}

}  // namespace maxwrench
