#include "lib/tank/control_loop.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/tank/ode.h"
#include "lib/tank/stopwatch.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

/// [s] Times that differ by less are the same: periods begin at sums with rounding errors.
constexpr double kSameTime = 1e-9;

}  // namespace

ControlLoop::ControlLoop(const Problem& problem, const TankOptions& options, Integrator& integrator,
                         TankOde& ode, EffortTracker& tracker)
    : robot_(problem.robot),
      options_(options),
      integrator_(integrator),
      ode_(ode),
      tracker_(tracker),
      random_(options.imperfections.seed) {
  run.conclude(Status::kReached);
}

void ControlLoop::begin(double t) {
  t_ = t;
  for (const ActuatorDeath& death : options_.deaths) {
    if (t >= death.t - kSameTime && !ode_.is_dead(death.actuator)) ode_.kill(death.actuator);
  }
}

/// An actuator that is known to be dead takes no part in the request: without a column in B, its
/// effort does not count, and the tracking program leaves it at its preferred value, zero.
void ControlLoop::leave_out_dead() {
  for (const ActuatorDeath& death : options_.deaths) {
    if (t_ < death.t + options_.noticed_after - kSameTime) continue;
    request.B.col(death.actuator).setZero();
    request.u_star[death.actuator] = 0;
    request.lower[death.actuator] = request.upper[death.actuator] = 0;
  }
}

double ControlLoop::step(double t_0, const Eigen::VectorXd& u_0, double t_1, const Vector6d& h_0,
                         const Vector6d& h_1) {
  u_0_ = u_0;
  leave_out_dead();
  {
    const Stopwatch watch(run.qp_s);
    tracker_.solve(request, answer_);
  }
  ++run.requests;
  run.active_set_iterations += answer_.iterations;
  ode_.command(t_0, u_0_, t_1, answer_.u, h_0, h_1);
  draw_noise();
  integrator_.integrate(ode_, options_.integrator, std::array{t_0, t_1}, path_);
  run.conclude(path_.status, path_.reason.c_str());
  if (!answer_.converged) {
    run.conclude(Status::kNumericalError, "the tracking program ran out of iterations");
  }
  ode_.restart(path_.y.back());
  return path_.t.back();
}

void ControlLoop::draw_noise() {
  if (options_.imperfections.thrust_noise == 0) return;
  Eigen::VectorXd noise(static_cast<Eigen::Index>(robot_.thrusters.size()));
  for (double& value : noise) value = options_.imperfections.thrust_noise * random_.normal();
  ode_.set_noise(noise);
}

TankSample ControlLoop::sample(double t_0, double t) const {
  TankSample sample;
  sample.t = t;
  sample.u = ode_.efforts(t);
  sample.shortfall = answer_.shortfall;
  sample.saturated = answer_.saturated;
  sample.relaxed = answer_.relaxed;
  sample.violation = violation(t - t_0, sample.u);
  return sample;
}

/// The violation by the actual efforts and by the commanded ones. Dead actuators have no limits.
double ControlLoop::violation(double dt, const Eigen::VectorXd& u) const {
  const Zonotope& limits = robot_.actuation;
  double most = 0;
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    if (ode_.is_dead(i)) continue;
    most = std::max(most, std::abs(u[i] - u_0_[i]) / dt - robot_.u_rate_max[i]);
    for (const double each : {u[i], answer_.u[i]}) {
      most = std::max({most, each - limits.u_max[i], limits.u_min[i] - each});
    }
  }
  return most;
}

bool ControlLoop::lost() const {
  if (run.samples.empty()) return false;
  const TankSample& now = run.samples.back();
  return now.theta_r_error > kLost || now.position_error > kLost;
}

bool ControlLoop::goes_on() {
  if (run.status != Status::kReached || lost()) return false;
  if (!options_.interrupted || !options_.interrupted()) return true;
  run.conclude(Status::kBudgetExhausted, "interrupted");
  return false;
}

TankRun& ControlLoop::finish() {
  run.evaluations = ode_.evaluations();
  run.model_s = ode_.seconds();
  return run;
}

}  // namespace maxwrench
