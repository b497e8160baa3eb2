#include <algorithm>
#include <cmath>

#include "lib/tank/control_loop.h"
#include "lib/tank/controller.h"
#include "lib/tank/ode.h"
#include "lib/tank/reference.h"
#include "lib/tank/stopwatch.h"
#include "lib/tank/summary.h"
#include "lib/trajectory/robot_motion.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {
namespace {

/// [rad/s] Below this angular velocity the cell has no axis of rotation.
constexpr double kSpins = 1e-9;

/// [s] A joint approaches its speed limit with this time constant, that of the thrusters, or more
/// slowly.
constexpr double kBrake = 0.1;

/// Only the parts that the controller and the simulated robot need.
Posture at_rest(const Problem& problem, const Motion& motion) {
  Posture posture;
  posture.base = motion.base;
  posture.q = motion.q;
  posture.J.resize(6, problem.robot.velocities());
  return posture;
}

/// One experiment in steps of the control period. The last step ends with the script.
class MotionExperiment {
 public:
  MotionExperiment(const Problem& problem, const TankScript& script, Integrator& integrator,
                   const TankOptions& options)
      : problem_(problem),
        options_(options),
        script_(script),
        reader_(problem, script),
        follower_(problem),
        motion_(start()),
        ode_(problem, at_rest(problem, motion_), options),
        controller_(problem, at_rest(problem, motion_), script.wrench, options),
        loop_(problem, options, integrator, ode_, controller_.tracker()) {
    ode_.hold_along(script.path);
    ode_.start(motion_, reference_.u);
    R_before_ = bent().R;
  }

  TankRun run() {
    {
      const Stopwatch watch(loop_.run.total_s);
      run_all();
    }
    TankRun& run = loop_.finish();
    run.summary = summarise(script_, options_, run, loop_.lost());
    return std::move(run);
  }

 private:
  /// The pose of an end effector that deflects the cell by the reference wrench.
  Pose<double> bent() const {
    const Vector6d bend = this->bend();
    return {rotation_by(bend.tail<3>()) * reference_.x.pose.R,
            reference_.x.pose.p + bend.head<3>()};
  }

  Vector6d bend() const {
    Vector6d displacement;
    displacement << reference_.h.head<3>() / options_.cell.stiffness_linear,
        reference_.h.tail<3>() / options_.cell.stiffness_angular;
    return displacement;
  }

  Motion start() {
    reader_.read(0, reference_);
    PathPoint x = reference_.x;
    x.pose = bent();
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(problem_.redundancy());
    const bool linear = script_.interpolation == Interpolation::kLinear;
    if (follower_.place(x.pose, reference_.theta_r)) {  // a tool with fewer degrees of freedom
      x.pose = reference_.x.pose;
      follower_.restart();
    }
    const auto& robot_motion =
        follow(x, reference_.theta_r, linear ? none : reference_.rate, reference_.acceleration);
    a_ = robot_motion.v_dot();
    return {robot_motion.base(), robot_motion.q(), robot_motion.v()};
  }

  /// The robot at x. If the dependent joints do not reach it, the experiment ends.
  const RobotMotion<double>& follow(const PathPoint& x, const Eigen::VectorXd& theta_r,
                                    const Eigen::VectorXd& rate,
                                    const Eigen::VectorXd& acceleration) {
    if (const char* const reason = follower_.set(x, theta_r, rate, acceleration)) lost_ = reason;
    return follower_.motion();
  }

  /// Whether the trajectory allows for the lag. The robot can then follow it up to the speed limit
  /// of a joint, and needs no distance from it.
  bool knows_lag() const { return problem_.motion->thruster_lag >= options_.thruster_lag; }

  /// Sets a_, the acceleration of all velocities at a motion: along the path, with corrections of
  /// the errors of theta_r.
  void accelerate(const Motion& motion) {
    const double omega = options_.bandwidth;
    theta_r_ = motion.q(problem_.redundant);
    rate_ = motion.v.tail(motion.q.size())(problem_.redundant);
    bend_ = reference_.acceleration + omega * omega * (reference_.theta_r - theta_r_) +
            2 * omega * (reference_.rate - rate_);
    for (Eigen::Index i = 0; i < bend_.size(); ++i) {
      const int joint = problem_.redundant[static_cast<std::size_t>(i)];
      const double most = problem_.robot.joints[static_cast<std::size_t>(joint)].velocity_max;
      double low = -(most + rate_[i]) / kBrake, high = (most - rate_[i]) / kBrake;
      if (knows_lag()) {
        const double planned =
            reference_.acceleration[i] + (reference_.rate[i] - rate_[i]) / kBrake;
        low = std::min(low, planned);
        high = std::max(high, planned);
      }
      bend_[i] = std::clamp(bend_[i], low, high);
    }
    a_ = follow(reference_.x, theta_r_, rate_, bend_).v_dot();
  }

  void run_all() {
    const double T = script_.instants.back().t;
    const long periods = static_cast<long>(std::ceil(T / options_.period - 1e-9));
    for (long k = 0; k < periods && !lost_ && loop_.goes_on(); ++k) {
      period(static_cast<double>(k) * options_.period,
             std::min(T, static_cast<double>(k + 1) * options_.period));
    }
    if (lost_) loop_.run.conclude(Status::kInvalidPosture, lost_);
  }

  /// The efforts apply at t_1, so the request uses a prediction of the motion at t_1.
  void request(const Eigen::VectorXd& u, double dt, double t_1) {
    const Stopwatch watch(loop_.run.controller_s);
    Motion then = advanced(problem_.robot, motion_, dt);
    then.v += dt * a_;
    reader_.read(t_1, reference_);
    accelerate(then);
    controller_.request(then, a_, reference_.h, reference_.turn, reference_.u, u, dt,
                        loop_.request);
  }

  void period(double t_0, double t_1) {
    loop_.begin(t_0);
    ode_.read(ode_.initial(), motion_);
    const Eigen::VectorXd u = ode_.efforts(t_0);
    request(u, t_1 - t_0, t_1);
    const double t = loop_.step(t_0, u, t_1, Vector6d::Zero(), Vector6d::Zero());
    if (t > t_0) keep(t_0, t);
  }

  void keep(double t_0, double t) {
    reader_.read(t, reference_);
    ode_.read(ode_.initial(), motion_);
    TankSample sample = loop_.sample(t_0, t);
    sample.planned = reference_.c.dot(reference_.h) / (1 - script_.margin);
    read_cell(t, sample);
    const Vector6d displacement = ode_.displacement(t, motion_);
    sample.position_error = displacement.head<3>().norm();
    const Vector6d rest = displacement - bend();
    sample.deflection_error = std::max(rest.head<3>().norm(), rest.tail<3>().norm());
    compare(sample);
    sample.speed = speeding();
    loop_.run.samples.push_back(std::move(sample));
  }

  void read_cell(double t, TankSample& sample) {
    const Vector6d h_e = ode_.wrench(t, motion_);
    sample.reading = reference_.c.dot(h_e);
    Vector6d stray = h_e - reference_.h;
    stray -= reference_.c.dot(stray) * reference_.c;
    stray = rotated(reference_.turn.transpose(), stray);  // W_any is that of the start
    if (script_.wrench == Wrench::kAny) {
      stray -= problem_.W_any * (problem_.W_any.transpose() * stray);  // orthonormal
    }
    sample.off_axis_force = stray.head<3>().norm();
    sample.off_axis_torque = stray.tail<3>().norm();
    const Eigen::Matrix3d turn = reference_.x.pose.R * script_.path.pose(0).R.transpose();
    sample.h_e = rotated(turn.transpose(), h_e);
  }

  /// Compares the sample with the posture of the script.
  void compare(TankSample& sample) {
    const auto& robot_motion =
        follow(reference_.x, reference_.theta_r, reference_.rate, reference_.acceleration);
    sample.theta_r = motion_.q(problem_.redundant);
    sample.theta_r_error = (sample.theta_r - reference_.theta_r).lpNorm<Eigen::Infinity>();
    const Pose<double>& base = robot_motion.base();
    sample.configuration_error = std::max({(motion_.q - robot_motion.q()).lpNorm<Eigen::Infinity>(),
                                           (motion_.base.p - base.p).norm(),
                                           logarithm(motion_.base.R * base.R.transpose()).norm()});
    // The angle about the current or the last axis of rotation of the cell.
    const Eigen::Vector3d spin = reference_.x.twist.tail<3>();
    if (spin.norm() > kSpins) axis_ = spin.normalized();
    const Eigen::Matrix3d R =
        rotation_by(ode_.displacement(sample.t, motion_).tail<3>()) * reference_.x.pose.R;
    angle_ += axis_.dot(logarithm(R * R_before_.transpose()));
    R_before_ = R;
    sample.angle = angle_;
  }

  /// The largest violation of a joint's speed limit.
  double speeding() const {
    const Robot& robot = problem_.robot;
    const auto axes = static_cast<Eigen::Index>(robot.base_axes.size());
    double most = 0;
    for (std::size_t i = 0; i < robot.joints.size(); ++i) {
      const double speed = std::abs(motion_.v[axes + static_cast<Eigen::Index>(i)]);
      most = std::max(most, speed - robot.joints[i].velocity_max);
    }
    return most;
  }

  const Problem& problem_;
  const TankOptions& options_;
  const TankScript& script_;
  const ScriptReader reader_;
  RobotMotionTracker follower_;
  const char* lost_ = nullptr;
  Reference reference_;
  Eigen::VectorXd a_, theta_r_, rate_, bend_;
  Motion motion_;
  TankOde ode_;
  PostureController controller_;
  ControlLoop loop_;
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d R_before_;
  double angle_ = 0;
};

}  // namespace

TankRun run_tank(const Problem& problem, const TankScript& script, Integrator& integrator,
                 const TankOptions& options) {
  check(options);
  check(problem.robot);
  if (!script.instants.empty()) check_deaths(options, problem.robot, script.instants.back().t);
  return MotionExperiment(problem, script, integrator, options).run();
}

}  // namespace maxwrench
