#include "lib/trajectory/limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "lib/robot/chain.h"
#include "lib/trajectory/motion_evaluator.h"

namespace maxwrench {
namespace {

/// [rad or m] The margin of the linearised limits of dependent joints in static tasks. A static
/// posture must satisfy these limits up to rounding (`kLimitTolerance`), but a step satisfies them
/// only to first order.
constexpr double kSpareOfPosture = 1e-7;

/// The joint of a coordinate of theta_r.
const Joint& joint_of(const Problem& problem, Eigen::Index coordinate) {
  return problem.robot
      .joints[static_cast<std::size_t>(problem.redundant[static_cast<std::size_t>(coordinate)])];
}

/// The tolerance of the limits of dependent joints.
double tolerance_of(const Problem& problem) {
  return problem.motion ? kTableTolerance : kLimitTolerance;
}

/// "knots 3 and 4" for the row of a difference; "between knots 3 and 4" for an instant.
std::string place_of(const Eigen::MatrixXd& rows, Eigen::Index row, const SchemeMaps& maps) {
  const Eigen::Index pairs = maps.knots() - 1;
  const int first = maps.starts ? 0 : 1;
  if (&rows == &maps.speed && row < pairs) {
    return "knots " + std::to_string(first + row) + " and " + std::to_string(first + row + 1);
  }
  const Eigen::Index instant = &rows == &maps.speed ? row - pairs : row;
  const Eigen::Index interval = std::min<Eigen::Index>(
      pairs - 1, instant * pairs / std::max<Eigen::Index>(1, maps.instants() - 1));
  return "between knots " + std::to_string(first + interval) + " and " +
         std::to_string(first + interval + 1);
}

std::string text(const char* format, double a, double b, double c) {
  std::array<char, 96> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, a, b, c);
  return buffer.data();
}

/// "knot 3", or "between knots 3 and 4".
std::string place_of_instant(int instant, const SchemeMaps& maps) {
  for (std::size_t knot = 0; knot < maps.knot_at.size(); ++knot) {
    if (maps.knot_at[knot] != instant) continue;
    return "knot " + std::to_string(static_cast<int>(knot) + (maps.starts ? 0 : 1));
  }
  return place_of(maps.place, instant, maps);
}

/// Inserts " at t = ... s" before the colon of a reason.
std::string reason_at(const std::string& reason, double t) {
  const std::size_t colon = reason.find(':');
  return reason.substr(0, colon) + " at t = " + std::to_string(t) + " s" + reason.substr(colon);
}

/// The limited values of a dependent joint: its position and its rate at instants, and its
/// difference from knot to knot divided by dt.
class DependentJoint {
 public:
  DependentJoint(const Problem& problem, const SchemeMaps& maps,
                 const std::vector<Instant>& instants, int joint)
      : joint_(problem.robot.joints[static_cast<std::size_t>(joint)]),
        maps_(maps),
        instants_(instants),
        q_(joint),
        v_(static_cast<int>(problem.robot.base_axes.size()) + joint),
        tolerance_(tolerance_of(problem)) {}

  double place(int i) const { return instants_[static_cast<std::size_t>(i)].q[q_]; }
  double rate(int i) const { return instants_[static_cast<std::size_t>(i)].v[v_]; }
  double difference(int knot) const {
    return (place(instant_of(knot + 1)) - place(instant_of(knot))) / maps_.dt;
  }
  int instant_of(int knot) const { return maps_.knot_at[static_cast<std::size_t>(knot)]; }
  int q() const { return q_; }
  int v() const { return v_; }
  const Joint& joint() const { return joint_; }

  /// Describes the first violation of the joint's limits; empty if there is none.
  std::string violation() const {
    const double low = joint_.q_min, high = joint_.q_max;
    for (int i = maps_.starts ? 1 : 0; i < maps_.instants(); ++i) {
      if (place(i) >= low - tolerance_ && place(i) <= high + tolerance_) continue;
      return "joint limit: " + place_of_instant(i, maps_) + ": " + joint_.name +
             text(" at %.6g, limits %.6g .. %.6g", place(i), low, high);
    }
    for (int knot = 0; knot + 1 < maps_.knots(); ++knot) {
      if (too_fast(difference(knot))) {
        return speeding(place_of(maps_.speed, knot, maps_), difference(knot));
      }
    }
    for (int i = 0; i < maps_.instants(); ++i) {
      if (too_fast(rate(i))) return speeding(place_of_instant(i, maps_), rate(i));
    }
    return {};
  }

 private:
  bool too_fast(double speed) const {
    return !(std::abs(speed) <= joint_.velocity_max + kTableTolerance);
  }
  std::string speeding(const std::string& place, double speed) const {
    return "speed limit: " + place + ": " + joint_.name +
           text(" at %.6g per s, limit %.6g", speed, joint_.velocity_max, 0);
  }

  const Joint& joint_;
  const SchemeMaps& maps_;
  const std::vector<Instant>& instants_;
  int q_, v_;
  double tolerance_;
};

/// Collects `DependentRows`.
class RowCollector {
 public:
  RowCollector(Eigen::Index r, const SchemeMaps& maps) : r_(r), skipped_(maps.before) {}

  /// Begins a row with its value and limits.
  void begin(double at, double low, double high) {
    at_.push_back(at);
    low_.push_back(low);
    high_.push_back(high);
  }
  /// Adds weight times slopes (r) of theta_r's knots, weighted by a row of the scheme, to the row.
  void add(const Eigen::MatrixXd& rows, int i, double weight, const Eigen::MatrixXd& slopes,
           int row) {
    for (Eigen::Index knot = skipped_; knot < rows.cols(); ++knot) {
      if (rows(i, knot) == 0) continue;
      for (Eigen::Index k = 0; k < r_; ++k) {
        entries_.emplace_back(at_.size() - 1, (knot - skipped_) * r_ + k,
                              weight * rows(i, knot) * slopes(row, k));
      }
    }
  }
  DependentRows finish(Eigen::Index columns) const {
    const auto count = static_cast<Eigen::Index>(at_.size());
    DependentRows rows;
    rows.at = Eigen::Map<const Eigen::VectorXd>(at_.data(), count);
    rows.r_min = Eigen::Map<const Eigen::VectorXd>(low_.data(), count);
    rows.r_max = Eigen::Map<const Eigen::VectorXd>(high_.data(), count);
    rows.R.resize(count, columns);
    rows.R.setFromTriplets(entries_.begin(), entries_.end());
    return rows;
  }

 private:
  Eigen::Index r_, skipped_;
  std::vector<double> at_, low_, high_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace

std::string knots_violation(const Problem& problem, const SchemeMaps& maps,
                            const Eigen::MatrixXd& Q) {
  for (Eigen::Index j = 0; j < Q.cols(); ++j) {
    const Joint& joint = joint_of(problem, j);
    const double low = problem.theta_r_min[j], high = problem.theta_r_max[j];
    const auto beyond = [&](double q) {
      return !(q >= low - kTableTolerance && q <= high + kTableTolerance);
    };
    for (Eigen::Index i = maps.before; i < Q.rows() - maps.after; ++i) {
      if (!beyond(Q(i, j))) continue;
      return "joint limit: knot " + std::to_string(i + (maps.starts ? 0 : 1)) + ": " + joint.name +
             text(" at %.6g, limits %.6g .. %.6g", Q(i, j), low, high);
    }
    const Eigen::VectorXd rates = maps.speed * Q.col(j);
    for (Eigen::Index row = 0; row < rates.size(); ++row) {
      if (std::abs(rates[row]) <= joint.velocity_max + kTableTolerance) continue;
      return "speed limit: " + place_of(maps.speed, row, maps) + ": " + joint.name +
             text(" at %.6g per s, limit %.6g", rates[row], joint.velocity_max, 0);
    }
    const Eigen::VectorXd places = maps.place * Q.col(j);
    for (Eigen::Index row = 0; row < places.size(); ++row) {
      if (!beyond(places[row])) continue;
      return "joint limit: " + place_of(maps.place, row, maps) + ": " + joint.name +
             text(" at %.6g, limits %.6g .. %.6g", places[row], low, high);
    }
    const Eigen::VectorXd zeros = maps.zero * Q.col(j);
    for (const double value : zeros) {
      if (std::abs(value) <= kTableTolerance) continue;
      const bool smooth = maps.smooth();
      return std::string(smooth ? "acceleration at knot 0: " : "not at rest: last knots: ") +
             joint.name +
             text(smooth ? ": %.6g times dt^2, expected 0" : " moves by %.6g", value, 0, 0);
    }
  }
  return {};
}

std::string motion_violation(const Problem& problem, const MotionEvaluator& motion,
                             const std::vector<Instant>& instants) {
  for (int i = 0; i < motion.maps().instants(); ++i) {
    const Instant& instant = instants[static_cast<std::size_t>(i)];
    if (i == motion.lost()) return reason_at(motion.lost_reason(), instant.t);
    if (base_reaches(problem.robot, instant.base)) continue;
    return reason_at("unreachable pose: the base would leave its free axes", instant.t);
  }
  for (const int joint : problem.dependent) {
    std::string violation = DependentJoint(problem, motion.maps(), instants, joint).violation();
    if (!violation.empty()) return violation;
  }
  return {};
}

bool dependent_joints_hold(const Problem& problem, const Eigen::VectorXd& q,
                           const Eigen::VectorXd& v) {
  const std::size_t axes = problem.robot.base_axes.size();
  return std::all_of(problem.dependent.begin(), problem.dependent.end(), [&](int number) {
    const auto index = static_cast<std::size_t>(number);
    const Joint& joint = problem.robot.joints[index];
    const double place = q[number], rate = v[static_cast<Eigen::Index>(axes + index)];
    return place >= joint.q_min - tolerance_of(problem) &&
           place <= joint.q_max + tolerance_of(problem) &&
           std::abs(rate) <= joint.velocity_max + kTableTolerance;
  });
}

DependentRows make_dependent_rows(const Problem& problem, const MotionEvaluator& motion,
                                  const std::vector<Instant>& instants,
                                  const std::vector<MotionSlopes>& slopes) {
  const SchemeMaps& maps = motion.maps();
  RowCollector rows(problem.redundancy(), maps);
  const auto at = [&](int i) -> const auto& { return slopes[static_cast<std::size_t>(i)]; };
  const double spare = problem.motion ? 0 : kSpareOfPosture;
  for (const int number : problem.dependent) {
    const DependentJoint following(problem, maps, instants, number);
    const Joint& joint = following.joint();
    const double speed = joint.velocity_max;
    for (int i = maps.starts ? 1 : 0; i < maps.instants(); ++i) {
      if (joint.q_min > -kInfinity || joint.q_max < kInfinity) {
        rows.begin(following.place(i), joint.q_min + spare, joint.q_max - spare);
        rows.add(maps.P, i, 1, at(i).q_place, following.q());
      }
      if (speed == kInfinity) continue;
      rows.begin(following.rate(i), -speed, speed);
      rows.add(maps.P, i, 1, at(i).v_place, following.v());
      rows.add(maps.V, i, 1, at(i).v_rate, following.v());
    }
    for (int knot = 0; knot + 1 < maps.knots() && speed < kInfinity; ++knot) {
      const int from = following.instant_of(knot), to = following.instant_of(knot + 1);
      rows.begin(following.difference(knot), -speed, speed);
      rows.add(maps.P, from, -1 / maps.dt, at(from).q_place, following.q());
      rows.add(maps.P, to, 1 / maps.dt, at(to).q_place, following.q());
    }
  }
  return rows.finish(problem.redundancy() * maps.rows());
}

KnotRows knot_rows(const Problem& problem, const MotionTask& task, const SchemeMaps& maps) {
  const Eigen::Index r = problem.redundancy(), skipped = maps.before, k = maps.rows();
  const Eigen::Index rows = maps.speed.rows() + maps.place.rows() + maps.zero.rows();
  KnotRows result;
  result.R.resize(rows * r, k * r);
  result.r_min.resize(rows * r);
  result.r_max.resize(rows * r);
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::Index at = 0;
  const auto add = [&](const Eigen::RowVectorXd& row, Eigen::Index j, double low, double high) {
    for (Eigen::Index i = 0; i < k; ++i) {
      if (row[i + skipped] != 0) entries.emplace_back(at, i * r + j, row[i + skipped]);
    }
    double fixed = skipped > 0 ? row[0] * task.theta_0[j] : 0;
    if (maps.after > 0) fixed += row[row.size() - 1] * task.theta_T[j];
    result.r_min[at] = low - fixed;
    result.r_max[at++] = high - fixed;
  };
  for (Eigen::Index j = 0; j < r; ++j) {
    const double speed = joint_of(problem, j).velocity_max;
    for (const auto row : maps.speed.rowwise()) add(row, j, -speed, speed);
    for (const auto row : maps.place.rowwise()) {
      add(row, j, problem.theta_r_min[j], problem.theta_r_max[j]);
    }
    for (const auto row : maps.zero.rowwise()) add(row, j, 0, 0);
  }
  result.R.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace maxwrench
