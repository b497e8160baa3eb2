#include "problems/make/payload.h"

#include <fmt/format.h>

#include <cmath>

#include "lib/math/rotated.h"
#include "problems/make/bad_value.h"
#include "problems/make/robot.h"

namespace maxwrench {
namespace {

constexpr double kMostPerUnit = 1e9;    // N or N m, of 1 kg or a factor of 1
constexpr double kLeastPerUnit = 1e-9;  // likewise

/// Rejects the keys of wrenches beside another way to give them.
void require_no_wrenches(const TaskSpec& task, const char* beside) {
  const auto require_none = [beside](bool given, const char* key) {
    if (!given) return;
    throw BadValue(key, "a value", fmt::format("no such key beside {}: it is the wrench", beside));
  };
  require_none(!task.c.isZero(0), "wrench.c");
  require_none(!task.set.empty(), "wrench.set");
  require_none(!task.ball_axes.empty() || task.ball_radius != 0, "wrench.ball");
  require_none(task.hold, "wrench.hold");
}

/// Rejects a task in time without one motion between the knots.
void require_one_factor(const MotionTask& motion, const char* key) {
  if (motion.impulse) throw BadValue(key, "a table", "no such key in an impulse");
  if (motion.scheme == Scheme::kSpline) return;
  throw BadValue(
      "motion.scheme", to_string(motion.scheme),
      fmt::format("spline beside {}: other schemes have no accelerations of the path", key));
}

/// The payload in motion. [m^2]
CarriedBody body_of(const PayloadSpec& payload) {
  return {.com = payload.com,
          .inertia = payload.inertia,
          .volume = payload.volume,
          .cob = payload.cob.value_or(payload.com),
          .added_mass = payload.added_mass};
}

void require_payload(const PayloadSpec& payload, double water_density) {
  require_numbers("payload.com", payload.com, 3);
  require_non_negative("payload.volume_per_kg", payload.volume);
  if (water_density == 0 && payload.volume > 0) {
    throw BadValue("payload.volume_per_kg", shown(payload.volume),
                   "no such key in air: environment.water_density is 0");
  }
  require_numbers("payload.cob", payload.cob.value_or(payload.com), 3);
  require_numbers("payload.inertia_per_kg", payload.inertia.reshaped(), 9);
  if (const auto bad = why_no_body("payload", 1, payload.inertia)) {
    throw BadValue("payload.inertia_per_kg", bad->got, bad->expected);
  }
  require_numbers("payload.added_mass_per_kg", payload.added_mass, 6);
  require_coefficients("payload.added_mass_per_kg", payload.added_mass);
}

/// Rejects a payload whose forces in motion could not be computed.
void require_moderate(const PayloadSpec& payload, double weight) {
  const auto require = [](const char* key, const Eigen::VectorXd& numbers) {
    if (numbers.lpNorm<Eigen::Infinity>() <= kMostPerUnit) return;
    throw BadValue(key, shown(numbers), fmt::format("numbers of at most {:g}", kMostPerUnit));
  };
  require("payload.com", payload.com);
  require("payload.cob", payload.cob.value_or(payload.com));
  require("payload.inertia_per_kg", payload.inertia.reshaped());
  require("payload.added_mass_per_kg", payload.added_mass);
  if (weight <= kMostPerUnit) return;
  throw BadValue("payload", fmt::format("a wrench of {:g} per kg", weight),
                 fmt::format("one of at most {:g} N or N m per kg", kMostPerUnit));
}

}  // namespace

void set_payload(const TaskSpec& task, Problem& problem) {
  const PayloadSpec& payload = *task.payload;
  require_no_wrenches(task, "payload");
  if (task.wrench_in_end_effector) {
    throw BadValue("wrench.frame", "a value", "no such key beside payload: it is the wrench");
  }
  require_payload(payload, problem.robot.water_density);
  const CarriedBody body = body_of(payload);
  const double displaced = problem.robot.water_density * body.volume;
  CarriedLoad load;
  load.wet_mass = 1 - displaced;
  load.moment = body.com - displaced * body.cob;
  const Eigen::Vector3d up = problem.robot.gravity * Eigen::Vector3d::UnitZ();
  Vector6d c;
  c << load.wet_mass * up, (problem.pose.R * load.moment).cross(up);
  const bool weighs = c.stableNorm() >= kLeastPerUnit && c.stableNorm() <= kMostPerUnit;
  if (problem.motion) {
    require_one_factor(*problem.motion, "payload");
    require_moderate(payload, c.stableNorm());
    if (problem.motion->table) {
      throw BadValue("wrench.file", "a table", "no such key beside payload: it is the wrench");
    }
    problem.motion->payload = body;
    problem.c = Vector6d::Unit(2);  // in motion a body without weight has its inertia
    if (weighs) problem.c = c.stableNormalized();
    problem.scenarios.wrenches = {{.name = "", .c = problem.c}};
    problem.scenarios.unit = "kg";
    return;
  }
  if (c.stableNorm() > kMostPerUnit) require_moderate(payload, c.stableNorm());
  if (!weighs) {
    throw BadValue("payload", fmt::format("a wrench of {:g} per kg", c.stableNorm()),
                   "a payload with weight in water");
  }
  problem.scenarios.payload = load;
  problem.scenarios.wrenches = {{.name = "", .c = c}};
  problem.scenarios.unit = "kg";
  problem.scenarios.non_negative = true;
  problem.c = c.stableNormalized();
}

void set_table(const TaskSpec& task, Problem& problem) {
  constexpr double kSameTime = 1e-9;  // relative
  require_no_wrenches(task, "wrench.file");
  require_one_factor(*problem.motion, "wrench.file");
  if (task.any) {
    throw BadValue("wrench.any", "a list", "no such key beside wrench.file: it is pure");
  }
  const WrenchTable& table = *problem.motion->table;
  const std::size_t count = table.t.size();
  if (count < 2 || table.wrenches.cols() != static_cast<Eigen::Index>(count)) {
    throw BadValue("wrench.file",
                   fmt::format("{} times and {} wrenches", count, table.wrenches.cols()),
                   "as many, two or more");
  }
  for (std::size_t i = 0; i < count; ++i) {
    require_numbers("wrench.file", table.wrenches.col(static_cast<Eigen::Index>(i)), 6);
    const bool rises = i == 0 ? table.t[0] == 0 : table.t[i] > table.t[i - 1];
    if (rises && std::isfinite(table.t[i])) continue;
    throw BadValue("wrench.file", fmt::format("t = {:g}", table.t[i]), "times that rise from 0");
  }
  const double T = problem.motion->T;
  if (!(std::abs(table.t.back() - T) <= kSameTime * T)) {
    throw BadValue("wrench.file", fmt::format("a last t of {:g} s", table.t.back()),
                   fmt::format("the duration of the task, {:g} s", T));
  }
  Eigen::Index largest = 0;
  const double norm = table.wrenches.colwise().norm().maxCoeff(&largest);
  if (!(norm >= kLeastPerUnit && norm <= kMostPerUnit)) {
    throw BadValue("wrench.file", fmt::format("wrenches of at most {:g}", norm),
                   fmt::format("a wrench from {:g} to {:g} N or N m", kLeastPerUnit, kMostPerUnit));
  }
  problem.c = rotated(problem.wrench_axes, table.wrenches.col(largest).stableNormalized());
  problem.scenarios.wrenches = {{.name = "", .c = problem.c}};
  problem.scenarios.unit = "-";
}

}  // namespace maxwrench
