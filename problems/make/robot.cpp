#include "problems/make/robot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "problems/make/bad_value.h"
#include "problems/make/collision_shapes.h"
#include "problems/make/uncertain_loads.h"

namespace maxwrench {
namespace {

/// The principal moments in increasing order.
Eigen::Vector3d principal_moments(const Eigen::Matrix3d& inertia) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

DataFault bad_moments(const std::string& link, const Eigen::Vector3d& moments,
                      const std::string& expected) {
  return {
      fmt::format("link[{}].inertial.inertia", link),
      fmt::format("principal moments {:.6g}, {:.6g}, {:.6g}", moments[0], moments[1], moments[2]),
      expected};
}

/// Rejects names that are empty or occur twice.
template <class Named>
void require_names(const std::vector<Named>& all, const std::string& noun) {
  std::set<std::string> names;
  for (const Named& each : all) {
    if (each.name.empty()) throw BadValue(noun + ".name", "''", "a name");
    if (names.insert(each.name).second) continue;
    throw BadValue(fmt::format("{}[{}]", noun, each.name), "a duplicate name", "unique names");
  }
}

void check_base(Robot& robot) {
  auto& free = robot.base_axes;
  std::sort(free.begin(), free.end());
  if (!base_axes_are_integrable(free)) {
    std::vector<std::string> names;
    for (const int axis : free) {
      const bool known = axis >= 0 && axis < 6;
      names.push_back(known ? shown(std::string(kTwistAxes[static_cast<std::size_t>(axis)]))
                            : fmt::format("{}", axis));
    }
    throw BadValue("base.axes", fmt::format("[{}]", fmt::join(names, ", ")),
                   "one of [], [x], [x,y], [x,y,z], [yaw], [x,y,yaw], [x,y,z,yaw] or all six "
                   "(others do not integrate to poses)");
  }
  require_pose("base", robot.mount);
}

/// Why a link that moves has no equation of motion: without mass or moments it is singular.
std::optional<DataFault> why_no_motion(const Link& link) {
  const char* moves = "of this link with all that is fixed to it, because it moves";
  if (!(link.mass > 0)) {
    return DataFault{fmt::format("link[{}].inertial.mass", link.name), shown(link.mass),
                     fmt::format("a mass > 0 {}", moves)};
  }
  const Eigen::Vector3d moments = principal_moments(link.inertia);
  if (moments[0] > 1e-9 * moments[2]) return std::nullopt;
  return bad_moments(link.name, moments, fmt::format("moments > 0 {}", moves));
}

/// Adds to `Robot::no_dynamics` unless that link is there.
void check_dynamics(const Link& link, bool rests, Robot& robot) {
  const std::string key = fmt::format("link[{}].inertial", link.name);
  for (const DataFault& known : robot.no_dynamics) {
    if (known.key.starts_with(key)) return;
  }
  std::optional<DataFault> why = why_no_body(link.name, link.mass, link.inertia);
  if (!why && !rests) why = why_no_motion(link);
  if (why) robot.no_dynamics.push_back(*why);
}

void check_links(Robot& robot) {
  if (robot.links.size() != robot.joints.size() + 1) {
    throw BadValue("link", fmt::format("{} links", robot.links.size()),
                   fmt::format("{}: the base, and one for each joint", robot.joints.size() + 1));
  }
  require_names(robot.links, "link");
  for (const Link& link : robot.links) {
    require_body(link.name, link.mass, link.inertia);
    require_numbers(fmt::format("link[{}].inertial.origin.xyz", link.name), link.com, 3);
    require_non_negative(fmt::format("buoyancy.{}.volume", link.name), link.volume);
    require_numbers(fmt::format("buoyancy.{}.cob", link.name), link.cob, 3);
    const std::string water = fmt::format("hydrodynamics.{}", link.name);
    for (const HydrodynamicBody& body : link.hydrodynamics) {
      require_pose(water, body.frame);
      require_coefficients(water + ".added_mass", body.added_mass);
      require_coefficients(water + ".damping_linear", body.damping_linear);
      require_coefficients(water + ".damping_quadratic", body.damping_quadratic);
    }
    const bool rests = robot.base_axes.empty() && &link == robot.links.data();
    check_dynamics(link, rests, robot);
  }
}

void check_limits(const std::string& key, const Joint& joint) {
  require_finite(key + ".lower", joint.q_min);
  require_finite(key + ".upper", joint.q_max);
  if (joint.q_min > joint.q_max) {
    throw BadValue(key + ".lower", shown(joint.q_min),
                   fmt::format("at most upper = {}", joint.q_max));
  }
  require_non_negative(key + ".effort", joint.effort_max);
  require_positive(key + ".velocity", joint.velocity_max);
}

/// A gear needs a motor at its other end.
void check_gear(const std::string& key, const Robot& robot, const Joint& joint) {
  if (!joint.gear) return;
  const Gear& gear = *joint.gear;
  const auto leader = static_cast<std::size_t>(gear.leader);
  if (gear.leader < 0 || leader >= robot.joints.size() || robot.joints[leader].gear) {
    throw BadValue(key + ".joint", fmt::format("{}", gear.leader),
                   "a joint that has a motor, not a gear");
  }
  if (!std::isfinite(gear.ratio) || gear.ratio == 0) {
    throw BadValue(key + ".multiplier", shown(gear.ratio), "a finite number, not 0");
  }
  require_finite(key + ".offset", gear.offset);
}

void check_joints(Robot& robot) {
  require_names(robot.joints, "joint");
  int carried = 1;  // the link that the joint moves
  for (Joint& joint : robot.joints) {
    const std::string key = fmt::format("joint[{}]", joint.name);
    if (joint.parent < 0 || joint.parent >= carried) {
      throw BadValue(key + ".parent", fmt::format("{}", joint.parent),
                     fmt::format("an earlier link than the joint's own, which is {}", carried));
    }
    ++carried;
    require_pose(key + ".origin", joint.placement);
    joint.axis = direction_of(key + ".axis.xyz", joint.axis);
    check_limits(key + ".limit", joint);
    check_gear(key + ".mimic", robot, joint);
  }
}

void check_thrusters(Robot& robot) {
  std::set<std::string> names;
  for (const Joint& joint : robot.joints) names.insert(joint.name);
  int i = 0;
  for (Thruster& thruster : robot.thrusters) {
    const std::string key = fmt::format("thrusters.list[{}].", i++);
    if (thruster.name.empty() || !names.insert(thruster.name).second) {
      throw BadValue(key + "name", shown(thruster.name), "a unique name");
    }
    require_numbers(key + "position", thruster.position, 3);
    thruster.direction = direction_of(key + "direction", thruster.direction);
    require_finite(key + "force_min", thruster.force_min);
    require_finite(key + "force_max", thruster.force_max);
    if (thruster.force_min > thruster.force_max) {
      throw BadValue(key + "force_max", shown(thruster.force_max),
                     fmt::format("at least force_min = {}", thruster.force_min));
    }
    require_positive(key + "force_rate_max", thruster.force_rate_max);
  }
}

/// The wet mass of parts, as a link has it.
struct PartSum {
  double mass = 0, volume = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero(), displaced = Eigen::Vector3d::Zero();
};

/// The parts of a link must be all of it: their masses, volumes and first moments add up to its
/// own.
void check_sums(const Robot& robot) {
  constexpr double kShare = 1e-9;
  std::vector<PartSum> sums(robot.links.size());
  for (const BodyPart& part : robot.parts) {
    PartSum& sum = sums[static_cast<std::size_t>(part.link)];
    sum.mass += part.mass;
    sum.volume += part.volume;
    sum.moment += part.mass * (part.frame.R * part.com + part.frame.p);
    sum.displaced += part.volume * (part.frame.R * part.cob + part.frame.p);
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const Link& link = robot.links[i];
    const auto require_sum = [&](const char* what, double apart, double size, double got,
                                 double expected) {
      if (apart <= kShare * size) return;
      throw BadValue(fmt::format("part.{}", what), fmt::format("{:g} on '{}'", got, link.name),
                     fmt::format("that of the link, {:g}, or no parts at all", expected));
    };
    const PartSum& sum = sums[i];
    require_sum("mass", std::abs(sum.mass - link.mass), link.mass, sum.mass, link.mass);
    require_sum("volume", std::abs(sum.volume - link.volume), link.volume, sum.volume, link.volume);
    const Eigen::Vector3d moment = link.mass * link.com, displaced = link.volume * link.cob;
    require_sum("mass x com", (sum.moment - moment).norm(), link.mass * (1 + link.com.norm()),
                sum.moment.norm(), moment.norm());
    require_sum("volume x cob", (sum.displaced - displaced).norm(),
                link.volume * (1 + link.cob.norm()), sum.displaced.norm(), displaced.norm());
  }
}

void check_parts(Robot& robot) {
  if (robot.parts.empty()) {
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
      const Link& link = robot.links[i];
      robot.parts.push_back({.name = link.name,
                             .link = static_cast<int>(i),
                             .frame = {},
                             .mass = link.mass,
                             .com = link.com,
                             .volume = link.volume,
                             .cob = link.cob});
    }
  }
  require_names(robot.parts, "part");
  for (const BodyPart& part : robot.parts) {
    const std::string key = fmt::format("part[{}]", part.name);
    require_link(key + ".link", robot, part.link);
    require_pose(key, part.frame);
    require_non_negative(key + ".mass", part.mass);
    require_numbers(key + ".com", part.com, 3);
    require_non_negative(key + ".volume", part.volume);
    require_numbers(key + ".cob", part.cob, 3);
  }
  check_sums(robot);
}

void check_end_effectors(const Robot& robot) {
  require_names(robot.end_effectors, "end_effectors");
  for (const EndEffector& tip : robot.end_effectors) {
    const std::string key = fmt::format("end_effectors.{}", tip.name);
    require_link(key + ".link", robot, tip.link);
    require_pose(key, tip.placement);
  }
}

void check_environment(const Robot& robot) {
  require_non_negative("environment.gravity", robot.gravity);
  require_non_negative("environment.water_density", robot.water_density);
  require_finite("trim.buoyancy_mass", robot.trim.buoyancy_mass);
  require_numbers("trim.position", robot.trim.position, 3);
  std::vector<InWater> bodies;
  for (const Link& link : robot.links) {
    bodies.push_back({link.name, link.volume, !link.hydrodynamics.empty()});
  }
  require_hydrodynamics(bodies, robot.water_density);
  require_numbers("environment.current", robot.current, 3);
  if (robot.current.isZero(0)) return;
  require_current("environment.current", shown(robot.current), robot.current.stableNorm(), robot);
}

}  // namespace

void require_link(const std::string& key, const Robot& robot, int link) {
  if (link >= 0 && link < static_cast<int>(robot.links.size())) return;
  throw BadValue(key, fmt::format("{}", link),
                 fmt::format("a link: 0 to {}", robot.links.size() - 1));
}

void require_body(const std::string& link, double mass, const Eigen::Matrix3d& inertia) {
  const std::string key = fmt::format("link[{}].inertial.", link);
  if (!(mass >= 0 && mass < kInfinity)) throw BadValue(key + "mass", shown(mass), "a mass >= 0");
  const double largest = inertia.cwiseAbs().maxCoeff();
  if (!inertia.allFinite() || (inertia - inertia.transpose()).norm() > 1e-9 * largest) {
    const Eigen::VectorXd numbers = Eigen::Map<const Eigen::VectorXd>(inertia.data(), 9);
    throw BadValue(key + "inertia", shown(numbers), "9 finite numbers of a symmetric matrix");
  }
}

std::optional<DataFault> why_no_body(const std::string& link, double mass,
                                     const Eigen::Matrix3d& inertia) {
  const Eigen::Vector3d moments = principal_moments(inertia);
  const double slack = 1e-9 * std::abs(moments[2]);
  // Files have moments of three digits or more, and of a thin plate the sum is the third moment.
  const double rounding = 1e-3 * std::abs(moments[2]);
  if (moments[0] < -slack || moments[0] + moments[1] < moments[2] - rounding) {
    return bad_moments(link, moments, "moments >= 0, none above the sum of the other two");
  }
  if (mass == 0 && moments[2] > 0) {
    return bad_moments(link, moments, "no moments where the mass is zero");
  }
  return std::nullopt;
}

void require_hydrodynamics(const std::vector<InWater>& bodies, double water_density) {
  const auto known = std::find_if(bodies.begin(), bodies.end(),
                                  [](const InWater& body) { return body.has_hydrodynamics; });
  if (known == bodies.end()) return;
  for (const InWater& body : bodies) {
    if (body.volume == 0 || body.has_hydrodynamics) continue;
    throw BadValue(fmt::format("hydrodynamics.{}", body.name), "nothing",
                   fmt::format("added mass and drag, perhaps zeros: this body displaces water as "
                               "'{}' does",
                               known->name));
  }
  if (water_density > 0) return;
  throw BadValue("environment.water_density", fmt::format("{:g}", water_density),
                 fmt::format("a density > 0: '{}' has added mass and drag, which are those of "
                             "water",
                             known->name));
}

void require_coefficients(const std::string& key, const Vector6d& values) {
  require_numbers(key, values, 6);
  if (values.minCoeff() < 0) throw BadValue(key, shown(values), "6 numbers >= 0");
}

Robot finalize(Robot robot, const Collision& collision) {
  check_base(robot);
  check_joints(robot);
  check_links(robot);
  check_parts(robot);
  check_thrusters(robot);
  check_end_effectors(robot);
  check_environment(robot);
  set_collision(robot, collision);
  complete_actuation(robot);
  return robot;
}

}  // namespace maxwrench
