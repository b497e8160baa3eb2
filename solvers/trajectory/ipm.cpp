#include "lib/math/farkas.h"
#include "solvers/trajectory/embedding.h"
#include "solvers/trajectory/makers.h"

namespace maxwrench {
namespace {

/// The permitted error of the least sum of slacks [N, N m].
constexpr double kLeast = 1e-9;

/// Leaves out rates and slacks until the embedding needs them.
class Ipm : public TrajectorySolver {
 public:
  explicit Ipm(double tolerance) : tolerance_(tolerance) {}

  void solve_well_formed(const TrajectoryProgram& program, TrajectorySolution& solution) override {
    solution.basis.clear();
    solution.iterations = 0;
    bool rates = !(program.du_max.array() < kInfiniteBound).any();
    bool slacks = !program.elastic();
    for (;;) {
      // Each has its own storage, so nothing is resized from call to call.
      Embedding& embedding = embeddings_[rates ? 1 : 0][slacks ? 1 : 0];
      const auto end = embedding.run(program, rates, slacks, tolerance_, solution);
      if (end == Embedding::End::kVerdict) return;
      if (end == Embedding::End::kNone) {
        const char* const reason = embedding.reason();
        if (!lacks_balance(program, solution)) solution.conclude(Status::kNumericalError, reason);
        return;
      }
      (end == Embedding::End::kNeedsRates ? rates : slacks) = true;
    }
  }

 private:
  /// Programs that are slightly infeasible are hard to distinguish from feasible ones. The least
  /// sum of slacks that balances all instants is a feasible program. If it is not zero, its
  /// multipliers prove that there is no answer without slack.
  bool lacks_balance(const TrajectoryProgram& program, TrajectorySolution& solution) {
    if (program.elastic()) return false;
    TrajectoryProgram least = program;
    least.rho = 1;
    least.first_elastic = 0;
    least.peak = 0;
    for (WrenchProgram& at : least.instants) at.c_w.setZero();
    const auto end = embeddings_[1][1].run(least, true, true, kLeast, solution);
    if (end != Embedding::End::kVerdict || solution.status != Status::kOptimal) return false;
    solution.lambda *= -1;
    if (!proves_infeasible(program, solution)) return false;
    solution.conclude(Status::kInfeasible, "no efforts and wrenches balance all instants");
    return true;
  }

  const double tolerance_;  ///< permitted error of an optimum, relative to 1 + |value|
  Embedding embeddings_[2][2];
};

}  // namespace

std::unique_ptr<TrajectorySolver> make_trajectory_ipm(double tolerance) {
  return std::make_unique<Ipm>(tolerance);
}

}  // namespace maxwrench
