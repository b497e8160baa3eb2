#include "verify/trajectory/effort_law.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace maxwrench {
namespace {

/// The time about an edge is cut in halves this often at most.
constexpr int kMostHalvings = 8;

/// [m; 1] The base may be this far off its free axes, which the knots' rounding can cause.
constexpr double kOffFreeAxes = 1e-6;

using NarrowRows = std::vector<std::vector<Narrow>>;

NarrowRows narrowed(const WideRows& M) {
  NarrowRows rows;
  for (const std::vector<Wide>& row : M) {
    std::vector<Narrow>& added = rows.emplace_back();
    for (const Wide& x : row) added.push_back(narrow(x));
  }
  return rows;
}

Narrow product(const std::vector<Narrow>& row, const std::vector<Narrow>& x) {
  Narrow sum;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (row[i].is_zero() || x[i].is_zero()) continue;
    sum = sum.is_zero() ? row[i] * x[i] : sum + row[i] * x[i];
  }
  return sum;
}

/// The name of an actuator: a thruster or a joint.
const std::string& actuator_name(const Robot& robot, std::size_t i) {
  const std::size_t thrusters = robot.thrusters.size();
  return i < thrusters ? robot.thrusters[i].name : robot.joints[i - thrusters].name;
}

std::string in_digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

/// Upper bounds of a quadratic for |s| <= r, and of its negative.
double most(const std::array<Narrow, 3>& y, const Narrow& r) {
  const Narrow rise(y[1].magnitude()), bend(y[2].high <= 0 ? 0 : y[2].high);
  return (Narrow(y[0].high) + r * (rise + r * bend)).high;
}
double least(const std::array<Narrow, 3>& y, const Narrow& r) {
  return -most({-y[0], -y[1], -y[2]}, r);
}

/// A quadratic in s/H about another place, as one in s.
std::array<Narrow, 3> moved_to(const std::array<Narrow, 3>& y, const Narrow& place,
                               const Narrow& H) {
  return {y[0] + place * (y[1] + place * y[2]), (y[1] + 2.0 * (place * y[2])) / H, y[2] / H / H};
}

}  // namespace

NarrowRows narrow_pseudoinverse(const Problem& problem) {
  try {
    return narrowed(enclose_pseudoinverse(problem.robot.actuation.B));
  } catch (const std::invalid_argument&) {
    throw std::invalid_argument(problem.name +
                                ": got actuators that do not reach all generalised forces, "
                                "expected B of full row rank for a proof in time");
  }
}

EffortLaw::EffortLaw(const TrajectoryModel& model, const TrajectoryCertificate& proof)
    : model_(model),
      proof_(proof),
      B_(narrowed(to_wide(model.problem().robot.actuation.B))),
      B_pinv_(narrow_pseudoinverse(model.problem())) {
  const int edges = proof.parts * model.curve().intervals();
  length_ = narrow(Wide(model.problem().motion->T) / Wide(static_cast<long double>(edges)));
}

MotionFault EffortLaw::check(int interval, int edge, long& slices) const {
  struct Slice {
    double from, to;
    int halvings;
  };
  std::vector<Slice> open = {{edge == 0 ? 0 : -0.5, edge == proof_.parts ? 0 : 0.5, 0}};
  while (!open.empty()) {
    const Slice slice = open.back();
    open.pop_back();
    ++slices;
    MotionFault fault = check_slice(interval, edge, slice.from, slice.to);
    if (fault.reason.empty()) continue;
    if (slice.halvings == kMostHalvings) return fault;
    const double middle = (slice.from + slice.to) / 2;
    open.push_back({middle, slice.to, slice.halvings + 1});
    open.push_back({slice.from, middle, slice.halvings + 1});
  }
  return {};
}

/// The B-spline about an edge, by powers of s/H. `at` is the control point of this edge.
auto EffortLaw::spline(const double* at, Eigen::Index stride, int edge) const -> Quadratic {
  const Narrow own(at[0]);
  if (edge == 0) return {own, Narrow(at[stride]) - own, Narrow()};
  const Narrow before(at[-stride]);
  if (edge == proof_.parts) return {own, own - before, Narrow()};
  const Narrow after(at[stride]), sum = before + after;
  return {0.125 * (sum + 6.0 * own), 0.5 * (after - before), 0.5 * (sum - 2.0 * own)};
}

/// `place`: of the slice, in s/H.
auto EffortLaw::efforts(int interval, int edge, const Narrow& place, const MotionLoads<1>& at,
                        const MotionLoads<2>& over) const -> std::vector<Quadratic> {
  const Eigen::Index column = Eigen::Index{proof_.parts} * interval + edge;
  const auto m = static_cast<std::size_t>(proof_.y.rows());
  const Narrow middle((place.low + place.high) / 2);
  std::array<std::vector<Narrow>, 3> y, left;  // left of the balance, without B^+
  for (std::size_t i = 0; i < m; ++i) {
    const Quadratic own =
        spline(&proof_.y(static_cast<Eigen::Index>(i), column), proof_.y.rows(), edge);
    const Quadratic here = moved_to(own, middle, length_);
    for (std::size_t k = 0; k < 3; ++k) y[k].push_back(here[k]);
  }
  Quadratic w = {Narrow(proof_.value), Narrow(), Narrow()}, w_over = w;
  if (proof_.w.size() > 0) {
    const Quadratic own = spline(&proof_.w[column], 1, edge);
    w = moved_to(own, middle, length_);
    w_over = moved_to(own, place, length_);
  }
  for (std::size_t i = 0; i < at.tau_d.size(); ++i) {
    const auto& tau = at.tau_d[i].c;
    const auto& a = at.along_c[i].c;
    const auto& a_over = over.along_c[i].c;
    left[0].push_back(tau[0] + a[0] * w[0] - product(B_[i], y[0]));
    left[1].push_back(tau[1] + a[1] * w[0] + a[0] * w[1] - product(B_[i], y[1]));
    left[2].push_back(over.tau_d[i].c[2] + a_over[2] * w_over[0] + a_over[1] * w_over[1] +
                      a_over[0] * w_over[2] - product(B_[i], y[2]));
  }
  std::vector<Quadratic> u(m);
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t k = 0; k < 3; ++k) u[i][k] = y[k][i] + product(B_pinv_[i], left[k]);
  }
  return u;
}

/// An actuator without a column in B and in B^+ has the effort y, here zero at all times.
bool EffortLaw::exerts_nothing(std::size_t actuator) const {
  const auto row = static_cast<Eigen::Index>(actuator);
  const Zonotope& set = model_.problem().robot.actuation;
  return set.B.col(row).isZero(0) && set.u_min[row] <= 0 && set.u_max[row] >= 0 &&
         proof_.y.row(row).isZero(0);
}

/// The thrust of a lagged thruster follows from the command u + T u_dot, which has its limits, too.
MotionFault EffortLaw::check_limits(std::size_t actuator, const Quadratic& u,
                                    const Narrow& r) const {
  const Robot& robot = model_.problem().robot;
  const MotionTask& task = *model_.problem().motion;
  const auto row = static_cast<Eigen::Index>(actuator);
  const double u_max = robot.actuation.u_max[row], u_min = robot.actuation.u_min[row];
  const auto beyond = [&](const char* what, const Quadratic& x) -> MotionFault {
    const double high = most(x, r), low = least(x, r);
    if (high <= u_max && low >= u_min) return {};
    const bool above = !(high <= u_max);
    return {what + actuator_name(robot, actuator) + " may be " + in_digits(above ? high : low) +
            ", beyond its limit " + in_digits(above ? u_max : u_min)};
  };
  MotionFault fault = beyond("the effort of ", u);
  if (fault.reason.empty() && actuator < robot.thrusters.size() && task.thruster_lag > 0 &&
      u_min < u_max) {
    const Narrow lag(task.thruster_lag);
    fault = beyond("the command of ", {u[0] + lag * u[1], u[1] + 2.0 * (lag * u[2]), u[2]});
  }
  const double limit = robot.u_rate_max[row];
  if (!fault.reason.empty() || !task.rates || !(limit < kInfinity)) return fault;
  const double rate = (Narrow(u[1].magnitude()) + r * (2.0 * Narrow(u[2].magnitude()))).high;
  if (rate <= limit) return {};
  return {"the effort of " + actuator_name(robot, actuator) + " may change at a rate of " +
          in_digits(rate) + ", beyond its limit " + in_digits(limit)};
}

MotionFault EffortLaw::check_slice(int interval, int edge, double from, double to) const {
  const auto place = [&](const Narrow& at) {
    const Narrow x =
        (Narrow(static_cast<double>(edge)) + at) / Narrow(static_cast<double>(proof_.parts));
    return Narrow(std::max(x.low, 0.0), std::min(x.high, 1.0));
  };
  const double middle = (from + to) / 2;
  const double t = model_.time(interval, (edge + middle) / proof_.parts);
  const std::optional<MotionLoads<1>> at = model_.loads<3>(interval, place(middle));
  const std::optional<MotionLoads<2>> over = model_.loads<4>(interval, place({from, to}));
  if (!at || !over) return {kNotEnclosed, t};
  const Narrow r = ((to - from) / 2) * length_;
  MotionFault fault;
  const std::vector<Quadratic> u = efforts(interval, edge, {from, to}, *at, *over);
  for (std::size_t i = 0; i < u.size() && fault.reason.empty(); ++i) {
    if (!exerts_nothing(i)) fault = check_limits(i, u[i], r);
  }
  for (std::size_t i = 0; i < at->off_axes.size() && fault.reason.empty(); ++i) {
    const Quadratic off = {at->off_axes[i].c[0], at->off_axes[i].c[1], over->off_axes[i].c[2]};
    if (!(most(off, r) <= kOffFreeAxes) || !(least(off, r) >= -kOffFreeAxes)) {
      fault.reason = "the base may leave its free axes";
    }
  }
  if (!fault.reason.empty()) fault.t = t;
  return fault;
}

}  // namespace maxwrench
