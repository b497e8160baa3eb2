#include <algorithm>
#include <utility>

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
    const bool lag = program.lag.size() > 0 && (program.lag.array() > 0).any();
    bool rates = !lag && !(program.du_max.array() < kInfiniteBound).any();
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
    if (program.common) border_factor(least);
    for (WrenchProgram& at : least.instants) at.c_w.setZero();
    const auto end = embeddings_[1][1].run(least, true, true, kLeast, solution);
    if (end != Embedding::End::kVerdict || solution.status != Status::kOptimal) return false;
    solution.lambda *= -1;
    if (program.common) set_pi(program, solution);
    if (!proves_infeasible(program, solution)) return false;
    solution.conclude(Status::kInfeasible, "no efforts and wrenches balance all instants");
    return true;
  }

  /// The multipliers of a proof for which no w has a slope, except the one whose limit is that of
  /// the common factor.
  static void set_pi(const TrajectoryProgram& program, TrajectorySolution& solution) {
    for (int i = 0; i < program.size(); ++i) {
      const WrenchProgram& at = program.instants[i];
      solution.pi[i] = at.JtW.col(0).dot(solution.lambda.col(i)) / at.c_w[0];
    }
    const double left = solution.pi.sum();
    int limiting = 0;
    double tightest = -kInfinity;  // of the lower limits if the factor is too small, else the upper
    for (int i = 0; i < program.size(); ++i) {
      const WrenchProgram& at = program.instants[i];
      const bool lower = (left > 0) == (at.c_w[0] > 0);
      const double limit = at.c_w[0] * (lower ? at.w_min[0] : at.w_max[0]);
      const double height = left > 0 ? limit : -limit;
      if (!(height > tightest)) continue;
      tightest = height;
      limiting = i;
    }
    solution.pi[limiting] -= left;
  }

  /// Makes the common factor of one wrench column another variable y.
  static void border_factor(TrajectoryProgram& program) {
    const int p = program.border();
    double low = -kInfinity, high = kInfinity;
    program.common = false;
    program.G.resize(program.instants.size());
    for (std::size_t i = 0; i < program.instants.size(); ++i) {
      WrenchProgram& at = program.instants[i];
      const double per = at.c_w[0];
      const double ends[] = {at.w_min[0] * per, at.w_max[0] * per};
      low = std::max(low, std::min(ends[0], ends[1]));
      high = std::min(high, std::max(ends[0], ends[1]));
      Eigen::MatrixXd G(at.tau_d.size(), p + 1);
      if (p > 0) G.leftCols(p) = program.G[i];
      G.col(p) = -at.JtW.col(0) / per;
      program.G[i] = G;
      at.W.resize(6, 0);
      at.JtW.resize(at.tau_d.size(), 0);
      for (Eigen::VectorXd* each : {&at.c_w, &at.w_min, &at.w_max}) each->resize(0);
    }
    for (auto [limits, end] : {std::pair(&program.y_min, low), std::pair(&program.y_max, high)}) {
      limits->conservativeResize(p + 1);
      (*limits)[p] = end;
    }
    program.R.conservativeResize(program.R.rows(), p + 1);
  }

  const double tolerance_;  ///< permitted error of an optimum, relative to 1 + |value|
  Embedding embeddings_[2][2];
};

}  // namespace

std::unique_ptr<TrajectorySolver> make_trajectory_ipm(double tolerance) {
  return std::make_unique<Ipm>(tolerance);
}

}  // namespace maxwrench
