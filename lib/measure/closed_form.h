#pragma once

#include <functional>
#include <string>

#include "maxwrench/measure.h"
#include "maxwrench/robot.h"

// What the closed forms share.

namespace maxwrench {

/// Pivots of a Gram matrix below this share of its largest mean that a factor is rank deficient.
inline constexpr double kPivotTolerance = 1e-14;

/// Wrench columns of two contacts; matrices of this size live on the stack, so that solving
/// allocates nothing.
inline constexpr int kMaxColumns = 12;
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                  kMaxColumns, kMaxColumns>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxColumns, 1>;

/// Whether a symmetric positive semidefinite matrix was factored without losing rank.
bool regular(const Eigen::LDLT<SmallMatrix>& factor);

/// Throws std::invalid_argument that names the measure if B has not full row rank.
void require_full_row_rank(const Robot& robot, const std::string& measure);

/// Throws std::invalid_argument that names the measure if an actuator has not min < 0 < max.
void require_both_directions(const Robot& robot, const std::string& measure);

/// The smaller of each actuator's two absolute limits, m [N or N m]: the reciprocals of W_u.
Eigen::VectorXd smaller_limits(const Zonotope& actuation);

/// W_u B^+, m×n [-, per N or N m]: generalised forces -> efforts u = B^+ tau as shares of the
/// smaller of each actuator's two absolute limits. Throws std::invalid_argument that names the
/// measure if B has not full row rank or an actuator cannot act in both directions.
Eigen::MatrixXd weighted_inverse(const Robot& robot, const std::string& measure);

/// Serves wrench columns that may only push, or rest, with a closed form for free ones.
std::unique_ptr<Measure> make_one_sided(std::function<std::unique_ptr<Measure>()> closed_form);

/// Ends without an answer. The multiplier of an earlier one is cleared: it would pass for a proof.
Status without_answer(Status how, const char* why, Capability& capability);

/// A score that says nothing of a wrench or of efforts, and does not depend on tau_d.
void fill_score(double beta, Eigen::Index velocities, Capability& capability);

}  // namespace maxwrench
