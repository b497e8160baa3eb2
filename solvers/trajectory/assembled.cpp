#include <utility>

#include "solvers/trajectory/makers.h"

namespace maxwrench {
namespace {

class AssembledTrajectory : public TrajectorySolver {
 public:
  AssembledTrajectory(std::unique_ptr<LpSolver> solver, bool warm)
      : solver_(std::move(solver)), warm_(warm) {}

  void solve_well_formed(const TrajectoryProgram& program, TrajectorySolution& solution) override {
    if (!same_shape(program)) {
      lp_ = assemble(program);
      keep_shape(program);
      answer_ = {};
    } else {
      update(program, lp_);
    }
    answer_.basis = solution.basis;
    if (!warm_) answer_.basis.clear();
    solver_->solve(lp_, answer_);
    read(program, answer_, solution);
    solution.basis = answer_.basis;
    if (solution.status == Status::kOptimal) solution.residual = recheck(program, solution);
    if (solution.status != Status::kInfeasible || proves_infeasible(program, solution)) return;
    solution.conclude(Status::kNumericalError, "no proof that the program is infeasible holds");
  }

 private:
  /// The properties that determine the pattern of the assembled program.
  struct Shape {
    const Zonotope* actuation = nullptr;
    std::vector<std::pair<int, bool>> instants;  ///< wrench columns; whether they bound the value
    Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> rates, lags;
    int border = 0, first_elastic = 0, scenarios = 0;
    bool max_min = false, elastic = false;
    Eigen::SparseMatrix<double> R;
  };

  static std::pair<int, bool> kind(const TrajectoryProgram& program, int i) {
    return {program.instants[static_cast<std::size_t>(i)].columns(), program.bounds_value(i)};
  }

  bool same_shape(const TrajectoryProgram& program) const {
    const Shape& s = shape_;
    bool same = s.actuation == program.instants.front().actuation &&
                s.instants.size() == program.instants.size() && s.border == program.border() &&
                s.max_min == (program.peak < 0) && s.elastic == program.elastic() &&
                s.first_elastic == program.first_elastic && s.scenarios == program.scenarios &&
                s.lags.rows() == program.lag.rows() && s.lags.cols() == program.lag.cols() &&
                s.R.rows() == program.R.rows() && s.R.nonZeros() == program.R.nonZeros();
    for (int i = 0; same && i < program.size(); ++i) {
      same = s.instants[i] == kind(program, i);
    }
    if (!same || (s.rates != (program.du_max.array() < kInfinity)).any()) return false;
    if ((s.lags != (program.lag.array() > 0)).any()) return false;
    if (program.R.rows() == 0) return true;
    const auto equal = [](const int* a, const int* b, Eigen::Index count) {
      return std::equal(a, a + count, b);
    };
    return equal(s.R.outerIndexPtr(), program.R.outerIndexPtr(), s.R.outerSize() + 1) &&
           equal(s.R.innerIndexPtr(), program.R.innerIndexPtr(), s.R.nonZeros());
  }

  void keep_shape(const TrajectoryProgram& program) {
    shape_.actuation = program.instants.front().actuation;
    shape_.instants.clear();
    for (int i = 0; i < program.size(); ++i) shape_.instants.push_back(kind(program, i));
    shape_.rates = program.du_max.array() < kInfinity;
    shape_.lags = program.lag.array() > 0;
    shape_.border = program.border();
    shape_.first_elastic = program.first_elastic;
    shape_.scenarios = program.scenarios;
    shape_.max_min = program.peak < 0;
    shape_.elastic = program.elastic();
    shape_.R = program.R;
  }

  std::unique_ptr<LpSolver> solver_;
  bool warm_;
  LinearProgram lp_;
  LpSolution answer_;
  Shape shape_;
};

}  // namespace

std::unique_ptr<TrajectorySolver> make_assembled_trajectory(std::unique_ptr<LpSolver> solver,
                                                            bool warm) {
  return std::make_unique<AssembledTrajectory>(std::move(solver), warm);
}

}  // namespace maxwrench
