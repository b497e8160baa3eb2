#include <algorithm>
#include <cmath>
#include <vector>

#include "solvers/trajectory/by_facets.h"
#include "solvers/trajectory/common_factor.h"
#include "solvers/trajectory/even_efforts.h"
#include "solvers/trajectory/makers.h"
#include "solvers/wrench/makers.h"

namespace maxwrench {
namespace {

constexpr double kConfirmed = 1e-9;
/// The share of the limits by which a common factor may violate them (`CommonFactor`), and the
/// largest such violation [N, N m].
constexpr double kHeldOfLimits = 1e-8, kMostHeld = 1e-7;

class FacetsOrIpm : public TrajectorySolver {
 public:
  void solve_well_formed(const TrajectoryProgram& program, TrajectorySolution& solution) override {
    solution.basis.clear();
    solution.iterations = 0;
    if (suits(program) && instant_by_instant(program, solution)) return;
    if (suits_common(program) && all_instants(program, solution)) return;
    ipm_->solve_well_formed(program, solution);
  }

 private:
  /// For an elastic program, the hard one is tried.
  bool suits(const TrajectoryProgram& program) {
    return program.border() == 0 && bounded_by_facets(program) && prepare_efforts(program);
  }

  bool suits_common(const TrajectoryProgram& program) {
    return CommonFactor::suits(program) && prepare_efforts(program);
  }

  bool prepare_efforts(const TrajectoryProgram& program) {
    efforts_.resize(static_cast<std::size_t>(program.scenarios));
    for (int s = 0; s < program.scenarios; ++s) {
      const auto first = static_cast<std::size_t>(s * program.length());
      if (!efforts_[static_cast<std::size_t>(s)].prepare(*program.instants[first].actuation)) {
        return false;
      }
    }
    return true;
  }

  /// Returns true if `recheck` or a proof confirms the verdict.
  bool all_instants(const TrajectoryProgram& program, TrajectorySolution& solution) {
    clear_multipliers(program, solution);
    solution.y.resize(0);
    const Status status = factor_.solve(program, solution);
    if (status == Status::kInfeasible) {
      if (slackens(program) || !proves_infeasible(program, solution)) return false;
      solution.conclude(Status::kInfeasible, "no factor balances all instants");
      return true;
    }
    return status == Status::kOptimal && confirm(program, solution);
  }

  /// Returns true if the worst instant alone determines the value and `recheck` or a proof confirms
  /// it.
  bool instant_by_instant(const TrajectoryProgram& program, TrajectorySolution& solution) {
    int worst = 0;
    solution.value = kInfinity;
    for (int i = 0; i < program.size(); ++i) {
      facets_->solve_well_formed(program.instants[i], false, capability_);
      if (capability_.status == Status::kInfeasible) {
        return !slackens(program) && prove(program, i, solution);
      }
      if (capability_.status != Status::kOptimal || !std::isfinite(capability_.beta)) return false;
      if (capability_.beta >= solution.value) continue;
      solution.value = capability_.beta;
      lambda_ = capability_.lambda;
      worst = i;
    }
    clear_multipliers(program, solution);
    solution.lambda.col(worst) = lambda_;
    solution.pi[worst] = 1;
    solution.y.resize(0);
    return confirm(program, solution);
  }

  /// `recheck` fails where a slack would be cheaper or where these efforts violate the rates.
  bool confirm(const TrajectoryProgram& program, TrajectorySolution& solution) {
    if (!fill_efforts(program, solution)) return false;
    solution.residual = recheck(program, solution);
    Residual others = solution.residual;
    if (program.common && others.bounds <= most_held(program)) others.bounds = 0;
    if (!others.within(kConfirmed * (1 + std::abs(solution.value)))) return false;
    solution.conclude(Status::kOptimal);
    return true;
  }

  static double most_held(const TrajectoryProgram& program) {
    const Zonotope& set = *program.instants.front().actuation;
    double largest = 0;
    for (const double limit : set.u_max) largest = std::max(largest, limit);
    return std::min(kMostHeld, kHeldOfLimits * largest);
  }

  static bool slackens(const TrajectoryProgram& program) {
    return program.elastic() && program.first_elastic < program.size();
  }

  static void clear_multipliers(const TrajectoryProgram& program, TrajectorySolution& solution) {
    const Zonotope& set = *program.instants.front().actuation;
    solution.lambda.setZero(set.dimension(), program.size());
    solution.mu.setZero(set.actuators(), program.size() - 1);
    solution.kappa.setZero(program.lag.rows(), program.lag.cols());
    solution.pi.setZero(program.size());
    solution.nu.setZero(program.R.rows());
  }

  bool prove(const TrajectoryProgram& program, int i, TrajectorySolution& solution) {
    clear_multipliers(program, solution);
    solution.lambda.col(i) = capability_.lambda;
    if (!proves_infeasible(program, solution)) return false;
    solution.conclude(Status::kInfeasible, "no actuator efforts balance an instant");
    return true;
  }

  /// All instants exert the value, with the efforts that load the most loaded actuator least.
  bool fill_efforts(const TrajectoryProgram& program, TrajectorySolution& solution) {
    const Zonotope& set = *program.instants.front().actuation;
    const int N = program.size();
    solution.u.resize(set.actuators(), N);
    solution.s.setZero(set.dimension(), N);
    solution.w.resize(N);
    solution.price = 0;
    for (int i = 0; i < N; ++i) {
      const WrenchProgram& at = program.instants[i];
      solution.w[i].setConstant(1, solution.value / at.c_w[0]);
      tau_ = at.tau_d + at.JtW.col(0) * solution.w[i][0];
      EvenEfforts& efforts = efforts_[static_cast<std::size_t>(i / program.length())];
      if (!efforts.solve(tau_, solution.u.col(i))) return false;
    }
    return true;
  }

  std::unique_ptr<WrenchSolver> facets_ = make_facets();
  std::unique_ptr<TrajectorySolver> ipm_ = make_trajectory_ipm();
  CommonFactor factor_;
  std::vector<EvenEfforts> efforts_;  ///< of each scenario
  Capability capability_;
  Eigen::VectorXd lambda_, tau_;
};

}  // namespace

std::unique_ptr<TrajectorySolver> make_facets_or_ipm() { return std::make_unique<FacetsOrIpm>(); }

}  // namespace maxwrench
