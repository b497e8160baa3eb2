#include "tests/reference_models/lagrange.h"

#include <complex>
#include <stdexcept>

namespace maxwrench::reference {
namespace {

using Eigen::Matrix3cd;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::Vector3cd;
using Eigen::Vector3d;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double kStep = 1e-40;

Matrix3cd cross(const Vector3cd& a) {
  Matrix3cd result;
  result << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return result;
}

/// By Rodrigues' formula.
Matrix3cd turn(const Vector3d& axis, std::complex<double> angle) {
  const Matrix3cd K = cross(axis.cast<std::complex<double>>());
  return Matrix3cd::Identity() + std::sin(angle) * K + (1.0 - std::cos(angle)) * K * K;
}

Matrix3cd turn_rpy(const Vector3cd& rpy) {
  return turn(Vector3d::UnitZ(), rpy[2]) * turn(Vector3d::UnitY(), rpy[1]) *
         turn(Vector3d::UnitX(), rpy[0]);
}

struct Frame {
  Matrix3cd R;
  Vector3cd p;
};

/// Everything at one x, which may be complex. Transposes are never conjugate.
struct Configuration {
  Configuration(const Files& robot, const VectorXcd& x);
  /// Of a point on a body: x_dot -> [velocity; angular velocity], world axes.
  MatrixXcd jacobian(int body, const Vector3d& point) const;
  MatrixXcd mass() const;
  std::complex<double> potential() const;
  /// x_dot -> base velocities in base axes, and joint rates.
  MatrixXcd G() const;

  const Files& files;
  int n;
  std::vector<Frame> frames;
  std::vector<Vector3cd> axes, origins;  ///< of the joints by coordinate, in the world
  Matrix3cd rpy_axes;                    ///< roll, pitch, yaw rates -> angular velocity
};

Configuration::Configuration(const Files& robot, const VectorXcd& x)
    : files(robot),
      n(static_cast<int>(x.size())),
      axes(robot.joints.size()),
      origins(robot.joints.size()) {
  frames.push_back({turn_rpy(x.segment<3>(3)), x.head<3>()});
  const Matrix3cd yaw = turn(Vector3d::UnitZ(), x[5]);
  rpy_axes.col(0) = (yaw * turn(Vector3d::UnitY(), x[4])).col(0);
  rpy_axes.col(1) = yaw.col(1);
  rpy_axes.col(2) = Vector3d::UnitZ().cast<std::complex<double>>();
  for (std::size_t i = 1; i < files.bodies.size(); ++i) {
    const Body& body = files.bodies[i];
    const Frame& parent = frames[body.parent];
    Frame frame{parent.R * turn_rpy(body.rpy.cast<std::complex<double>>()),
                parent.p + parent.R * body.xyz};
    if (body.coordinate >= 0) {
      const auto q = x[6 + body.coordinate];
      axes[body.coordinate] = frame.R * body.axis;
      origins[body.coordinate] = frame.p;
      if (body.slides) {
        frame.p += q * axes[body.coordinate];
      } else {
        frame.R = frame.R * turn(body.axis, q);
      }
    }
    frames.push_back(frame);
  }
}

MatrixXcd Configuration::jacobian(int body, const Vector3d& point) const {
  MatrixXcd J = MatrixXcd::Zero(6, n);
  const Vector3cd r = frames[body].p + frames[body].R * point;
  J.topLeftCorner<3, 3>().setIdentity();
  J.block<3, 3>(3, 3) = rpy_axes;
  J.block<3, 3>(0, 3) = -cross(r - frames[0].p) * rpy_axes;
  for (int i = body; i > 0; i = files.bodies[i].parent) {
    const int coordinate = files.bodies[i].coordinate;
    if (coordinate < 0) continue;
    if (files.bodies[i].slides) {
      J.col(6 + coordinate).head<3>() = axes[coordinate];
    } else {
      J.col(6 + coordinate) << cross(axes[coordinate]) * (r - origins[coordinate]),
          axes[coordinate];
    }
  }
  return J;
}

MatrixXcd in_axes(const Matrix3cd& R, const MatrixXcd& J) {
  MatrixXcd turned(6, J.cols());
  turned << R.transpose() * J.topRows<3>(), R.transpose() * J.bottomRows<3>();
  return turned;
}

MatrixXcd Configuration::mass() const {
  MatrixXcd M = MatrixXcd::Zero(n, n);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Body& body = files.bodies[i];
    const MatrixXcd at_com = in_axes(frames[i].R, jacobian(static_cast<int>(i), body.com));
    M += body.mass * at_com.topRows<3>().transpose() * at_com.topRows<3>();
    M += at_com.bottomRows<3>().transpose() * body.inertia * at_com.bottomRows<3>();
    const MatrixXcd in_water = in_axes(frames[i].R, jacobian(static_cast<int>(i), body.center));
    M += in_water.transpose() * body.added_mass.asDiagonal() * in_water;
  }
  return M;
}

std::complex<double> Configuration::potential() const {
  std::complex<double> moment =
      -files.trim_mass * (frames[0].p + frames[0].R * files.trim_place).z();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Body& body = files.bodies[i];
    moment += body.mass * (frames[i].p + frames[i].R * body.com).z();
    moment -= files.density * body.volume * (frames[i].p + frames[i].R * body.cob).z();
  }
  return files.gravity * moment;
}

MatrixXcd Configuration::G() const {
  MatrixXcd result = MatrixXcd::Identity(n, n);
  result.topLeftCorner<3, 3>() = frames[0].R.transpose();
  result.block<3, 3>(3, 3) = frames[0].R.transpose() * rpy_axes;
  return result;
}

VectorXd coordinates(const Place& base, const VectorXd& q) {
  VectorXd x(6 + q.size());
  x << base.p, base.rpy, q;
  return x;
}

VectorXcd stepped(const VectorXd& x, const VectorXd& along) {
  return x + std::complex<double>(0, kStep) * along;
}

VectorXd potential_slopes(const Files& files, const VectorXd& x) {
  VectorXd slopes(x.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const VectorXd e = VectorXd::Unit(x.size(), k);
    slopes[k] = Configuration(files, stepped(x, e)).potential().imag() / kStep;
  }
  return slopes;
}

/// d/dt dT/dx_dot - dT/dx less M_x x_dotdot.
VectorXd velocity_terms(const Files& files, const VectorXd& x, const VectorXd& x_dot) {
  VectorXd terms = VectorXd::Zero(x.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const VectorXd e = VectorXd::Unit(x.size(), k);
    const MatrixXd slope = Configuration(files, stepped(x, e)).mass().imag() / kStep;
    terms += x_dot[k] * slope * x_dot;
    terms[k] -= x_dot.dot(slope * x_dot) / 2;
  }
  return terms;
}

/// Each body's drag in its own axes.
VectorXd drag(const Files& files, const Configuration& at, const VectorXd& x_dot) {
  VectorXd sum = VectorXd::Zero(x_dot.size());
  for (std::size_t i = 0; i < files.bodies.size(); ++i) {
    const Body& body = files.bodies[i];
    const MatrixXd J =
        in_axes(at.frames[i].R, at.jacobian(static_cast<int>(i), body.center)).real();
    const VectorXd twist = J * x_dot;
    sum += J.transpose() *
           (body.damping_linear + body.damping_quadratic.cwiseProduct(twist.cwiseAbs()))
               .cwiseProduct(twist);
  }
  return sum;
}

const Tool& find_tool(const Files& files, const std::string& name) {
  for (const Tool& tool : files.tools) {
    if (tool.name == name) return tool;
  }
  throw std::runtime_error("no tool " + name);
}

/// Only these entries of a square matrix or a vector.
MatrixXd chosen(const MatrixXd& all, const std::vector<int>& entries) {
  return all.cols() == 1 ? MatrixXd(all(entries, 0)) : MatrixXd(all(entries, entries));
}

std::vector<int> free_entries(const Files& files) {
  std::vector<int> entries = files.axes;
  for (std::size_t i = 0; i < files.joints.size(); ++i) entries.push_back(static_cast<int>(6 + i));
  return entries;
}

}  // namespace

MatrixXd Lagrange::free_rows(const MatrixXd& all) const {
  return all(free_entries(files_), Eigen::all);
}

MatrixXd Lagrange::jacobian(const Place& base, const VectorXd& q, const std::string& name) const {
  const Tool& tool = find_tool(files_, name);
  const Configuration at(files_, coordinates(base, q).cast<std::complex<double>>());
  const MatrixXd J = at.jacobian(tool.body, tool.xyz).real() * at.G().real().inverse();
  return J(Eigen::all, free_entries(files_));
}

Terms Lagrange::terms(const Place& base, const VectorXd& q, const VectorXd& v_free,
                      const VectorXd& v_d_free, const std::string& tool) const {
  const VectorXd x = coordinates(base, q);
  const std::vector<int> free = free_entries(files_);
  VectorXd v = VectorXd::Zero(x.size()), v_d = v;
  v(free) = v_free;
  v_d(free) = v_d_free;
  const Configuration at(files_, x.cast<std::complex<double>>());
  const MatrixXd inverse = at.G().real().inverse();
  const VectorXd x_dot = inverse * v;
  const MatrixXd G_dot = Configuration(files_, stepped(x, x_dot)).G().imag() / kStep;
  const MatrixXd M = at.mass().real();
  // At v_d = 0 the coordinates still accelerate: G x_dotdot + G_dot x_dot = v_d.
  const VectorXd C = velocity_terms(files_, x, x_dot) - M * (inverse * (G_dot * x_dot)).eval();
  Terms terms;
  const MatrixXd M_v = inverse.transpose() * M * inverse;
  const VectorXd C_v = inverse.transpose() * C;
  const VectorXd D_v = inverse.transpose() * drag(files_, at, x_dot);
  const VectorXd g = inverse.transpose() * potential_slopes(files_, x);
  terms.M = chosen(M_v, free);
  terms.C_v = chosen(C_v, free);
  terms.D_v = chosen(D_v, free);
  terms.g = chosen(g, free);
  terms.tau_d = chosen(M_v * v_d + C_v + D_v + g, free);
  terms.J = jacobian(base, q, tool);
  return terms;
}

Terms Lagrange::at_rest(const Place& base, const VectorXd& q, const std::string& tool) const {
  const VectorXd x = coordinates(base, q);
  const MatrixXd G = Configuration(files_, x.cast<std::complex<double>>()).G().real();
  Terms terms;
  terms.J = jacobian(base, q, tool);
  terms.tau_d = chosen(G.transpose().lu().solve(potential_slopes(files_, x)), free_entries(files_));
  return terms;
}

Eigen::Isometry3d Lagrange::tool(const Place& base, const VectorXd& q,
                                 const std::string& name) const {
  const Tool& tool = find_tool(files_, name);
  const Configuration at(files_, coordinates(base, q).cast<std::complex<double>>());
  const Frame& frame = at.frames[tool.body];
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = (frame.R * turn_rpy(tool.rpy.cast<std::complex<double>>())).real();
  pose.translation() = (frame.p + frame.R * tool.xyz).real();
  return pose;
}

Place Lagrange::base_for(const Eigen::Isometry3d& target, const VectorXd& q,
                         const std::string& name) const {
  const Eigen::Isometry3d base = target * tool({}, q, name).inverse();
  const Eigen::Matrix3d R = base.linear();
  return {base.translation(),
          {std::atan2(R(2, 1), R(2, 2)), std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2))),
           std::atan2(R(1, 0), R(0, 0))}};
}

}  // namespace maxwrench::reference
