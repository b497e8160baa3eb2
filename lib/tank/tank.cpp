#include "maxwrench/tank.h"

#include <algorithm>
#include <cmath>

#include "lib/scenario/scenario_list.h"
#include "lib/tank/control_loop.h"
#include "lib/tank/controller.h"
#include "lib/tank/ode.h"
#include "lib/tank/stopwatch.h"
#include "lib/tank/summary.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

/// The share of the planned wrench at time t.
double profile(double t, const TankOptions& options) {
  const double down = t - options.ramp - options.hold;
  if (t < options.ramp) return t / options.ramp;
  return down <= 0 ? 1 : std::max(0.0, 1 - down / options.ramp);
}

/// [s] The length of the experiment.
double duration(const TankOptions& options) {
  return (options.until_hold ? 1 : 2) * options.ramp + options.hold;
}

/// The problem with the load as a point mass at the end effector.
Problem loaded(Problem problem, double load) {
  if (load == 0) return problem;
  const EndEffector& tool =
      problem.robot.end_effectors[static_cast<std::size_t>(problem.end_effector)];
  add_body(problem.robot.links[static_cast<std::size_t>(tool.link)], load, tool.placement.p,
           Eigen::Matrix3d::Zero());
  return problem;
}

/// One experiment in steps of the control period.
class Experiment {
 public:
  Experiment(const Problem& problem, const Posture& posture, const TargetWrench& target,
             Integrator& integrator, const TankOptions& options)
      : problem_(loaded(problem, options.load)),
        options_(options),
        target_(target),
        ode_(problem_, posture, options),
        controller_(problem_, posture, target.wrench, options),
        loop_(problem_, options, integrator, ode_, controller_.tracker()) {
    begin(posture);
  }

  TankRun run() {
    {
      const Stopwatch watch(loop_.run.total_s);
      const long periods = std::lround(duration(options_) / options_.period);
      for (long k = 0; k < periods && loop_.goes_on(); ++k) period(k);
    }
    TankRun& run = loop_.finish();
    run.summary = summarise(problem_, target_, options_, run, loop_.lost());
    return std::move(run);
  }

 private:
  void begin(const Posture& posture) {
    motion_ = {posture.base, posture.q, Eigen::VectorXd::Zero(problem_.robot.velocities())};
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(target_.u.size());
    EffortAnswer answer;
    controller_.request(motion_, exerted(0), none, none, kInfinity, loop_.request);
    controller_.tracker().solve(loop_.request, answer);
    u_0_ = answer.u;
    ode_.start(motion_, u_0_);
  }

  /// The wrench that the robot exerts on its environment at a share of the planned wrench. With a
  /// load it acts on the load's support: the part of the weight that the robot does not carry.
  Vector6d exerted(double share) const {
    return (options_.load > 0 ? share - 1 : share) * target_.h;
  }

  /// The requested share. The margin does not apply to a load.
  double asked(double share) const {
    return options_.load > 0 ? share : (1 - options_.margin) * share;
  }

  void period(long k) {
    const double t_0 = static_cast<double>(k) * options_.period;
    const double t_1 = static_cast<double>(k + 1) * options_.period;
    loop_.begin(t_0);
    ode_.read(ode_.initial(), motion_);
    const Eigen::VectorXd u = ode_.efforts(t_0);
    const double s = profile(t_1, options_);
    request(u, s);
    const double t = loop_.step(t_0, u, t_1, exerted(profile(t_0, options_)), exerted(s));
    if (t > t_0) keep(t_0, t);
  }

  /// The efforts apply at the period's end, so the request uses a prediction of the motion there.
  void request(const Eigen::VectorXd& u, double s) {
    const Stopwatch watch(loop_.run.controller_s);
    controller_.request(advanced(problem_.robot, motion_, options_.period), exerted(asked(s)),
                        u_0_ + asked(s) * (target_.u - u_0_), u, options_.period, loop_.request);
  }

  /// The force that has accelerated the load since the last sample.
  Vector6d inertia_force(double t) {
    const double t_before = loop_.run.samples.empty() ? 0 : loop_.run.samples.back().t;
    const Eigen::Vector3d v = ode_.twist(motion_).head<3>();
    Vector6d force = Vector6d::Zero();
    force.head<3>() = options_.load / (t - t_before) * (v - v_load_);
    v_load_ = v;
    return force;
  }

  /// The displacement of the end effector in the cell at a share of the planned wrench.
  Vector6d bend(double share) const {
    Vector6d displacement = Vector6d::Zero();
    if (options_.load > 0) return displacement;
    displacement << target_.h.head<3>() / options_.cell.stiffness_linear,
        target_.h.tail<3>() / options_.cell.stiffness_angular;
    return share * displacement;
  }

  void keep(double t_0, double t) {
    ode_.read(ode_.initial(), motion_);
    TankSample sample = loop_.sample(t_0, t);
    sample.planned = profile(t, options_) * problem_.c.dot(target_.h);
    sample.h_e = ode_.wrench(t, motion_);
    if (options_.load > 0) sample.h_e += target_.h + inertia_force(t);
    sample.reading = problem_.c.dot(sample.h_e);
    sample.theta_r_error = controller_.theta_r_error(motion_);
    sample.configuration_error = controller_.moved(motion_);
    const Vector6d displacement = ode_.displacement(t, motion_);
    sample.position_error = displacement.head<3>().norm();
    const Vector6d rest = displacement - bend(profile(t, options_));
    sample.deflection_error = std::max(rest.head<3>().norm(), rest.tail<3>().norm());
    loop_.run.samples.push_back(std::move(sample));
  }

  const Problem problem_;
  const TankOptions& options_;
  const TargetWrench& target_;
  TankOde ode_;
  PostureController controller_;
  ControlLoop loop_;
  Eigen::VectorXd u_0_;
  Motion motion_;
  Eigen::Vector3d v_load_ = Eigen::Vector3d::Zero();  ///< at the last sample [m/s]
};

}  // namespace

TankRun run_tank(const Problem& problem, const Posture& posture, const TargetWrench& target,
                 Integrator& integrator, const TankOptions& options) {
  check(options);
  require_no_scenarios(problem, "virtual tank");
  check(problem.robot);
  check_deaths(options, problem.robot, duration(options));
  return Experiment(problem, posture, target, integrator, options).run();
}

}  // namespace maxwrench
