#include "problems/make/redundant_joints.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "lib/math/decompositions.h"
#include "lib/math/random.h"
#include "lib/robot/chain.h"
#include "lib/robot/gears.h"
#include "lib/robot/kinematics.h"
#include "problems/make/bad_value.h"
#include "problems/make/theta_r.h"

namespace maxwrench {
namespace {

constexpr int kPostures = 64;

/// The Jacobians of random postures, in units of the robot's reach.
std::vector<Matrix6Xd> sample_jacobians(const Robot& robot, const EndEffector& tip) {
  Kinematics<double> kinematics(robot);
  Random random(1);
  Eigen::VectorXd q(robot.joints.size());
  std::vector<Matrix6Xd> all(kPostures, Matrix6Xd(6, robot.velocities()));
  double reach = 0;
  for (Matrix6Xd& J : all) {
    draw_joints(robot, random, q);
    kinematics.set_joints(q);
    kinematics.jacobian(tip, Eigen::Matrix3d::Identity(), J);
    fold_gears(robot, J);
    reach += kinematics.end_effector_position(tip).norm() / kPostures;
  }
  if (reach > 0) {
    for (Matrix6Xd& J : all) J.topRows<3>() /= reach;
  }
  return all;
}

/// The mean of the singular value of number `rank` of these columns.
double score(const std::vector<Matrix6Xd>& all, const std::vector<int>& columns, int rank) {
  double sum = 0;
  for (const Matrix6Xd& J : all) {
    sum += singular_values(J(Eigen::all, columns))[rank - 1] / kPostures;
  }
  return sum;
}

}  // namespace

void require_no_gears(std::string_view key, const Robot& robot, int end_effector) {
  const std::vector<int> gears = gears_at(robot, end_effector);
  if (gears.empty()) return;
  throw BadValue(key, fmt::format("a chain that moves '{}'", names_of(robot, {gears.front()})),
                 "an end effector before all gears (joints with mimic), or joints.NAME.lock for "
                 "one of each gear's joints");
}

void require_redundant_leaders(const Robot& robot, const std::vector<int>& leaders, int count) {
  if (static_cast<int>(leaders.size()) <= count) return;
  throw BadValue(
      "end_effector",
      fmt::format("a chain with gears (joints with mimic) that {} lead{}", names_of(robot, leaders),
                  leaders.size() == 1 ? "s" : ""),
      fmt::format("as many joints to choose as lead: the pose leaves {}. joints.NAME.lock "
                  "fixes a gear",
                  count));
}

std::vector<int> choose_redundant(Robot& robot, int end_effector, const std::vector<int>& chain,
                                  const std::vector<int>& leaders, int count) {
  if (count == 0) return {};
  const std::vector<Matrix6Xd> all =
      sample_jacobians(robot, robot.end_effectors[static_cast<std::size_t>(end_effector)]);
  const int axes = static_cast<int>(robot.base_axes.size());
  const int rank = motions_of(robot, end_effector);
  std::vector<int> dependent = chain, redundant;
  std::vector<std::string> why;
  for (const int leader : leaders) {
    std::erase(dependent, leader);
    redundant.push_back(leader);
    why.push_back(
        fmt::format("{} (leads another)", robot.joints[static_cast<std::size_t>(leader)].name));
  }
  for (int k = static_cast<int>(leaders.size()); k < count; ++k) {
    double best = -1, next = -1;
    int chosen = 0;
    for (const int joint : dependent) {
      std::vector<int> columns(static_cast<std::size_t>(axes));
      std::iota(columns.begin(), columns.end(), 0);
      for (const int other : dependent) {
        if (other != joint) columns.push_back(axes + other);
      }
      const double value = score(all, columns, rank);
      if (value > best * (1 + 1e-9)) {
        next = best;
        best = value;
        chosen = joint;
      } else {
        next = std::max(next, value);
      }
    }
    std::erase(dependent, chosen);
    redundant.push_back(chosen);
    why.push_back(fmt::format("{} ({:.3g}{})", robot.joints[static_cast<std::size_t>(chosen)].name,
                              best, next >= 0 ? fmt::format(", next {:.3g}", next) : ""));
  }
  robot.notes.push_back(
      fmt::format("redundant joints, without which the others follow best (mean smallest singular "
                  "value): {}",
                  fmt::join(why, ", ")));
  std::sort(redundant.begin(), redundant.end(), [&chain](int a, int b) {
    const auto place = [&chain](int joint) {
      return std::find(chain.begin(), chain.end(), joint) - chain.begin();
    };
    return place(a) < place(b);
  });
  return redundant;
}

}  // namespace maxwrench
