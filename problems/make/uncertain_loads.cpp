#include "problems/make/uncertain_loads.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "problems/make/bad_value.h"

namespace maxwrench {
namespace {

using Eigen::Vector3d;

constexpr double kLargestSpeed = 100;  // of a current [m/s]

/// A mass or volume with its centre, which are uncertain together.
struct UncertainBody {
  const BodyPart& part;
  std::array<std::string, 2> nouns;  ///< as "mass" and "com"
  const char* unit;                  ///< of the amount
  double amount;                     ///< nominal mass [kg] or volume [m^3]
  Vector3d centre;                   ///< nominal centre, in axes of the part [m]
  double per_amount;                 ///< wet mass per amount
  Eigen::Vector4d widths;            ///< of amount, x, y and z of the centre
};

/// The first moment of an amount about the origin of the link, in its axes.
Vector3d moment_of(const BodyPart& part, double amount, const Vector3d& centre) {
  return amount * (part.frame.R * centre + part.frame.p);
}

/// The change of the body's wet mass by changes of its amount and centre.
LinkLoad changed_by(const UncertainBody& body, const Eigen::Vector4d& change) {
  LinkLoad load;
  load.link = body.part.link;
  load.mass = body.per_amount * change[0];
  load.moment = body.per_amount *
                (moment_of(body.part, body.amount + change[0], body.centre + change.tail<3>()) -
                 moment_of(body.part, body.amount, body.centre));
  return load;
}

/// A change of the body, such as "base mass +0.1 kg, com.x -0.01 m".
std::string words_of(const UncertainBody& body, const Eigen::Vector4d& change) {
  std::vector<std::string> words;
  for (Eigen::Index k = 0; k < 4; ++k) {
    if (!(body.widths[k] > 0)) continue;
    words.push_back(k == 0 ? fmt::format("{} {:+g} {}", body.nouns[0], change[k], body.unit)
                           : fmt::format("{}.{} {:+g} m", body.nouns[1],
                                         kTwistAxes[static_cast<std::size_t>(k - 1)], change[k]));
  }
  return fmt::format("{} {}", body.part.name, fmt::join(words, ", "));
}

/// The same by keys.
std::vector<Delta> deltas_of(const UncertainBody& body, const Eigen::Vector4d& change) {
  std::vector<Delta> deltas;
  const auto add = [&](const std::string& noun, const Eigen::VectorXd& by) {
    deltas.push_back({noun + "." + body.part.name, by});
  };
  if (body.widths[0] > 0) add(body.nouns[0], change.head<1>());
  if (!body.widths.tail<3>().isZero(0)) add(body.nouns[1], change.tail<3>());
  return deltas;
}

/// The corners of the intervals of a body.
LoadGroup corners_of(const UncertainBody& body) {
  std::vector<Eigen::Index> uncertain;
  for (Eigen::Index k = 0; k < 4; ++k) {
    if (body.widths[k] > 0) uncertain.push_back(k);
  }
  LoadGroup group;
  if (uncertain.empty()) return group;
  for (unsigned corner = 0; corner < 1U << uncertain.size(); ++corner) {
    Eigen::Vector4d change = Eigen::Vector4d::Zero();
    for (std::size_t i = 0; i < uncertain.size(); ++i) {
      const Eigen::Index k = uncertain[i];
      change[k] = (corner >> i & 1U) == 0 ? body.widths[k] : -body.widths[k];
    }
    group.push_back({.name = words_of(body, change),
                     .loads = {changed_by(body, change)},
                     .deltas = deltas_of(body, change)});
  }
  return group;
}

void require_widths(const std::string& key, const Vector3d& widths) {
  require_numbers(key, widths, 3);
  if (widths.minCoeff() < 0) throw BadValue(key, shown(widths), "3 numbers >= 0");
}

/// Adds the group of the amount and centre of each body in these tables.
void add_bodies(const std::array<std::string, 2>& nouns,
                const std::map<std::string, double>& amounts,
                const std::map<std::string, Vector3d>& centres, const Robot& robot,
                std::vector<LoadGroup>& groups) {
  const bool is_mass = nouns[0] == "mass";
  const std::string amount_key = "uncertainty." + nouns[0], centre_key = "uncertainty." + nouns[1];
  for (const auto& [name, width] : amounts) find_part(amount_key, name, robot);
  for (const auto& [name, widths] : centres) find_part(centre_key, name, robot);
  for (const BodyPart& part : robot.parts) {
    const auto amount = amounts.find(part.name);
    const auto centre = centres.find(part.name);
    if (amount == amounts.end() && centre == centres.end()) continue;
    UncertainBody body{part,
                       nouns,
                       is_mass ? "kg" : "m^3",
                       is_mass ? part.mass : part.volume,
                       is_mass ? part.com : part.cob,
                       is_mass ? 1 : -robot.water_density,
                       Eigen::Vector4d::Zero()};
    const std::string key = (amount == amounts.end() ? centre_key : amount_key) + "." + part.name;
    if (!is_mass && robot.water_density == 0) {
      throw BadValue(key, "a value", "no such key in air: environment.water_density is 0");
    }
    if (amount != amounts.end()) {
      body.widths[0] = amount->second;
      require_non_negative(key, body.widths[0]);
      if (body.widths[0] > body.amount) {
        throw BadValue(
            key, shown(body.widths[0]),
            fmt::format("at most the {} itself, {:g} {}", nouns[0], body.amount, body.unit));
      }
    }
    if (centre != centres.end()) {
      const std::string where = centre_key + "." + part.name;
      require_widths(where, centre->second);
      body.widths.tail<3>() = centre->second;
      if (body.amount == 0 && !centre->second.isZero(0)) {
        throw BadValue(where, shown(centre->second),
                       fmt::format("zeros: this body has no {}", nouns[0]));
      }
    }
    groups.push_back(corners_of(body));
  }
}

Delta delta_of(const char* key, double change) {
  return {key, Eigen::VectorXd::Constant(1, change)};
}

LoadGroup trim_cases(double width, const Robot& robot) {
  require_non_negative("uncertainty.trim", width);
  if (width > 0 && robot.base_axes.empty()) {
    throw BadValue("uncertainty.trim", shown(width), "no such key: the base is fixed");
  }
  LoadGroup group;
  for (const double change : {width, -width}) {
    // The trim carries: what it carries is missing from the wet mass of the base.
    const LinkLoad load{.mass = -change, .moment = -change * robot.trim.position};
    group.push_back({.name = fmt::format("trim {:+g} kg", change),
                     .loads = {load},
                     .deltas = {delta_of("trim", change)}});
  }
  return width > 0 ? group : LoadGroup();
}

LoadGroup payload_cases(const UncertaintySpec& uncertainty, const Problem& problem) {
  const double mass = uncertainty.payload_mass;
  require_non_negative("uncertainty.payload.mass", mass);
  require_numbers("uncertainty.payload.com", uncertainty.payload_com, 3);
  if (mass == 0) return {};
  const EndEffector& tip =
      problem.robot.end_effectors[static_cast<std::size_t>(problem.end_effector)];
  const Pose<double>& X = tip.placement;
  const LinkLoad load{
      .link = tip.link, .mass = mass, .moment = mass * (X.R * uncertainty.payload_com + X.p)};
  constexpr const char* kKey = "payload.mass";
  return {{.name = "", .loads = {}, .deltas = {delta_of(kKey, 0)}},
          {.name = fmt::format("payload {:g} kg", mass),
           .loads = {load},
           .deltas = {delta_of(kKey, mass)}}};
}

/// Still water and the currents of one speed from all directions, or the given currents.
LoadGroup current_cases(const UncertaintySpec& uncertainty, const Robot& robot) {
  const double speed = uncertainty.current_speed;
  const std::vector<Vector3d>& vectors = uncertainty.current_vectors;
  require_non_negative("uncertainty.current.speed", speed);
  const int n = uncertainty.current_directions;
  if (n < 1 || n >= kMostScenarios) {
    throw BadValue("uncertainty.current.directions", fmt::format("{}", n),
                   fmt::format("a whole number from 1 to {}", kMostScenarios - 1));
  }
  if (speed > 0 && !vectors.empty()) {
    throw BadValue("uncertainty.current.speed", shown(speed),
                   "no such key beside uncertainty.current.vectors");
  }
  LoadGroup group;
  if (speed > 0) {
    require_current("uncertainty.current", fmt::format("{:g} m/s", speed), speed, robot);
    group.push_back({});
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * k / n;
      group.push_back({.name = fmt::format("current {:g} m/s at {:g} deg", speed, 360.0 * k / n),
                       .loads = {},
                       .current = speed * Vector3d(std::cos(angle), std::sin(angle), 0)});
    }
  }
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    const Vector3d& v = vectors[i];
    require_numbers(fmt::format("uncertainty.current.vectors[{}]", i), v, 3);
    require_current("uncertainty.current", shown(v), v.stableNorm(), robot);
    const std::string name =
        v.isZero(0) ? "" : fmt::format("current [{:g}, {:g}, {:g}] m/s", v.x(), v.y(), v.z());
    group.push_back({.name = name, .loads = {}, .current = v});
  }
  const bool still = std::all_of(group.begin(), group.end(),
                                 [](const LoadCase& one) { return one.current.isZero(0); });
  return still ? LoadGroup() : group;
}

}  // namespace

void require_current(const std::string& key, const std::string& got, double speed,
                     const Robot& robot) {
  const bool has_drag = std::any_of(robot.links.begin(), robot.links.end(),
                                    [](const Link& link) { return !link.hydrodynamics.empty(); });
  if (!has_drag || robot.water_density <= 0) {
    throw BadValue(key, got, "no such key unless the robot has hydrodynamics");
  }
  if (!(speed <= kLargestSpeed)) {
    throw BadValue(key, got, fmt::format("a current of at most {:g} m/s", kLargestSpeed));
  }
}

const BodyPart& find_part(const std::string& key, const std::string& name, const Robot& robot) {
  std::vector<std::string> names;
  for (const BodyPart& part : robot.parts) {
    if (part.name == name) return part;
    names.push_back(part.name);
  }
  throw BadValue(fmt::format("{}.{}", key, name), "an unknown key",
                 fmt::format("one of {}", fmt::join(names, ", ")));
}

std::vector<LoadGroup> uncertain_loads(const UncertaintySpec& uncertainty, const Problem& problem) {
  const Robot& robot = problem.robot;
  std::vector<LoadGroup> groups;
  add_bodies({"mass", "com"}, uncertainty.mass, uncertainty.com, robot, groups);
  add_bodies({"volume", "cob"}, uncertainty.volume, uncertainty.cob, robot, groups);
  groups.push_back(trim_cases(uncertainty.trim, robot));
  groups.push_back(payload_cases(uncertainty, problem));
  groups.push_back(current_cases(uncertainty, robot));
  std::erase_if(groups, [](const LoadGroup& group) { return group.empty(); });
  return groups;
}

}  // namespace maxwrench
