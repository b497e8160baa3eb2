#include "maxwrench/tank.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "lib/math/random.h"
#include "lib/tank/controller.h"
#include "lib/tank/ode.h"
#include "lib/tank/summary.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// The share of the planned wrench at time t.
double profile(double t, const TankOptions& options) {
  const double down = t - options.ramp - options.hold;
  if (t < options.ramp) return t / options.ramp;
  return down <= 0 ? 1 : std::max(0.0, 1 - down / options.ramp);
}

/// With the load as a point mass at the end effector.
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
  Experiment(const Problem& problem, const Posture& posture, const TankPlan& plan,
             Integrator& integrator, const TankOptions& options)
      : problem_(loaded(problem, options.load)),
        options_(options),
        plan_(plan),
        integrator_(integrator),
        ode_(problem_, posture, options),
        controller_(problem_, posture, plan.wrench, options),
        random_(options.imperfections.seed) {
    begin(posture);
  }

  TankRun run() {
    const Clock::time_point start = Clock::now();
    const double length = (options_.until_hold ? 1 : 2) * options_.ramp + options_.hold;
    const long periods = std::lround(length / options_.period);
    run_.conclude(Status::kReached);
    for (long k = 0; k < periods && run_.status == Status::kReached && !lost(); ++k) period(k);
    run_.evaluations = ode_.evaluations();
    run_.model_s = ode_.seconds();
    run_.total_s = seconds_since(start);
    run_.summary = summarise(problem_, plan_, options_, run_, lost());
    return std::move(run_);
  }

 private:
  void begin(const Posture& posture) {
    motion_ = {posture.base, posture.q, Eigen::VectorXd::Zero(problem_.robot.velocities())};
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(plan_.u.size());
    controller_.request(motion_, exerted(0), none, none, kInfinity, request_);
    controller_.tracker().solve(request_, answer_);
    u_0_ = u_ = answer_.u;
    ode_.start(motion_, u_);
  }

  /// What the robot exerts on its environment at a share of the plan: on what holds the load up,
  /// the weight that it does not carry itself.
  Vector6d exerted(double share) const { return (options_.load > 0 ? share - 1 : share) * plan_.h; }

  /// The share that is asked for. A load is what it is.
  double asked(double share) const {
    return options_.load > 0 ? share : (1 - options_.margin) * share;
  }

  void period(long k) {
    const double t_0 = static_cast<double>(k) * options_.period;
    const double t_1 = static_cast<double>(k + 1) * options_.period;
    ode_.read(ode_.initial(), motion_);
    u_ = ode_.efforts(t_0);
    const double s = profile(t_1, options_);
    const Clock::time_point start = Clock::now();
    // The efforts are those of t_1, so the motion is that of t_1 too, as far as it can be told.
    controller_.request(advanced(problem_.robot, motion_, options_.period), exerted(asked(s)),
                        u_0_ + asked(s) * (plan_.u - u_0_), u_, options_.period, request_);
    const Clock::time_point asked_at = Clock::now();
    controller_.tracker().solve(request_, answer_);
    run_.qp_s += seconds_since(asked_at);
    run_.controller_s += std::chrono::duration<double>(asked_at - start).count();
    ++run_.requests;
    run_.active_set_iterations += answer_.iterations;
    ode_.command(t_0, u_, t_1, answer_.u, exerted(profile(t_0, options_)), exerted(s));
    draw_noise();
    integrator_.integrate(ode_, options_.integrator, std::array{t_0, t_1}, path_);
    run_.conclude(path_.status, path_.reason.c_str());
    if (!answer_.converged) {
      run_.conclude(Status::kNumericalError, "the tracking program ran out of iterations");
    }
    ode_.restart(path_.y.back());
    if (path_.t.back() > t_0) keep(path_.t.back());
  }

  /// What accelerates the load since the last sample.
  Vector6d inertia_force(double t) {
    const double t_before = run_.samples.empty() ? 0 : run_.samples.back().t;
    const Eigen::Vector3d v = ode_.twist(motion_).head<3>();
    Vector6d force = Vector6d::Zero();
    force.head<3>() = options_.load / (t - t_before) * (v - v_load_);
    v_load_ = v;
    return force;
  }

  /// The displacement of the end effector in the cell at a share of the plan.
  Vector6d bend(double share) const {
    Vector6d displacement = Vector6d::Zero();
    if (options_.load > 0) return displacement;
    displacement << plan_.h.head<3>() / options_.cell.stiffness_linear,
        plan_.h.tail<3>() / options_.cell.stiffness_angular;
    return share * displacement;
  }

  void draw_noise() {
    if (options_.imperfections.thrust_noise == 0) return;
    Eigen::VectorXd noise(static_cast<Eigen::Index>(problem_.robot.thrusters.size()));
    for (double& value : noise) value = options_.imperfections.thrust_noise * random_.normal();
    ode_.set_noise(noise);
  }

  void keep(double t) {
    ode_.read(ode_.initial(), motion_);
    TankSample sample;
    sample.t = t;
    sample.planned = profile(t, options_) * problem_.c.dot(plan_.h);
    sample.h_e = ode_.wrench(t, motion_);
    if (options_.load > 0) sample.h_e += plan_.h + inertia_force(t);
    sample.reading = problem_.c.dot(sample.h_e);
    sample.u = ode_.efforts(t);
    sample.shortfall = answer_.shortfall;
    sample.saturated = answer_.saturated;
    sample.relaxed = answer_.relaxed;
    sample.drift = controller_.drift(motion_);
    sample.moved = controller_.moved(motion_);
    const Vector6d displacement = ode_.displacement(t, motion_);
    sample.position_error = displacement.head<3>().norm();
    const Vector6d rest = displacement - bend(profile(t, options_));
    sample.displaced = std::max(rest.head<3>().norm(), rest.tail<3>().norm());
    const Zonotope& limits = problem_.robot.actuation;
    const Eigen::ArrayXd rate = (sample.u - u_).array().abs() / options_.period;
    // Of what the actuators do, and of what they were told.
    sample.violation = std::max(0.0, (rate - problem_.robot.u_rate_max.array()).maxCoeff());
    for (const Eigen::VectorXd* u : {&sample.u, &answer_.u}) {
      sample.violation = std::max(
          {sample.violation, (*u - limits.u_max).maxCoeff(), (limits.u_min - *u).maxCoeff()});
    }
    run_.samples.push_back(std::move(sample));
  }

  bool lost() const {
    if (run_.samples.empty()) return false;
    const TankSample& now = run_.samples.back();
    return now.drift > kLost || now.position_error > kLost;
  }

  const Problem problem_;
  const TankOptions& options_;
  const TankPlan& plan_;
  Integrator& integrator_;
  TankOde ode_;
  PostureController controller_;
  Random random_;
  Eigen::VectorXd u_0_, u_;
  Motion motion_;
  Eigen::Vector3d v_load_ = Eigen::Vector3d::Zero();  ///< at the last sample [m/s]
  EffortRequest request_;
  EffortAnswer answer_;
  Trajectory path_;
  TankRun run_;
};

}  // namespace

TankRun run_tank(const Problem& problem, const Posture& posture, const TankPlan& plan,
                 Integrator& integrator, const TankOptions& options) {
  return Experiment(problem, posture, plan, integrator, options).run();
}

}  // namespace maxwrench
