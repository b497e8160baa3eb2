#include "problems/loader/scenario_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>

#include "problems/loader/robot_choices.h"
#include "problems/make/robot.h"
#include "problems/make/uncertain_loads.h"

namespace maxwrench {
namespace {

/// A table of one or more keys.
Block filled_table(const Block& outer, std::string_view key) {
  const Block table = outer.table(key);
  if (table.keys().empty()) outer.throw_bad_value(key, "an empty table", "one or more keys");
  return table;
}

/// A number, or a text such as "5%" of the nominal value.
double width_of(const Block& widths, const std::string& key, double nominal) {
  if (!widths.is_text(key)) return widths.number(key);
  const std::string text = widths.text(key);
  double percent = 0;
  const char* const end = text.data() + text.size() - 1;
  const auto [rest, error] = std::from_chars(text.data(), end, percent);
  if (error != std::errc() || rest != end || *end != '%' ||
      !(percent >= 0 && percent < kInfinity)) {
    widths.throw_bad_value(key, "a number, or a share such as '5%' of the nominal value");
  }
  return percent / 100 * nominal;
}

std::map<std::string, double> read_widths(const Block& uncertainty, const std::string& key,
                                          double BodyPart::*nominal, const Robot& robot) {
  std::map<std::string, double> result;
  if (!uncertainty.has(key)) return result;
  const Block widths = filled_table(uncertainty, key);
  for (const std::string& name : widths.keys()) {
    const BodyPart& part = find_part("uncertainty." + key, name, robot);
    result.emplace(name, width_of(widths, name, part.*nominal));
  }
  return result;
}

std::map<std::string, Eigen::Vector3d> read_vectors(const Block& uncertainty,
                                                    const std::string& key) {
  std::map<std::string, Eigen::Vector3d> result;
  if (!uncertainty.has(key)) return result;
  const Block vectors = filled_table(uncertainty, key);
  for (const std::string& name : vectors.keys()) result.emplace(name, vectors.vector(name));
  return result;
}

void read_current(const Block& current, UncertaintySpec& spec) {
  current.allow_only({"speed", "directions", "vectors"});
  if (!current.has("vectors")) {
    spec.current_speed = current.number("speed");
    spec.current_directions = current.whole("directions", 1, static_cast<int>(kMostScenarios) - 1,
                                            spec.current_directions);
    return;
  }
  for (const char* key : {"speed", "directions"}) {
    if (current.has(key)) current.throw_bad_value(key, "no such key beside vectors");
  }
  for (const Eigen::VectorXd& v : current.rows("vectors", 3)) spec.current_vectors.emplace_back(v);
}

UncertaintySpec read_uncertainty(const Block& block, const Robot& robot) {
  block.allow_only(
      {"mass", "com", "volume", "cob", "trim", "payload", "thrust", "torque", "current"});
  UncertaintySpec spec;
  spec.mass = read_widths(block, "mass", &BodyPart::mass, robot);
  spec.volume = read_widths(block, "volume", &BodyPart::volume, robot);
  spec.com = read_vectors(block, "com");
  spec.cob = read_vectors(block, "cob");
  spec.trim = block.number("trim", 0);
  if (block.has("payload")) {
    const Block payload = block.table("payload");
    payload.allow_only({"mass", "com"});
    spec.payload_mass = payload.number("mass");
    spec.payload_com = payload.vector("com", spec.payload_com);
  }
  spec.thrust = block.number("thrust", 0);
  spec.torque = block.number("torque", 0);
  if (block.has("current")) read_current(block.table("current"), spec);
  return spec;
}

LossSpec read_loss(const Block& block) {
  block.allow_only({"any", "actuators", "cases", "joints", "friction", "brake"});
  LossSpec spec;
  if (block.has("cases")) {
    for (const char* key : {"any", "actuators"}) {
      if (block.has(key)) block.throw_bad_value(key, "no such key beside loss.cases");
    }
    spec.cases = block.text_lists("cases");
  } else {
    spec.any = block.whole("any", 1, static_cast<int>(kMostScenarios));
    if (block.has("actuators")) spec.actuators = block.texts("actuators");
  }
  const std::string joints = block.text("joints", "limp");
  if (joints != "limp" && joints != "locked") {
    block.throw_bad_value("joints", "'limp' or 'locked'");
  }
  spec.joints_lock = joints == "locked";
  const char* other = spec.joints_lock ? "friction" : "brake";
  if (block.has(other)) {
    block.throw_bad_value(other, fmt::format("no such key with joints = '{}'", joints));
  }
  spec.friction = block.number("friction", spec.friction);
  spec.brake = block.number("brake", spec.brake);
  return spec;
}

PayloadSpec read_payload(const Block& block) {
  block.allow_only({"com", "volume_per_kg", "cob", "inertia_per_kg", "added_mass_per_kg"});
  PayloadSpec spec;
  spec.com = block.vector("com");
  spec.volume = block.number("volume_per_kg", 0);
  if (block.has("cob")) spec.cob = block.vector("cob");
  if (block.has("inertia_per_kg")) {
    spec.inertia = read_inertia(block, "inertia_per_kg");
  }
  if (block.has("added_mass_per_kg")) spec.added_mass = block.numbers("added_mass_per_kg", 6);
  return spec;
}

template <class Numbers>
std::string all_digits(const Numbers& numbers) {
  return fmt::format("{}", fmt::join(numbers.data(), numbers.data() + numbers.size(), " "));
}

std::string words_of_uncertainty(const UncertaintySpec& spec) {
  std::string words = "; uncertainty";
  for (const auto* table : {&spec.mass, &spec.volume}) {
    words += table == &spec.mass ? " mass" : " volume";
    for (const auto& [name, width] : *table) words += fmt::format(" {} {}", name, width);
  }
  for (const auto* table : {&spec.com, &spec.cob}) {
    words += table == &spec.com ? " com" : " cob";
    for (const auto& [name, v] : *table) words += fmt::format(" {} {}", name, all_digits(v));
  }
  words += fmt::format(" trim {} payload {} at {} thrust {} torque {} current {} of {}", spec.trim,
                       spec.payload_mass, all_digits(spec.payload_com), spec.thrust, spec.torque,
                       spec.current_speed, spec.current_directions);
  for (const Eigen::Vector3d& v : spec.current_vectors) words += " [" + all_digits(v) + "]";
  return words;
}

std::string words_of_loss(const LossSpec& spec) {
  std::string words =
      fmt::format("; loss {} of {}, cases", spec.any, fmt::join(spec.actuators, " "));
  for (const auto& names : spec.cases) words += fmt::format(" [{}]", fmt::join(names, " "));
  return words + fmt::format(", {} {} {}", spec.joints_lock, spec.friction, spec.brake);
}

}  // namespace

void read_wrenches(const Block& wrench, TaskSpec& spec) {
  if (wrench.has("set")) {
    if (wrench.has("c")) wrench.throw_bad_value("c", "no such key beside wrench.set");
    for (const Eigen::VectorXd& c : wrench.rows("set", 6)) spec.set.emplace_back(c);
  }
  if (wrench.has("ball")) {
    const Block ball = wrench.table("ball");
    ball.allow_only({"axes", "radius"});
    spec.ball_axes = ball.texts("axes");
    if (spec.ball_axes.empty()) ball.throw_bad_value("axes", "one or more axes of a wrench");
    spec.ball_radius = ball.number("radius");
  }
  spec.hold = wrench.truth("hold", false);
  if (wrench.has("c") || (!wrench.has("set") && !wrench.has("ball"))) {
    spec.c = wrench.numbers("c", 6);
    // Beside a ball make_problem takes zero for none.
    if (spec.c.isZero(0)) wrench.throw_bad_value("c", "a direction of nonzero length");
  }
}

void read_scenario_tables(const Block& task, TaskSpec& spec) {
  if (task.has("environment")) {
    const Block environment = filled_table(task, "environment");
    environment.allow_only({"current"});
    spec.current = environment.vector("current");
  }
  if (task.has("uncertainty")) {
    spec.uncertainty = read_uncertainty(filled_table(task, "uncertainty"), spec.robot);
  }
  if (task.has("loss")) spec.loss = read_loss(filled_table(task, "loss"));
  if (!task.has("payload")) return;
  if (task.has("wrench")) {
    task.throw_bad_value("wrench", "no such table beside payload, which is the wrench");
  }
  spec.payload = read_payload(filled_table(task, "payload"));
}

std::string words_of_scenarios(const TaskSpec& task) {
  std::string words;
  for (const Vector6d& c : task.set) words += "; and " + all_digits(c);
  if (!task.ball_axes.empty()) {
    words += fmt::format("; ball {} {}", fmt::join(task.ball_axes, " "), task.ball_radius);
  }
  if (task.hold) words += "; hold";
  if (task.current) words += "; current " + all_digits(*task.current);
  if (task.uncertainty) words += words_of_uncertainty(*task.uncertainty);
  if (task.loss) words += words_of_loss(*task.loss);
  if (task.payload) {
    words += fmt::format("; payload {} {}", all_digits(task.payload->com), task.payload->volume);
    if (task.payload->cob) words += " " + all_digits(*task.payload->cob);
    const PayloadSpec& body = *task.payload;
    if (!body.inertia.isZero(0)) words += " inertia " + all_digits(body.inertia);
    if (!body.added_mass.isZero(0)) words += " added mass " + all_digits(body.added_mass);
  }
  return words;
}

}  // namespace maxwrench
