#include "solvers/wrench_set/directions.h"

#include <fmt/format.h>

#include <stdexcept>

#include "lib/math/decompositions.h"
#include "lib/scenario/scenario_list.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

/// A singular value below this share of the largest is zero.
constexpr double kDependent = 1e-9;

void check_columns(const Matrix6Xd& E) {
  const auto reject = [](const std::string& got, const char* expected) {
    throw std::invalid_argument("E: got " + got + ", expected " + expected);
  };
  if (E.cols() < 1 || E.cols() > 3) reject(fmt::format("{} columns", E.cols()), "1 to 3");
  if (!E.allFinite()) reject("a value that is not a finite number", "finite numbers");
  const Eigen::Index rank = svd(E).rank(kDependent);
  if (rank < E.cols()) {
    reject(fmt::format("{} columns of rank {}", E.cols(), rank), "independent columns");
  }
}

void check_sizes(const Problem& problem, const Posture& posture) {
  const Eigen::Index n = problem.robot.velocities();
  const auto check = [](const char* what, Eigen::Index got, Eigen::Index expected) {
    if (got == expected) return;
    throw std::invalid_argument(
        fmt::format("posture: got {} with {} columns, expected {}: it is "
                    "of another robot",
                    what, got, expected));
  };
  check("J", posture.J.cols(), n);
  check("tau_d'", posture.tau_d.size(), n);
  if (problem.contact_columns() == 0) return;
  check("J_2", posture.J_2.cols(), n);
  check("C_2", posture.C_2.cols(), problem.contact_columns());
}

/// An orthonormal basis of the part of span W that is orthogonal to E.
Matrix6Xd remainder(const Matrix6Xd& W, const Matrix6Xd& E) {
  const Matrix6Xd Q =
      Eigen::HouseholderQR<Matrix6Xd>(E).householderQ() * Matrix6Xd::Identity(6, E.cols());
  const Matrix6Xd rest = W - Q * (Q.transpose() * W);
  const Svd parts = svd(rest);
  // W is orthonormal, so 1 is the scale of the singular values.
  const Eigen::Index rank = (parts.values.array() > kDependent).count();
  return parts.U.leftCols(rank);
}

}  // namespace

WrenchProgram program_along(const Problem& problem, const Posture& posture, const Matrix6Xd& W) {
  require_no_scenarios(problem, "wrench set");
  WrenchProgram program = make_wrench_program(problem, Wrench::kPure);
  const Eigen::VectorXd w_min = program.w_min, w_max = program.w_max;
  program.W = W;
  program.W_0.resize(6, 0);
  // The second contact's columns come after those of W.
  const Eigen::Index own = W.cols();
  const Eigen::Index l = program.C_2.cols();
  program.c_w.setZero(own + l);
  program.w_min = Eigen::VectorXd::Constant(own + l, -kInfinity);
  program.w_max = -program.w_min;
  program.w_min.tail(l) = w_min.tail(l);
  program.w_max.tail(l) = w_max.tail(l);
  program.JtW.resize(posture.J.cols(), own + l);
  set_posture(posture, program);
  return program;
}

WrenchProgram wrench_set_program(const Problem& problem, const Posture& posture, const Matrix6Xd& E,
                                 Wrench wrench) {
  check_columns(E);
  check_sizes(problem, posture);
  if (wrench == Wrench::kPure) return program_along(problem, posture, E);
  WrenchProgram turned = make_wrench_program(problem, Wrench::kAny);
  set_posture(posture, turned);
  const Matrix6Xd N = remainder(turned.W, E);
  Matrix6Xd W(6, E.cols() + N.cols());
  W << E, N;
  return program_along(problem, posture, W);
}

}  // namespace maxwrench
