#include "solvers/certify/bound/equation_points.h"

#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/bound/loop_model.h"

namespace maxwrench {

EquationPoints::EquationPoints(const LoopModel& model) : model_(model) {
  for (const LoopPart& part : model.parts) {
    if (part.kind != LoopPart::Kind::kEquations) continue;
    parts_.push_back(&part);
    corners_.emplace_back(part.f);
  }
}

int EquationPoints::sign(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                         const Eigen::VectorXd& nu) {
  double least = 0, most = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (!(spread(parts_[i]->f.coordinates(), lower, upper) <= kMostSpread)) return 0;
    own_ = nu(parts_[i]->rows);
    values_.noalias() = corners_[i].over(lower, upper).transpose() * own_;
    least += values_.minCoeff();
    most += values_.maxCoeff();
  }
  // The check of the proof in interval arithmetic rounds, too.
  const double off = 4 * kBoundRounding * kMostSpread * nu.cwiseAbs().dot(model_.f);
  return least > off ? 1 : most < -off ? -1 : 0;
}

}  // namespace maxwrench
