#include "solvers/plan/embedding.h"
#include "solvers/plan/makers.h"

namespace maxwrench {
namespace {

/// Leaves out rates and slacks until the embedding asks for them.
class Ipm : public PlanSolver {
 public:
  explicit Ipm(double tolerance) : tolerance_(tolerance) {}

  void solve(const PlanProgram& program, PlanSolution& solution) override {
    solution.basis.clear();
    solution.iterations = 0;
    bool rates = !(program.du_max.array() < kInfiniteBound).any();
    bool slacks = !program.elastic();
    for (;;) {
      // Each has its own storage: nothing is sized anew from call to call.
      Embedding& embedding = embeddings_[rates ? 1 : 0][slacks ? 1 : 0];
      const auto end = embedding.run(program, rates, slacks, tolerance_, solution);
      if (end == Embedding::End::kVerdict) return;
      if (end == Embedding::End::kNone) {
        solution.conclude(Status::kNumericalError, embedding.reason());
        return;
      }
      (end == Embedding::End::kNeedsRates ? rates : slacks) = true;
    }
  }

 private:
  const double tolerance_;  ///< how far an optimum may be off, relative to 1 + |value|
  Embedding embeddings_[2][2];
};

}  // namespace

std::unique_ptr<PlanSolver> make_plan_ipm(double tolerance) {
  return std::make_unique<Ipm>(tolerance);
}

}  // namespace maxwrench
