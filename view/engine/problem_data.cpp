#include "view/engine/problem_data.h"

#include <stdexcept>
#include <type_traits>
#include <utility>

#include "lib/math/fnv.h"
#include "problems/collision/collision.h"
#include "verify/bytes.h"

namespace maxwrench {

/// Stores paths, whose members nothing else sees.
struct PathMembers {
  template <class Put>
  static void put_all(Path& x, const Put& put) {
    put(x.start_, x.axis_, x.centre_, x.displacement_, x.angle_, x.duration_, x.timing_, x.times_,
        x.values_, x.bends_);
  }
};

namespace {

/// The first bytes. The number is the version of everything that follows.
constexpr std::string_view kBegin = "maxwrench task 4\n";
constexpr std::size_t kChecksumBytes = 8;

/// Writes values. `Reading` has the same functions, so each type's members are listed once.
class Writing {
 public:
  void real(double& x) { bytes_.real(x); }
  void whole(std::int64_t& x) { bytes_.whole(static_cast<std::uint64_t>(x), 8); }
  void text(std::string& x) { bytes_.words(x); }
  void matrix(Eigen::MatrixXd& M) { bytes_.matrix(M); }
  /// The number of elements of a list.
  std::size_t count(std::size_t n) {
    bytes_.count(static_cast<Eigen::Index>(n));
    return n;
  }
  void expect(bool /*good*/) {}
  const std::string& bytes() const { return bytes_.text(); }

 private:
  ByteWriter bytes_;
};

/// Reads what `Writing` wrote, into values of any earlier content.
class Reading {
 public:
  explicit Reading(std::string_view bytes) : bytes_(bytes) {}
  void real(double& x) { x = bytes_.real(); }
  void whole(std::int64_t& x) { x = static_cast<std::int64_t>(bytes_.whole(8)); }
  void text(std::string& x) { x = bytes_.words(); }
  void matrix(Eigen::MatrixXd& M) { M = bytes_.matrix(); }
  std::size_t count(std::size_t /*n*/) { return bytes_.count(1); }
  void expect(bool good) { good_ = good_ && good; }
  bool complete() const { return good_ && bytes_.at_end(); }

 private:
  ByteReader bytes_;
  bool good_ = true;
};

template <class Archive>
void put(Archive& to, double& x) {
  to.real(x);
}
template <class Archive>
void put(Archive& to, std::string& x) {
  to.text(x);
}
/// A whole number, a truth value or an enumerator.
template <class Archive, class T>
requires(std::is_integral_v<T> || std::is_enum_v<T>) void put(Archive& to, T& x) {
  auto number = static_cast<std::int64_t>(x);
  to.whole(number);
  x = static_cast<T>(number);
  to.expect(static_cast<std::int64_t>(x) == number);
}
/// A matrix of any storage order. Sizes that the type fixes are written too, and checked.
template <class Archive, class T, int rows, int columns, int options>
void put(Archive& to, Eigen::Matrix<T, rows, columns, options>& M) {
  Eigen::MatrixXd numbers = M;
  to.matrix(numbers);
  const bool fits = (rows == Eigen::Dynamic || numbers.rows() == rows) &&
                    (columns == Eigen::Dynamic || numbers.cols() == columns);
  to.expect(fits);
  if (fits) M = numbers;
}
template <class Archive>
void put(Archive& to, Pose<double>& pose) {
  put(to, pose.R);
  put(to, pose.p);
}

template <class Archive, class T>
void put(Archive& to, std::vector<T>& list);
template <class Archive, class T>
void put(Archive& to, std::optional<T>& value) {
  bool has = value.has_value();
  put(to, has);
  if (has && !value) value.emplace();
  if (has) put(to, *value);
}
template <class Archive>
void put(Archive& to, std::pair<std::string, std::string>& pair) {
  put(to, pair.first);
  put(to, pair.second);
}

template <class Archive, class... Members>
void put_all(Archive& to, Members&... members) {
  (put(to, members), ...);
}

template <class Archive>
void put(Archive& to, HydrodynamicBody& x) {
  put_all(to, x.frame, x.added_mass, x.damping_linear, x.damping_quadratic);
}
template <class Archive>
void put(Archive& to, Link& x) {
  put_all(to, x.name, x.mass, x.com, x.inertia, x.volume, x.cob, x.hydrodynamics);
}
template <class Archive>
void put(Archive& to, Gear& x) {
  put_all(to, x.leader, x.ratio, x.offset);
}
template <class Archive>
void put(Archive& to, Joint& x) {
  put_all(to, x.name, x.type, x.parent, x.placement, x.axis, x.q_min, x.q_max, x.velocity_max,
          x.effort_max, x.gear);
}
template <class Archive>
void put(Archive& to, Thruster& x) {
  put_all(to, x.name, x.position, x.direction, x.force_min, x.force_max, x.force_rate_max);
}
template <class Archive>
void put(Archive& to, EndEffector& x) {
  put_all(to, x.name, x.link, x.placement);
}
template <class Archive>
void put(Archive& to, Zonotope& x) {
  put_all(to, x.B, x.u_min, x.u_max, x.rank, x.B_pinv, x.has_facets, x.N, x.b_min, x.b_max);
}
template <class Archive>
void put(Archive& to, Shape& x) {
  put_all(to, x.body, x.link, x.kind, x.placement, x.radius, x.half_length, x.half_sizes, x.points);
}
template <class Archive>
void put(Archive& to, Collision& x) {
  put_all(to, x.shapes, x.ignore, x.margin);
}
template <class Archive>
void put(Archive& to, Robot& x) {
  put_all(to, x.name, x.base_axes, x.mount, x.links, x.joints, x.thrusters, x.end_effectors,
          x.gravity, x.water_density, x.current, x.trim.buoyancy_mass, x.trim.position, x.actuation,
          x.u_rate_max, x.limits);
}
template <class Archive>
void put(Archive& to, Contact& x) {
  put_all(to, x.end_effector, x.surface, x.frame, x.radius, x.C, x.w_min, x.w_max, x.holds_axes,
          x.follow, x.q_rest, x.length_scale, x.sigma_min, x.rank);
}
template <class Archive>
void put(Archive& to, CarriedBody& x) {
  put_all(to, x.com, x.inertia, x.volume, x.cob, x.added_mass);
}
template <class Archive>
void put(Archive& to, WrenchTable& x) {
  put_all(to, x.t, x.wrenches);
}
template <class Archive>
void put(Archive& to, MotionTask& x) {
  PathMembers::put_all(x.path, [&to](auto&... members) { put_all(to, members...); });
  put_all(to, x.impulse, x.transfer, x.T, x.k, x.scheme, x.instants_per_interval, x.rates,
          x.c_turns, x.t_h, x.start, x.theta_0, x.theta_T, x.payload, x.table);
}
template <class Archive>
void put(Archive& to, LinkLoad& x) {
  put_all(to, x.link, x.mass, x.moment);
}
template <class Archive>
void put(Archive& to, LoadCase& x) {
  put_all(to, x.name, x.loads, x.current);
}
/// The rest follows from the robot's own actuation.
template <class Archive>
void put(Archive& to, ScenarioLimits& x) {
  put_all(to, x.name, x.actuation.u_min, x.actuation.u_max);
}
template <class Archive>
void put(Archive& to, ScenarioWrench& x) {
  put_all(to, x.name, x.c, x.hold);
}
template <class Archive>
void put(Archive& to, WrenchBall& x) {
  put_all(to, x.E, x.radius);
}
template <class Archive>
void put(Archive& to, CarriedLoad& x) {
  put_all(to, x.wet_mass, x.moment);
}
/// The unit is a text that lasts as long as the program.
template <class Archive>
void put(Archive& to, ScenarioList& x) {
  std::string unit = x.unit;
  put_all(to, x.wrenches, x.ball, x.payload, x.F, x.limits, x.loads, x.non_negative, unit);
  for (const char* known : {"", "N", "N m", "mixed", "kg", "-"}) {
    if (unit == known) x.unit = known;
  }
  to.expect(unit == x.unit);
}
template <class Archive>
void put(Archive& to, Problem& x) {
  put_all(to, x.name, x.label, x.digest, x.robot, x.end_effector, x.pose, x.free.axes,
          x.free.along_end_effector, x.free.wrench_turns, x.c, x.W_any, x.reference, x.desired,
          x.wrench_axes, x.wrench_in_end_effector, x.redundant, x.dependent, x.guess_q,
          x.guess_base, x.contact, x.theta_r_min, x.theta_r_max, x.theta_r_default, x.motion,
          x.scenarios);
}

template <class Archive, class T>
void put(Archive& to, std::vector<T>& list) {
  list.resize(to.count(list.size()));
  for (T& x : list) put(to, x);
}

std::string checksum(std::string_view bytes) {
  ByteWriter sum;
  sum.whole(fnv1a(bytes), kChecksumBytes);
  return sum.text();
}

}  // namespace

std::string why_no_engine(const Problem& problem) {
  if (problem.robot.collision && !made_of(*problem.robot.collision)) {
    return problem.name + ": a collision check of its own, expected that of the robot's shapes";
  }
  if (problem.motion && !problem.scenarios.empty()) {
    return problem.name + ": a list of scenarios in time, expected one wrench";
  }
  if (problem.motion && problem.motion->thruster_lag != 0) {
    return problem.name + ": a lag of thrusters, expected thrust without lag";
  }
  return "";
}

std::string problem_data(const Problem& problem) {
  const std::string why = why_no_engine(problem);
  if (!why.empty()) throw std::invalid_argument(why);
  Problem task = problem;
  std::optional<Collision> collision;
  if (task.robot.collision) collision = made_of(*task.robot.collision);
  Writing to;
  put_all(to, task, collision);
  const std::string bytes = std::string(kBegin) + to.bytes();
  return bytes + checksum(bytes);
}

Problem read_problem(std::string_view data) {
  const auto reject = [](const char* got) {
    throw std::invalid_argument(std::string("task data: got ") + got +
                                ", expected data that this version wrote");
  };
  if (!data.starts_with(kBegin)) reject("data of another kind or version");
  if (data.size() < kBegin.size() + kChecksumBytes) reject("data that end too early");
  const std::string_view bytes = data.substr(0, data.size() - kChecksumBytes);
  if (data.substr(bytes.size()) != checksum(bytes)) reject("damaged data");
  Problem problem;
  std::optional<Collision> collision;
  Reading from(bytes.substr(kBegin.size()));
  put_all(from, problem, collision);
  if (!from.complete()) reject("other data");
  Zonotope& actuation = problem.robot.actuation;
  index_normals(actuation);
  for (ScenarioLimits& limits : problem.scenarios.limits) {
    limits.actuation = with_limits(actuation, limits.actuation.u_min, limits.actuation.u_max);
  }
  if (collision) {
    problem.robot.collision =
        make_collision_checker(std::move(collision->shapes), collision->ignore, collision->margin);
  }
  prepare_ik_solutions(problem);
  return problem;
}

}  // namespace maxwrench
