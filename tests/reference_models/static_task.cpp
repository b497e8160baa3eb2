#include "tests/reference_models/static_task.h"

#include <cmath>
#include <limits>

#include "tests/reference_models/vertices.h"

namespace maxwrench::reference {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Program StaticTask::program(const VectorXd& q) const {
  const Terms terms = robot.at_rest(robot.base_for(target, q, tool), q, tool);
  const MatrixXd B = robot.B();
  const VectorXd unlimited = VectorXd::Constant(W.cols(), std::numeric_limits<double>::infinity());
  Program program;
  program.A.resize(B.rows(), B.cols() + W.cols());
  program.A << B, -terms.J.transpose() * W;
  program.b = terms.tau_d;
  program.c = VectorXd::Zero(program.A.cols());
  program.c.tail(W.cols()) = W.transpose() * c;
  program.l.resize(program.A.cols());
  program.l << robot.files().u_min, -unlimited;
  program.u.resize(program.A.cols());
  program.u << robot.files().u_max, unlimited;
  return program;
}

std::optional<double> StaticTask::polytope(const VectorXd& q) const {
  const Program p = program(q);
  return best_vertex(p.A, p.b, p.c, p.l, p.u);
}

std::optional<double> StaticTask::ellipsoid(const VectorXd& q) const {
  const Terms terms = robot.at_rest(robot.base_for(target, q, tool), q, tool);
  const VectorXd limits = robot.files().u_max.cwiseMin(-robot.files().u_min);
  const MatrixXd scaled = limits.cwiseInverse().asDiagonal() *
                          robot.B().completeOrthogonalDecomposition().pseudoInverse();
  const VectorXd load = scaled * terms.tau_d, slope = scaled * terms.J.transpose() * c;
  // |load + slope beta|^2 = 1.
  const double a = slope.squaredNorm(), b = slope.dot(load), d = load.squaredNorm() - 1;
  if (b * b < a * d) return std::nullopt;
  return (-b + std::sqrt(b * b - a * d)) / a;
}

void add_push(const MatrixXd& J, const MatrixXd& C, Program& program) {
  const Eigen::Index columns = program.A.cols(), added = C.cols();
  program.A.conservativeResize(Eigen::NoChange, columns + added);
  program.A.rightCols(added) = -J.transpose() * C;
  for (VectorXd* v : {&program.c, &program.l, &program.u}) v->conservativeResize(columns + added);
  program.c.tail(added).setZero();
  program.l.tail(added).setZero();
  program.u.tail(added).setConstant(std::numeric_limits<double>::infinity());
}

}  // namespace maxwrench::reference
