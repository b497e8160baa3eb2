#include "lib/trajectory/clearance.h"

#include "lib/robot/clearance_slope.h"
#include "lib/trajectory/motion_evaluator.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

/// [m] A clearance counts as smaller only if it is smaller by this. Otherwise rounding would choose
/// among instants between which nothing moves.
constexpr double kNearer = 1e-9;

/// The weights of the knots of a table in theta_r at an instant.
auto weights_at(const SchemeMaps& maps, int instant) {
  return maps.P.row(instant).segment(maps.before, maps.rows());
}

/// Whether the knots of a table move an instant; the others are given.
bool is_free(const SchemeMaps& maps, int instant) { return !weights_at(maps, instant).isZero(0); }

}  // namespace

void find_near_pairs(const Problem& problem, const Kinematics<double>& kinematics, int knot,
                     double within, std::vector<NearPair>& pairs, const Eigen::MatrixXd& slopes) {
  const CollisionChecker& checker = *problem.robot.collision;
  ClosestPoints near;
  for (int pair = 0; pair < checker.pairs(); ++pair) {
    if (!checker.nearest(kinematics.links(), pair, near) || near.clearance > within) continue;
    if (near.on_a == near.on_b) continue;  // no derivative
    NearPair& added = pairs.emplace_back();
    added.knot = knot;
    added.clearance = near.clearance;
    added.gradient.resize(problem.redundancy());
    const auto opens = [&](int joint) {
      return clearance_slope(problem.robot, kinematics.links(), near, joint);
    };
    for (Eigen::Index k = 0; k < added.gradient.size(); ++k) {
      added.gradient[k] = opens(problem.redundant[static_cast<std::size_t>(k)]);
    }
    for (const int joint : problem.dependent) {
      added.gradient += opens(joint) * slopes.row(4 + joint).transpose();
    }
  }
}

void find_near_pairs(const Problem& problem, MotionEvaluator& motion, const Eigen::MatrixXd& Q,
                     double within, bool at_instants, Kinematics<double>& kinematics,
                     std::vector<NearPair>& pairs) {
  const SchemeMaps& maps = motion.maps();
  auto next = static_cast<std::size_t>(maps.before);
  const std::size_t end = maps.knot_at.size() - static_cast<std::size_t>(maps.after);
  motion.visit(Q, [&](int instant, const Eigen::VectorXd& q, const Eigen::MatrixXd& slopes) {
    const bool is_knot = next < end && instant == maps.knot_at[next];
    if (!is_knot && !(at_instants && is_free(maps, instant))) return;
    kinematics.set_joints(q);
    const int knot = is_knot ? static_cast<int>(next++) - maps.before : -1;
    const std::size_t first = pairs.size();
    find_near_pairs(problem, kinematics, knot, within, pairs, slopes);
    for (std::size_t i = first; !is_knot && i < pairs.size(); ++i) {
      pairs[i].weights = weights_at(maps, instant);
    }
  });
}

std::string first_collision(const Problem& problem, const MotionEvaluator& motion,
                            const std::vector<Instant>& instants, bool at_instants,
                            Kinematics<double>& kinematics) {
  const SchemeMaps& maps = motion.maps();
  const int first = maps.starts ? 0 : 1;
  const std::size_t end = maps.knot_at.size() - static_cast<std::size_t>(maps.after);
  const auto colliding_at = [&](int instant) {
    if (motion.lost() >= 0 && instant >= motion.lost()) return -1;
    kinematics.set_joints(instants[static_cast<std::size_t>(instant)].q);
    return problem.robot.collision->colliding_pair(kinematics.links());
  };
  for (auto knot = static_cast<std::size_t>(maps.before); knot < end; ++knot) {
    const int pair = colliding_at(maps.knot_at[knot]);
    if (pair < 0) continue;
    return "self-collision: knot " + std::to_string(first + static_cast<int>(knot)) + ": " +
           problem.robot.collision->pair_name(pair);
  }
  for (int instant = 0; at_instants && instant < maps.instants(); ++instant) {
    const int pair = is_free(maps, instant) ? colliding_at(instant) : -1;
    if (pair < 0) continue;
    return "self-collision: at t = " + std::to_string(maps.t[static_cast<std::size_t>(instant)]) +
           " s: " + problem.robot.collision->pair_name(pair);
  }
  return {};
}

std::optional<Clearance> find_least_clearance(const Problem& problem, MotionEvaluator& motion,
                                              const Eigen::MatrixXd& Q,
                                              Kinematics<double>& kinematics) {
  const CollisionChecker& checker = *problem.robot.collision;
  Clearance found{kInfinity, 0, ""};
  int nearest = -1;
  ClosestPoints near;
  const bool all = motion.visit(Q, [&](int i, const Eigen::VectorXd& q, const Eigen::MatrixXd&) {
    kinematics.set_joints(q);
    const int colliding = checker.colliding_pair(kinematics.links());
    for (int pair = 0; pair < checker.pairs(); ++pair) {
      const bool known = checker.nearest(kinematics.links(), pair, near);
      if (!known && pair != colliding) continue;
      const double clearance = known ? near.clearance : 0;
      if (!(clearance < found.least - kNearer)) continue;
      found.least = clearance;
      found.t = motion.maps().t[static_cast<std::size_t>(i)];
      nearest = pair;
    }
  });
  if (!all || nearest < 0) return {};
  found.pair = checker.pair_name(nearest);
  return found;
}

}  // namespace maxwrench
