#include <cmath>

#include "lib/math/decompositions.h"
#include "lib/math/rotated.h"
#include "lib/measure/closed_form.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {
namespace {

/// w = sqrt det(A A') with A = W'J (k×n). W, the wrenches that the task can allow at most, selects
/// the rows that span the possible motions of the end effector. d w = w <(A A')^-1 A, d A>.
class Manipulability : public Measure {
 public:
  explicit Manipulability(Matrix6Xd W) : W_0_(std::move(W)) {}

  void evaluate_well_formed(const Posture& posture, const WrenchProgram& /*program*/, bool efforts,
                            Capability& capability) override {
    rotate_into(posture.turn, W_0_, W_);
    A_.noalias() = W_.transpose().lazyProduct(posture.J);
    gram_.noalias() = A_.lazyProduct(A_.transpose());
    ldlt_.compute(gram_);
    if (!regular(ldlt_)) {
      without_answer(Status::kNumericalError, "J is singular", capability);
      return;
    }
    const double w = std::sqrt(ldlt_.vectorD().prod());
    fill_score(w, posture.J.cols(), capability);
    scaled_ = ldlt_.solve(A_);
    capability.beta_J.noalias() = w * W_.lazyProduct(scaled_);
    if (!efforts) return;
    capability.residual = {};
    capability.residual.gap = std::abs(singular_values(A_).prod() - w);
  }

 private:
  Matrix6Xd W_0_, W_;  ///< before and after the turn with the end effector
  Eigen::MatrixXd A_, scaled_;
  SmallMatrix gram_;
  Eigen::LDLT<SmallMatrix> ldlt_;
};

}  // namespace

std::unique_ptr<Measure> make_manipulability(const Problem& problem) {
  return std::make_unique<Manipulability>(problem.W_any);
}

}  // namespace maxwrench
