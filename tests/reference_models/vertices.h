#pragma once

#include <Eigen/Dense>
#include <optional>

#include "maxwrench/wrench_program.h"

namespace maxwrench {

/// max c'x subject to A x = b, l <= x <= u, by trying every vertex: as many columns as A has rows
/// are basic, those without limits always, and the others at one of their limits. Slow and
/// independent of every solver. Nothing if no vertex is feasible.
std::optional<double> best_vertex(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                  const Eigen::VectorXd& c, const Eigen::VectorXd& l,
                                  const Eigen::VectorXd& u);

/// The same of A = [B, -J'W], x = (u, w).
std::optional<double> brute_force(const WrenchProgram& program);

}  // namespace maxwrench
