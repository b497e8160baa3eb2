#include "problems/loader/urdf_joint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "problems/make/bad_value.h"

namespace maxwrench {
namespace {

constexpr const char* kTypes = "revolute, continuous, prismatic or fixed";
/// Limits of a revolute joint beyond this are no limits [rad].
constexpr double kManyTurns = 100;
/// Joints of arms turn less than twice each way [rad]; and files that lack limits often have these.
constexpr double kTwoTurns = 4 * std::numbers::pi + 1e-3, kPlaceholderLimit = 10;

/// The joints between the root and the links that carry end effectors.
std::set<std::string> joints_to_tips(const UrdfStructure& structure,
                                     const std::set<std::string>& tips) {
  std::map<std::string, const UrdfElement*> joint_to;
  for (const auto& [parent, joints] : structure.joints_from) {
    for (const UrdfElement& joint : joints) joint_to.emplace(end_of(joint, "child"), &joint);
  }
  std::set<std::string> found;
  for (const std::string& tip : tips) {
    for (auto at = joint_to.find(tip); at != joint_to.end();
         at = joint_to.find(end_of(*at->second, "parent"))) {
      found.insert(name_of(*at->second));
    }
  }
  return found;
}

/// One joint while it is read.
class Reader {
 public:
  /// @param position  where it stays if nothing drives it; none: at rest
  Reader(const UrdfElement& from, const JointChoice& choice, std::optional<double> position,
         std::vector<std::string>& warnings)
      : from_(from), choice_(choice), position_(position), warnings_(warnings) {}

  UrdfJoint read(bool to_tip) {
    Joint& joint = result_.joint;
    joint.name = name_of(from_);
    const std::string type = type_of_joint();
    joint.type = type == "prismatic" ? JointType::kPrismatic : JointType::kRevolute;
    if (type == "fixed" || type == "floating" || type == "planar") {
      result_.locked = 0;
      if (type != "fixed") {
        warn("type", fmt::format("{}: locked, since the base moves along base.axes", type));
      }
      return result_;
    }
    read_axis();
    read_mimic();
    read_range(type == "continuous");
    read_effort(to_tip);
    if (choice_.lock) lock_as_chosen();
    if (choice_.rests && !result_.locked) result_.locked = nearest_to_zero();
    return result_;
  }

 private:
  void warn(std::string_view attribute, std::string_view what) {
    warnings_.push_back(fmt::format("{}.{}: {}", from_.key(), attribute, what));
  }

  std::string type_of_joint() {
    static constexpr std::array<const char*, 6> kKnown = {"revolute", "continuous", "prismatic",
                                                          "fixed",    "floating",   "planar"};
    const std::optional<std::string> type = from_.attribute("type");
    if (!type) from_.throw_bad_input("type", "nothing", kTypes);
    if (std::find(kKnown.begin(), kKnown.end(), *type) == kKnown.end()) {
      from_.throw_bad_input("type", fmt::format("'{}'", *type), kTypes);
    }
    return *type;
  }

  void read_axis() {
    const std::optional<UrdfElement> axis = from_.child_if_any("axis");
    result_.joint.axis = axis ? axis->vector("xyz") : Eigen::Vector3d::UnitX();
    if (result_.joint.axis.stableNorm() > 1e-9) return;
    result_.joint.axis = Eigen::Vector3d::UnitX();
    lock("axis.xyz", "0 0 0");
  }

  void read_mimic() {
    const std::optional<UrdfElement> mimic = from_.child_if_any("mimic");
    if (choice_.mimic) {
      result_.mimic = choice_.mimic;
    } else if (mimic) {
      const std::optional<std::string> leader = mimic->attribute("joint");
      if (!leader) mimic->throw_bad_input("joint", "nothing", "the joint that leads");
      result_.mimic = {*leader, mimic->number("multiplier", 1), mimic->number("offset", 0)};
    }
  }

  void read_range(bool continuous) {
    Joint& joint = result_.joint;
    const std::optional<UrdfElement> limit = from_.child_if_any("limit");
    const bool turns = joint.type == JointType::kRevolute;
    const double pi = std::numbers::pi;
    if (continuous) {
      joint.q_min = -pi;
      joint.q_max = pi;
    } else if (limit && (limit->attribute("lower") || limit->attribute("upper"))) {
      joint.q_min = limit->number("lower", 0);
      joint.q_max = limit->number("upper", 0);
    } else if (!limit && turns) {
      joint.q_min = -pi;
      joint.q_max = pi;
      if (!choice_.lower || !choice_.upper) warn("limit", "missing, which counts as -pi .. pi");
    } else {
      joint.q_min = joint.q_max = 0;
      if (!choice_.lower && !choice_.upper && !result_.mimic)
        warn("limit", "without lower and upper, which counts as 0 .. 0: it does not move");
    }
    if (joint.q_min > joint.q_max) {
      warn("limit", fmt::format("lower {:g} is above upper {:g}: they are swapped", joint.q_min,
                                joint.q_max));
      std::swap(joint.q_min, joint.q_max);
    }
    if (turns && has_placeholder_range()) {
      warn("limit",
           fmt::format("{:g} .. {:g} rad looks like a placeholder", joint.q_min, joint.q_max));
    }
    joint.q_min = choice_.lower.value_or(joint.q_min);
    joint.q_max = choice_.upper.value_or(joint.q_max);
    if (joint.q_min > joint.q_max) reject_range();
    const bool is_given = choice_.lower || (limit && limit->attribute("lower"));
    if (is_given && joint.q_min == joint.q_max) keep_in_place();
    if (turns && (joint.q_min < -kManyTurns || joint.q_max > kManyTurns)) {
      warn("limit", fmt::format("{:g} .. {:g} rad counts as -pi .. pi", joint.q_min, joint.q_max));
      joint.q_min = -pi;
      joint.q_max = pi;
    } else if (!turns && joint.q_max - joint.q_min > kManyTurns) {
      warn("limit", fmt::format("{:g} .. {:g} m: millimetres?", joint.q_min, joint.q_max));
    }
  }

  void read_effort(bool to_tip) {
    if (choice_.lock || choice_.rests) return;
    const std::optional<UrdfElement> limit = from_.child_if_any("limit");
    const auto given = [&](const char* name, const std::optional<double>& choice) {
      if (choice || !limit || !limit->attribute(name)) return choice;
      return std::optional<double>(limit->number(name));
    };
    Joint& joint = result_.joint;
    const auto effort = given("effort", choice_.effort);
    const auto velocity = given("velocity", choice_.velocity);
    if (velocity.value_or(0) > 0) {
      joint.velocity_max = *velocity;
    } else if (!result_.mimic) {
      warn("limit.velocity", velocity ? fmt::format("{:g}, which counts as no limit", *velocity)
                                      : "missing: no limit");
    }
    joint.effort_max = std::max(effort.value_or(0), 0.0);
    if (result_.mimic) return;
    const std::string what = effort ? fmt::format("{:g}", *effort) : "missing";
    if (joint.effort_max == 0 && !to_tip) {
      result_.undriven = !result_.locked;
      lock("limit.effort", what);
    } else if (joint.effort_max == 0 && !choice_.effort) {
      warn("limit.effort",
           fmt::format("{}, which counts as a joint that nothing drives; joints.{}.effort in the "
                       "robot's TOML sets it",
                       what, joint.name));
    } else if (is_placeholder(joint.effort_max) && !choice_.effort) {
      warn("limit.effort", fmt::format("{} looks like a placeholder", what));
    }
  }

  /// The TOML gives one of its ends or both.
  [[noreturn]] void reject_range() const {
    const Joint& joint = result_.joint;
    const char* end = choice_.lower ? "lower" : "upper";
    throw BadValue(fmt::format("joints.{}.{}", joint.name, end),
                   shown(choice_.lower ? joint.q_min : joint.q_max),
                   choice_.lower ? fmt::format("at most the upper limit {:g}", joint.q_max)
                                 : fmt::format("at least the lower limit {:g}", joint.q_min));
  }

  /// A sensor's frame, for example: no motion of it is a solution of any pose.
  void keep_in_place() {
    if (choice_.lock || choice_.rests || result_.mimic) return;
    result_.locked = result_.joint.q_min;
    warn("limit", fmt::format("{0:g} .. {0:g}: the joint is locked there", *result_.locked));
  }

  bool has_placeholder_range() const {
    const double low = result_.joint.q_min, high = result_.joint.q_max;
    if (choice_.lower || choice_.upper || low < -kManyTurns || high > kManyTurns) return false;
    return (low == -kPlaceholderLimit && high == kPlaceholderLimit) || low < -kTwoTurns ||
           high > kTwoTurns;
  }

  static bool is_placeholder(double effort) {
    const double digits = std::log10(effort);
    return effort >= 1000 && (digits == std::floor(digits) ||
                              std::log10(effort + 1) == std::floor(std::log10(effort + 1)));
  }

  double nearest_to_zero() const {
    const double at = std::clamp(0.0, result_.joint.q_min, result_.joint.q_max);
    return std::isfinite(at) ? at : 0.0;
  }

  std::string limits() const {
    return fmt::format("{:g} .. {:g}", result_.joint.q_min, result_.joint.q_max);
  }

  std::string within_limits() const {
    return fmt::format("a position within its limits {}", limits());
  }

  bool is_within_limits(double position) const {
    constexpr double kRounding = 1e-9;  // decimals of files
    return position >= result_.joint.q_min - kRounding &&
           position <= result_.joint.q_max + kRounding;
  }

  /// Where a joint stays that nothing drives.
  double resting_place() const {
    if (!position_ || !result_.undriven) return nearest_to_zero();
    if (is_within_limits(*position_)) return *position_;
    throw BadValue("positions", fmt::format("{} = {:g}", result_.joint.name, *position_),
                   within_limits());
  }

  void lock_as_chosen() {
    result_.locked = *choice_.lock;
    const double at = *choice_.lock;
    if (is_within_limits(at)) return;
    if (choice_.rest_given) {
      throw BadValue("rest", fmt::format("{} = {:g}", result_.joint.name, at), within_limits());
    }
    warn("limit", fmt::format("{}: the joint is locked outside, at {:g}", limits(), at));
  }

  /// Where nothing drives the joint.
  void lock(std::string_view attribute, std::string_view what) {
    const double position = resting_place();
    if (!result_.locked) result_.locked = position;
    warn(attribute, fmt::format("{}: the joint is locked at {:g}", what, position));
  }

  const UrdfElement& from_;
  const JointChoice& choice_;
  std::optional<double> position_;
  std::vector<std::string>& warnings_;
  UrdfJoint result_;
};

/// Replaces a joint's mimic of a joint that mimics another by one of the last, and locks what
/// mimics a locked joint.
void resolve_mimic(std::map<std::string, UrdfJoint>& joints, UrdfJoint& joint,
                   std::vector<std::string>& warnings) {
  const auto lock = [&](double at, const std::string& why) {
    joint.locked = at;
    warnings.push_back(
        fmt::format("joint[{}].mimic: {}: the joint is locked at {:g}", joint.joint.name, why, at));
  };
  for (std::size_t steps = 0; joint.mimic && !joint.locked; ++steps) {
    Mimic& mimic = *joint.mimic;
    const auto found = joints.find(mimic.leader);
    if (found == joints.end()) {
      lock(0, fmt::format("'{}' is no joint of the file", mimic.leader));
    } else if (steps > joints.size()) {
      lock(0, "the joints mimic each other in a circle");
    } else if (found->second.locked) {
      joint.locked = mimic.ratio * *found->second.locked + mimic.offset;
    } else if (found->second.mimic) {
      const Mimic& next = *found->second.mimic;
      mimic = {next.leader, mimic.ratio * next.ratio, mimic.ratio * next.offset + mimic.offset};
    } else if (mimic.ratio == 0) {
      lock(mimic.offset, "multiplier 0");
    } else {
      return;
    }
  }
  joint.mimic.reset();
}

/// A leader moves only where its followers can.
void reflect_limits(UrdfJoint& leader, const UrdfJoint& follower,
                    std::vector<std::string>& warnings) {
  const Joint& joint = follower.joint;
  if (!(joint.q_min < joint.q_max)) return;  // none are given
  const auto [ratio, offset] = std::pair(follower.mimic->ratio, follower.mimic->offset);
  double low = (joint.q_min - offset) / ratio, high = (joint.q_max - offset) / ratio;
  if (low > high) std::swap(low, high);
  low = std::max(low, leader.joint.q_min);
  high = std::min(high, leader.joint.q_max);
  if (low > high) {
    warnings.push_back(
        fmt::format("joint[{}].mimic: no position of '{}' is within the limits {:g} .. {:g}, which "
                    "are ignored: does the multiplier {:g} have the wrong sign?",
                    joint.name, leader.joint.name, joint.q_min, joint.q_max, ratio));
    return;
  }
  leader.joint.q_min = low;
  leader.joint.q_max = high;
}

}  // namespace

std::map<std::string, UrdfJoint> read_joints(const UrdfStructure& structure,
                                             const UrdfChoices& choices,
                                             std::vector<std::string>& warnings) {
  const std::set<std::string> to_tips = joints_to_tips(structure, choices.tips);
  std::map<std::string, UrdfJoint> joints;
  for (const UrdfElement& element : structure.joints) {
    const std::string name = name_of(element);
    const JointChoice choice = choice_of(choices.joints, name);
    const auto found = choices.positions.find(name);
    const bool has_position = found != choices.positions.end();
    Reader reader(element, choice,
                  has_position ? std::optional<double>(found->second) : std::nullopt, warnings);
    joints.emplace(name, reader.read(choices.tips.empty() || to_tips.contains(name)));
  }
  for (const UrdfElement& element : structure.joints) {
    resolve_mimic(joints, joints.at(name_of(element)), warnings);
  }
  for (const UrdfElement& element : structure.joints) {
    const UrdfJoint& joint = joints.at(name_of(element));
    if (joint.mimic) reflect_limits(joints.at(joint.mimic->leader), joint, warnings);
  }
  return joints;
}

}  // namespace maxwrench
