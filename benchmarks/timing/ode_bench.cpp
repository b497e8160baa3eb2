// The work and the precision of every integrator on a motion of the free underwater vehicle, and
// the time of the parts of a simulated experiment, static and along a turn.

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>

#include "lib/robot/free_motion.h"
#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "maxwrench/tank.h"
#include "solvers/solve/tank.h"

namespace maxwrench {
namespace {

using Clock = std::chrono::steady_clock;

/// Counts the evaluations of an integrator.
class Counted final : public Ode {
 public:
  explicit Counted(Ode& ode) : ode_(ode) {}
  const Eigen::VectorXd& initial() const override { return ode_.initial(); }
  bool derivative(double t, const Eigen::VectorXd& y, Eigen::VectorXd& y_dot) override {
    ++evaluations;
    return ode_.derivative(t, y, y_dot);
  }
  bool residual(double t, const Eigen::VectorXd& y, const Eigen::VectorXd& y_dot,
                Eigen::VectorXd& F) override {
    ++evaluations;
    return ode_.residual(t, y, y_dot, F);
  }
  long evaluations = 0;

 private:
  Ode& ode_;
};

/// The default posture in motion, under oscillating forces.
FreeMotion swing(const Problem& problem) {
  PostureEvaluator model(problem);
  const Posture& posture = model.evaluate(problem.theta_r_default);
  const Motion start = {posture.base, posture.q,
                        Eigen::VectorXd::Constant(problem.robot.velocities(), 0.1)};
  return {problem.robot, start, [](double t, Eigen::VectorXd& tau) {
            for (Eigen::Index i = 0; i < tau.size(); ++i) {
              tau[i] = (i < 3 ? 20 : i < 6 ? 2 : 5e-4) * std::sin(3 * t + static_cast<double>(i));
            }
          }};
}

void print_work_and_precision(const Problem& problem) {
  FreeMotion motion = swing(problem);
  const std::array<double, 2> times = {0, 1};
  OdeSolution trajectory;
  IntegratorOptions options;
  options.max_steps = 1000000;
  options.step = 5e-5;
  find_integrator("runge_kutta").make()->integrate(motion, options, times, trajectory);
  const Eigen::VectorXd reference = trajectory.y.back();
  fmt::print("free motion, 1 s: error against runge_kutta with a step of 5e-5 s\n");
  fmt::print("{:<12} {:>14} {:>10} {:>12} {:>9}\n", "integrator", "tolerance/step", "error",
             "evaluations", "ms");
  for (const IntegratorEntry& entry : integrators()) {
    const bool fixed = entry.name == std::string_view("runge_kutta");
    for (const double accuracy :
         fixed ? std::array{4e-3, 1e-3, 2.5e-4} : std::array{1e-4, 1e-7, 1e-10}) {
      options.step = accuracy;
      options.relative_tolerance = options.absolute_tolerance = accuracy;
      Counted counted(motion);
      const Clock::time_point begin = Clock::now();
      const Status status = entry.make()->integrate(counted, options, times, trajectory);
      const double ms = 1e3 * std::chrono::duration<double>(Clock::now() - begin).count();
      fmt::print("{:<12} {:>14.1e} {:>10.1e} {:>12} {:>9.2f}  {}\n", entry.name, accuracy,
                 (trajectory.y.back() - reference).lpNorm<Eigen::Infinity>(), counted.evaluations,
                 ms, status == Status::kReached ? "" : trajectory.reason.c_str());
    }
  }
}

/// The tank supports only integrators for stiff systems.
template <typename Experiment>
void print_shares(const char* what, const Problem& problem, const Experiment& experiment) {
  fmt::print("\n{}, {}, on one core\n", problem.name, what);
  fmt::print("{:<24} {:>8} {:>10} {:>9} {:>11} {:>10} {:>6} {:>12}\n",
             fmt::format("integrator, least [{}]", problem.unit()), "s", "real time", "model",
             "integrator", "control", "QP", "evaluations");
  for (const IntegratorEntry& entry : integrators()) {
    if (!entry.stiff) continue;
    const TankRun run = experiment(entry.name);
    const double rest = run.total_s - run.model_s - run.controller_s - run.qp_s;
    const double end = run.samples.empty() ? 0 : run.samples.back().t;
    fmt::print(
        "{:<24} {:>8.3f} {:>8.0f} x {:>7.0f} % {:>9.0f} % {:>8.1f} % {:>4.1f} % {:>12}  {}\n",
        fmt::format("{:<12} {:.5f}", entry.name, run.summary.low), run.total_s, end / run.total_s,
        100 * run.model_s / run.total_s, 100 * rest / run.total_s,
        100 * run.controller_s / run.total_s, 100 * run.qp_s / run.total_s, run.evaluations,
        run.reason.c_str());
  }
}

void print_static_shares(const Problem& problem) {
  const Answer answer = evaluate(problem, problem.theta_r_default);
  print_shares("static experiment of 15 s at the default posture, 1500 control periods", problem,
               [&](const char* integrator) {
                 return simulate_posture(answer, problem.c.dot(answer.capability.h), integrator,
                                         {});
               });
}

void print_turn_shares(const Problem& problem) {
  const Answer answer = evaluate(problem, problem.theta_r_default);
  print_shares("tracked turn of 5 s with the default posture throughout, 500 control periods",
               problem, [&](const char* integrator) {
                 return simulate_trajectory(problem, answer.trajectory, Wrench::kPure,
                                            trajectory_solvers().front(), {}, integrator, {})
                     .run;
               });
}

}  // namespace
}  // namespace maxwrench

int main() {
  const maxwrench::Problem problem = maxwrench::load_problem("uvms/valve");
  maxwrench::print_work_and_precision(problem);
  maxwrench::print_static_shares(problem);
  maxwrench::print_turn_shares(maxwrench::load_problem("uvms/valve_trajectory"));
}
