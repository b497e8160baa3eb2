#include "verify/trajectory/effort_law.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace maxwrench {
namespace {

/// The time between two edges is cut in halves this often at most.
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

MotionFault EffortLaw::check(int interval, int part, long& slices) const {
  struct Slice {
    double from, to;
    int halvings;
  };
  std::vector<Slice> open = {{0, 1, 0}};
  while (!open.empty()) {
    const Slice slice = open.back();
    open.pop_back();
    ++slices;
    MotionFault fault = check_slice(interval, part, slice.from, slice.to);
    if (fault.reason.empty()) continue;
    if (slice.halvings == kMostHalvings) return fault;
    const double middle = (slice.from + slice.to) / 2;
    open.push_back({middle, slice.to, slice.halvings + 1});
    open.push_back({slice.from, middle, slice.halvings + 1});
  }
  return {};
}

auto EffortLaw::efforts(int interval, int part, double from, double to,
                        const std::vector<Jet<1>>& tau_d, const std::vector<Jet<1>>& a,
                        const std::vector<Jet<2>>& tau_d_over,
                        const std::vector<Jet<2>>& a_over) const -> std::vector<Quadratic> {
  const Eigen::Index edge = Eigen::Index{proof_.parts} * interval + part;
  const double middle = (from + to) / 2;
  const auto between = [&](double y_0, double y_1, double at) {
    return Narrow(y_0) + at * (Narrow(y_1) - Narrow(y_0));
  };
  const auto m = static_cast<std::size_t>(proof_.y.rows());
  std::vector<Narrow> y(m), y_rate(m);
  for (std::size_t i = 0; i < m; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    y[i] = between(proof_.y(row, edge), proof_.y(row, edge + 1), middle);
    y_rate[i] = (Narrow(proof_.y(row, edge + 1)) - Narrow(proof_.y(row, edge))) / length_;
  }
  Narrow w(proof_.value), w_rate, w_over = w;
  if (proof_.w.size() > 0) {
    const double w_0 = proof_.w[edge], w_1 = proof_.w[edge + 1];
    w = between(w_0, w_1, middle);
    w_rate = (Narrow(w_1) - Narrow(w_0)) / length_;
    const Narrow first = between(w_0, w_1, from), last = between(w_0, w_1, to);
    w_over = {std::min(first.low, last.low), std::max(first.high, last.high)};
  }
  std::array<std::vector<Narrow>, 3> left;  // of the balance, without B^+
  for (std::size_t i = 0; i < tau_d.size(); ++i) {
    left[0].push_back(tau_d[i].c[0] + a[i].c[0] * w - product(B_[i], y));
    left[1].push_back(tau_d[i].c[1] + a[i].c[1] * w + a[i].c[0] * w_rate - product(B_[i], y_rate));
    left[2].push_back(tau_d_over[i].c[2] + a_over[i].c[2] * w_over + a_over[i].c[1] * w_rate);
  }
  std::vector<Quadratic> u;
  for (std::size_t i = 0; i < m; ++i) {
    u.push_back({y[i] + product(B_pinv_[i], left[0]), y_rate[i] + product(B_pinv_[i], left[1]),
                 product(B_pinv_[i], left[2])});
  }
  return u;
}

MotionFault EffortLaw::check_limits(std::size_t actuator, const Quadratic& u,
                                    const Narrow& r) const {
  const Robot& robot = model_.problem().robot;
  const auto row = static_cast<Eigen::Index>(actuator);
  const double high = most(u, r), low = least(u, r);
  const double u_max = robot.actuation.u_max[row], u_min = robot.actuation.u_min[row];
  if (!(high <= u_max) || !(low >= u_min)) {
    const bool above = !(high <= u_max);
    return {"the effort of " + actuator_name(robot, actuator) + " may be " +
            in_digits(above ? high : low) + ", beyond its limit " +
            in_digits(above ? u_max : u_min)};
  }
  const double limit = robot.u_rate_max[row];
  if (!model_.problem().motion->rates || !(limit < kInfinity)) return {};
  const double rate = (Narrow(u[1].magnitude()) + r * (2.0 * Narrow(u[2].magnitude()))).high;
  if (rate <= limit) return {};
  return {"the effort of " + actuator_name(robot, actuator) + " may change at a rate of " +
          in_digits(rate) + ", beyond its limit " + in_digits(limit)};
}

MotionFault EffortLaw::check_slice(int interval, int part, double from, double to) const {
  const Narrow parts(static_cast<double>(proof_.parts));
  const auto place = [&](const Narrow& at) {
    const Narrow x = (Narrow(static_cast<double>(part)) + at) / parts;
    return Narrow(std::max(x.low, 0.0), std::min(x.high, 1.0));
  };
  const double middle = (from + to) / 2;
  const MotionLoads<1> at = model_.loads<3>(interval, place(middle));
  const MotionLoads<2> over = model_.loads<4>(interval, place({from, to}));
  const Narrow r = ((to - from) / 2) * length_;
  MotionFault fault;
  const std::vector<Quadratic> u =
      efforts(interval, part, from, to, at.tau_d, at.along_c, over.tau_d, over.along_c);
  for (std::size_t i = 0; i < u.size() && fault.reason.empty(); ++i) {
    fault = check_limits(i, u[i], r);
  }
  for (std::size_t i = 0; i < at.off_axes.size() && fault.reason.empty(); ++i) {
    const Quadratic off = {at.off_axes[i].c[0], at.off_axes[i].c[1], over.off_axes[i].c[2]};
    if (!(most(off, r) <= kOffFreeAxes) || !(least(off, r) >= -kOffFreeAxes)) {
      fault.reason = "the base may leave its free axes";
    }
  }
  const double x = (part + middle) / proof_.parts;
  if (!fault.reason.empty()) fault.t = model_.time(interval, x);
  return fault;
}

}  // namespace maxwrench
