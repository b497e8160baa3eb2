#include "maxwrench/wrench_program.h"
#include "solvers/wrench/makers.h"

namespace maxwrench {
namespace {

class Assembled : public WrenchSolver {
 public:
  Assembled(std::unique_ptr<LpSolver> solver, bool warm)
      : solver_(std::move(solver)), warm_(warm) {}

  void solve_well_formed(const WrenchProgram& program, bool efforts,
                         Capability& capability) override {
    const int m = program.actuation->actuators();
    if (actuation_ != program.actuation || columns_ != program.columns()) {
      lp_ = assemble(program);
      solution_ = {};
      actuation_ = program.actuation;
      columns_ = program.columns();
    } else {
      update(program, lp_);
    }
    if (!warm_) solution_.basis.clear();
    solver_->solve(lp_, solution_);
    capability.status = solution_.status;
    capability.reason = solution_.reason;
    capability.iterations = solution_.iterations;
    if (solution_.status == Status::kInfeasible) capability.lambda = solution_.certificate;
    if (solution_.status != Status::kOptimal) return;
    capability.beta = solution_.objective;
    capability.w = solution_.x.tail(columns_);
    capability.lambda = solution_.lambda;
    if (efforts) capability.u = solution_.x.head(m);
  }

 private:
  std::unique_ptr<LpSolver> solver_;
  bool warm_;
  LinearProgram lp_;
  LpSolution solution_;
  const Zonotope* actuation_ = nullptr;
  int columns_ = 0;
};

}  // namespace

std::unique_ptr<WrenchSolver> make_assembled(std::unique_ptr<LpSolver> solver, bool warm) {
  return std::make_unique<Assembled>(std::move(solver), warm);
}

}  // namespace maxwrench
