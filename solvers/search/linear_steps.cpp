#include "solvers/search/linear_steps.h"

#include <algorithm>

#include "solvers/trajectory/makers.h"

namespace maxwrench {
namespace {

constexpr double kAcceptedRise = 0.05, kPoorRise = 0.25,
                 kGoodRise = 0.7;        // shares of the predicted rise
constexpr double kStepTolerance = 1e-6;  // of a linear program, whose answer is used only as a step

}  // namespace

bool TrustRegion::judge(double risen, double predicted, double size) {
  if (!(risen >= kPoorRise * predicted)) {
    radius_ = 0.4 * size;
  } else if (risen > kGoodRise * predicted && size > 0.9 * radius_) {
    radius_ *= 2;
  }
  return risen >= kAcceptedRise * predicted;
}

void StepRows::clear() {
  entries_.clear();
  low_.clear();
  high_.clear();
}

void StepRows::add(Eigen::Index column, double value) {
  entries_.emplace_back(count(), column, value);
}

void StepRows::end_row(double low, double high) {
  low_.push_back(std::min(low, 0.0));
  high_.push_back(std::max(high, 0.0));
}

void StepRows::add(const Eigen::SparseMatrix<double>& R, const Eigen::VectorXd& low,
                   const Eigen::VectorXd& high, double radius) {
  reach_ = R.cwiseAbs() * Eigen::VectorXd::Ones(R.cols());
  row_of_.assign(static_cast<std::size_t>(R.rows()), -1);
  for (Eigen::Index i = 0; i < R.rows(); ++i) {
    if (low[i] < -radius * reach_[i] && high[i] > radius * reach_[i]) continue;
    row_of_[static_cast<std::size_t>(i)] = count();
    end_row(low[i], high[i]);
  }
  for (int column = 0; column < R.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(R, column); it; ++it) {
      const Eigen::Index row = row_of_[static_cast<std::size_t>(it.row())];
      if (row >= 0) entries_.emplace_back(row, it.col(), it.value());
    }
  }
}

void StepRows::move_to(TrajectoryProgram& program, Eigen::Index columns) const {
  program.r_min = Eigen::Map<const Eigen::VectorXd>(low_.data(), count());
  program.r_max = Eigen::Map<const Eigen::VectorXd>(high_.data(), count());
  program.R.resize(count(), columns);
  program.R.setFromTriplets(entries_.begin(), entries_.end());
}

StepSolver::StepSolver() : ipm_(make_trajectory_ipm(kStepTolerance)) {}

bool StepSolver::solve(const TrajectoryProgram& program, bool coupled) {
  solution_.price = 0;
  by_facets_ = !coupled && BorderedFacets::suits(program) && facets_.solve(program, solution_);
  if (by_facets_) return true;
  ipm_->solve(program, solution_);
  return solution_.status == Status::kOptimal;
}

}  // namespace maxwrench
