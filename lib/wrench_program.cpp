#include "lib/wrench_program.h"

namespace maxwrench {

WrenchProgram make_wrench_program(const Problem& problem, Wrench wrench) {
  WrenchProgram program;
  program.actuation = &problem.robot.actuation;
  program.W = wrench == Wrench::kPure ? Matrix6Xd(problem.c) : problem.W_any;
  const Eigen::Index k = program.W.cols();
  const Eigen::Index n = problem.robot.velocities();
  program.c_w = program.W.transpose() * problem.c;
  program.w_min = Eigen::VectorXd::Constant(k, -kInfinity);
  program.w_max = Eigen::VectorXd::Constant(k, kInfinity);
  program.JtW = Eigen::MatrixXd::Zero(n, k);
  program.tau_d = Eigen::VectorXd::Zero(n);
  return program;
}

void set_posture(const Posture& posture, WrenchProgram& program) {
  program.JtW.noalias() = posture.J.transpose().lazyProduct(program.W);
  program.tau_d = posture.tau_d;
}

LinearProgram assemble(const WrenchProgram& program) {
  const Zonotope& actuation = *program.actuation;
  const int n = actuation.dimension();
  const int m = actuation.actuators();
  const int k = program.columns();
  LinearProgram lp;
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < n; ++i) {
      if (actuation.B(i, j) != 0) entries.emplace_back(i, j, actuation.B(i, j));
    }
  }
  // Every entry of -J'W is stored, zero or not: the pattern is the same for all postures.
  for (int j = 0; j < k; ++j) {
    for (int i = 0; i < n; ++i) entries.emplace_back(i, m + j, 0.0);
  }
  lp.A.resize(n, m + k);
  lp.A.setFromTriplets(entries.begin(), entries.end());
  lp.b.resize(n);
  lp.c = Eigen::VectorXd::Zero(m + k);
  lp.l.resize(m + k);
  lp.u.resize(m + k);
  lp.l.head(m) = actuation.u_min;
  lp.u.head(m) = actuation.u_max;
  update(program, lp);
  return lp;
}

void update(const WrenchProgram& program, LinearProgram& assembled) {
  const int m = program.actuation->actuators();
  const int k = program.columns();
  assembled.c.tail(k) = program.c_w;
  assembled.l.tail(k) = program.w_min;
  assembled.u.tail(k) = program.w_max;
  assembled.b = program.tau_d;
  for (int j = 0; j < k; ++j) {
    double* values = assembled.A.valuePtr() + assembled.A.outerIndexPtr()[m + j];
    for (Eigen::Index i = 0; i < program.JtW.rows(); ++i) values[i] = -program.JtW(i, j);
  }
}

}  // namespace maxwrench
