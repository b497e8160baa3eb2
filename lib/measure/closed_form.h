#pragma once

#include <functional>
#include <string>

#include "maxwrench/measure.h"
#include "maxwrench/robot.h"

// Functions that the closed-form measures share.

namespace maxwrench {

/// A factor is rank deficient if a pivot of its Gram matrix is below this share of the largest.
inline constexpr double kPivotTolerance = 1e-14;

/// The wrench columns of two contacts. Matrices of this size are on the stack, so that solving
/// allocates nothing.
inline constexpr int kMaxColumns = 12;
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                  kMaxColumns, kMaxColumns>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxColumns, 1>;

/// Whether the factored symmetric positive semidefinite matrix has full rank.
bool regular(const Eigen::LDLT<SmallMatrix>& factor);

/// Throws std::invalid_argument, with the name of the measure, unless B has full row rank.
void require_full_row_rank(const Robot& robot, const std::string& measure);

/// Throws std::invalid_argument, with the name of the measure, unless every actuator has min < 0 <
/// max.
void require_both_directions(const Robot& robot, const std::string& measure);

/// The smaller of each actuator's two absolute limits, m numbers [N or N m]: the reciprocals of
/// W_u.
Eigen::VectorXd smaller_limits(const Zonotope& actuation);

/// W_u B^+, m×n [-, per N or N m]: maps generalised forces tau to the efforts u = B^+ tau, as
/// shares of the smaller of each actuator's two absolute limits. Throws std::invalid_argument, with
/// the name of the measure, if B does not have full row rank or an actuator cannot act in both
/// directions.
Eigen::MatrixXd weighted_inverse(const Robot& robot, const std::string& measure);

/// A measure for programs in which some wrench columns may only push or must be zero, from a closed
/// form for free columns.
std::unique_ptr<Measure> make_one_sided(std::function<std::unique_ptr<Measure>()> closed_form);

/// Ends an evaluation without an answer. Clears the multiplier of an earlier evaluation, which
/// could be mistaken for a proof.
Status without_answer(Status how, const char* why, Capability& capability);

/// Fills the capability of a measure that has no wrench and no efforts and does not depend on
/// tau_d.
void fill_score(double beta, Eigen::Index velocities, Capability& capability);

}  // namespace maxwrench
