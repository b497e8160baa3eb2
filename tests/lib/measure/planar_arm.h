#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "maxwrench/capability.h"
#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "tests/support/support.h"

namespace maxwrench {

/// The measures of accelerations.
constexpr const char* kDynamicMeasures[] = {"dynamic_manipulability", "dynamic_capability"};

/// The measure of that name, at a posture.
inline Capability value_at(const Problem& problem, const std::string& measure,
                           const Posture& posture) {
  WrenchProgram program = make_wrench_program(problem, Wrench::kPure);
  set_posture(posture, program);
  Capability capability;
  find_measure(measure).make(problem, nullptr)->evaluate(posture, program, true, capability);
  return capability;
}

/// An arm of two joints in the plane of x and z, under gravity along -z, with all of its dynamics
/// by hand: joint angles from x towards z, links of length l with the mass m at l_c and the moment
/// I about it.
struct PlanarArm {
  double m_1 = 3, l_1 = 0.5, c_1 = 0.2, I_1 = 0.05, m_2 = 2, l_2 = 0.4, c_2 = 0.25, I_2 = 0.02;
  Eigen::VectorXd u_min, u_max;
  Problem problem;

  explicit PlanarArm(Eigen::VectorXd lowest = Eigen::Vector2d(-60, -30),
                     Eigen::VectorXd highest = Eigen::Vector2d(60, 30))
      : u_min(std::move(lowest)), u_max(std::move(highest)) {
    problem.name = "planar arm";
    Robot& robot = problem.robot;
    robot.name = "planar arm";
    robot.links.resize(3);
    robot.joints.resize(2);
    const double m[] = {m_1, m_2}, c[] = {c_1, c_2}, I[] = {I_1, I_2};
    for (std::size_t i = 0; i < 2; ++i) {
      robot.links[i + 1].mass = m[i];
      robot.links[i + 1].com.x() = c[i];
      robot.links[i + 1].inertia.diagonal() << 1e-3, I[i], I[i];
      robot.joints[i].axis = -Eigen::Vector3d::UnitY();
      robot.joints[i].parent = static_cast<int>(i);
    }
    robot.joints[1].placement.p.x() = l_1;
    robot.end_effectors = {{"tool", 2, {Eigen::Matrix3d::Identity(), {l_2, 0, 0}}}};
    robot.actuation = make_zonotope(Eigen::MatrixXd::Identity(2, 2), u_min, u_max);
    problem.W_any.setZero(6, 2);
    problem.W_any(0, 0) = problem.W_any(2, 1) = 1;
    problem.c = Vector6d::Unit(2);
  }

  Eigen::Matrix2d M(double q_2) const {
    const double h = m_2 * l_1 * c_2 * std::cos(q_2);
    const double b = I_2 + m_2 * c_2 * c_2;
    Eigen::Matrix2d M;
    M << I_1 + m_1 * c_1 * c_1 + m_2 * l_1 * l_1 + b + 2 * h, b + h, b + h, b;
    return M;
  }
  Eigen::Vector2d load(double q_1, double q_2) const {
    const double outer = 9.81 * m_2 * c_2 * std::cos(q_1 + q_2);
    return {9.81 * (m_1 * c_1 + m_2 * l_1) * std::cos(q_1) + outer, outer};
  }
  Eigen::Matrix2d J(double q_1, double q_2) const {
    const double x = l_2 * std::cos(q_1 + q_2), z = l_2 * std::sin(q_1 + q_2);
    Eigen::Matrix2d J;
    J << -l_1 * std::sin(q_1) - z, -z, l_1 * std::cos(q_1) + x, x;
    return J;
  }
  Posture posture(double q_1, double q_2) const {
    Posture at;
    at.status = Status::kValid;
    at.q = Eigen::Vector2d(q_1, q_2);
    at.tau_d = load(q_1, q_2);
    at.J.setZero(6, 2);
    at.J.row(0) = J(q_1, q_2).row(0);
    at.J.row(2) = J(q_1, q_2).row(1);
    at.J.row(4).setConstant(-1);
    return at;
  }
  /// u = load + M J^-1 a: with as many joints as directions a determines it.
  Eigen::Vector2d efforts(double q_1, double q_2, const Eigen::Vector2d& a) const {
    return load(q_1, q_2) + M(q_2) * J(q_1, q_2).inverse() * a;
  }
};

}  // namespace maxwrench
