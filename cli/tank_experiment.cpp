#include "cli/tank_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cli/svg.h"
#include "solvers/strategies.h"

namespace maxwrench {
namespace {

constexpr double kPlotLeft = 56, kPlotTop = 20, kPlotWidth = 620, kPlotHeight = 300,
                 kPlotBelow = 46,
                 kPlotRight = 20;  // px
constexpr const char* kCurveColours[] = {"#222222", "#E69F00", "#0072B2", "#009E73", "#D55E00"};

/// Where the curves go: time and wrench -> px.
struct Frame {
  double t_max = 0, low = 0, high = 0;
  Eigen::Vector2d operator()(double t, double value) const {
    return {kPlotLeft + kPlotWidth * t / t_max,
            kPlotTop + kPlotHeight * (high - value) / (high - low)};
  }
};

Frame frame_of(const Problem& problem, const std::vector<TankCurve>& curves) {
  Frame frame;
  for (const TankCurve& curve : curves) {
    for (const TankSample& sample : curve.run->samples) {
      frame.t_max = std::max(frame.t_max, sample.t);
      for (const double value : {sample.planned, problem.c.dot(sample.h_e)}) {
        frame.low = std::min(frame.low, value);
        frame.high = std::max(frame.high, value);
      }
    }
  }
  frame.high = 1.05 * std::max(frame.high, 1e-9);
  return frame;
}

void draw_axes(Svg& svg, const Frame& frame, const char* unit) {
  const double step = round_step((frame.high - frame.low) / 4);
  for (double k = std::ceil(frame.low / step); k * step <= frame.high; ++k) {
    const double value = k * step + 0.0;  // no negative zero
    svg.line(frame(0, value), frame(frame.t_max, value), {.stroke = "#e8e8e8", .width = 0.8});
    svg.text(frame(0, value) + Eigen::Vector2d(-6, 3.5), fmt::format("{:.6g}", value),
             {.size = 10, .anchor = Anchor::kEnd});
  }
  const double seconds = round_step(frame.t_max / 3);
  for (double t = 0; t <= frame.t_max * (1 + 1e-9); t += seconds) {
    svg.text(frame(t, frame.low) + Eigen::Vector2d(0, 16), fmt::format("{:.6g}", t),
             {.size = 10, .anchor = Anchor::kMiddle});
  }
  svg.line(frame(0, frame.low), frame(frame.t_max, frame.low), {.stroke = "#222222"});
  svg.text(frame(frame.t_max / 2, frame.low) + Eigen::Vector2d(0, 34), "time [s]",
           {.anchor = Anchor::kMiddle});
  svg.text({14, kPlotTop + kPlotHeight / 2}, fmt::format("along c [{}]", unit),
           {.anchor = Anchor::kMiddle, .angle = 90});
  svg.text({kPlotLeft + 8, kPlotTop - 6}, "reading, and the plan (dashed)", {.size = 11});
}

/// Throws unless the row's wrench is one that a hanging mass asks for.
void require_weight(const Problem& problem, const Row& row) {
  if (!problem.c.isApprox(Vector6d::Unit(2), 1e-9)) {
    throw std::invalid_argument(
        "--load, --heaviest: got a task whose wrench is not the force upwards, which a "
        "weight asks for; expected one such as uvms/lift");
  }
  if (row.choice.wrench != Wrench::kPure) {
    throw std::invalid_argument("--wrench: got any, expected pure: a load has a weight alone");
  }
  if (!(problem.robot.gravity > 0)) {
    throw std::invalid_argument("--load: got a robot without gravity, expected gravity > 0");
  }
}

}  // namespace

TankRun simulate_tank(const Problem& problem, const Row& row, double planned,
                      const std::string& integrator, const TankOptions& options) {
  const Capability& capability = row.capability;
  // Beyond the capability only the component along c grows; below it all of them shrink, which the
  // convex set of efforts allows.
  const double share = std::clamp(planned / problem.c.dot(capability.h), 0.0, 1.0);
  TankPlan plan{share * capability.h, share * capability.u, row.choice.wrench};
  plan.h += (planned - problem.c.dot(plan.h)) * problem.c;
  return run_tank(problem, row.posture, plan, *find_integrator(integrator).make(), options);
}

TankRun simulate_load(const Problem& problem, const Row& row, double load,
                      const std::string& integrator, TankOptions options) {
  require_weight(problem, row);
  options.load = load;
  return simulate_tank(problem, row, load * problem.robot.gravity, integrator, options);
}

int heaviest_load(const Problem& problem, const Row& row, const std::string& integrator,
                  TankOptions options) {
  require_weight(problem, row);
  options.until_hold = true;
  int held = 0;
  int lost = std::max(1, static_cast<int>(row.yardstick / problem.robot.gravity) + 2);
  while (lost - held > 1) {
    const int mass = (held + lost) / 2;
    const TankRun run = simulate_load(problem, row, mass, integrator, options);
    (run.summary.held ? held : lost) = mass;
  }
  return held;
}

std::string tank_csv(const Problem& problem, const TankRun& run) {
  std::string text = "t,planned,reading,f_x,f_y,f_z,n_x,n_y,n_z";
  for (const Thruster& thruster : problem.robot.thrusters) text += "," + thruster.name;
  for (const Joint& joint : problem.robot.joints) text += "," + joint.name;
  text += ",saturated,relaxed,shortfall,drift,position_error\n";
  for (const TankSample& sample : run.samples) {
    text +=
        fmt::format("{:.6g},{:.6g},{:.6g}", sample.t, sample.planned, problem.c.dot(sample.h_e));
    for (const double value : sample.h_e) text += fmt::format(",{:.6g}", value);
    for (const double value : sample.u) text += fmt::format(",{:.6g}", value);
    text += fmt::format(",{},{},{:.3g},{:.3g},{:.3g}\n", int{sample.saturated}, int{sample.relaxed},
                        sample.shortfall, sample.drift, sample.position_error);
  }
  return text;
}

std::string tank_figure(const Problem& problem, const std::vector<TankCurve>& curves) {
  Svg svg(kPlotLeft + kPlotWidth + kPlotRight, kPlotTop + kPlotHeight + kPlotBelow);
  const Frame frame = frame_of(problem, curves);
  draw_axes(svg, frame, problem.unit());
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const char* colour = kCurveColours[i % std::size(kCurveColours)];
    std::vector<Eigen::Vector2d> planned, reading;
    double at = 0;
    for (const TankSample& sample : curves[i].run->samples) {
      const double value = problem.c.dot(sample.h_e);
      planned.push_back(frame(sample.t, sample.planned));
      reading.push_back(frame(sample.t, value));
      if (sample.t <= frame.t_max / 2) at = value;
    }
    svg.polyline(planned, {.stroke = "#999999", .width = 1, .dash = "4 3"});
    svg.polyline(reading, {.stroke = colour, .width = 1.8});
    svg.text(frame(frame.t_max / 2, at) - Eigen::Vector2d(0, 6),
             fmt::format("{}: {:.1f}", curves[i].name, at),
             {.size = 11, .colour = colour, .anchor = Anchor::kMiddle});
  }
  return svg.str();
}

}  // namespace maxwrench
