#include "solvers/lp/box.h"

#include "solvers/lp/efforts.h"
#include "solvers/lp/elimination.h"
#include "solvers/lp/simplex.h"
#include "solvers/lp/tableau.h"

namespace maxwrench {
namespace {

class Box : public WrenchSolver {
 public:
  void solve(const WrenchProgram& program, bool efforts, Capability& capability) override {
    capability.iterations = 0;
    const bool eliminated = elimination_.load(program, tableau_);
    if (!eliminated && (!program.actuation->has_facets || program.columns() == 0)) {
      return solve_assembled(program, efforts, capability);
    }
    if (!eliminated) load_facets(program);
    const Tableau::Outcome outcome = tableau_.solve();
    capability.iterations = tableau_.iterations;
    if (outcome == Tableau::Outcome::kUndecided) {
      return solve_assembled(program, efforts, capability);
    }
    if (outcome == Tableau::Outcome::kInfeasible) {
      capability.status = Status::kInfeasible;
      capability.reason = "no actuator efforts balance the posture";
      if (eliminated) {
        elimination_.fill_contradiction(program, tableau_, capability.lambda);
      } else {
        fill_lambda(*program.actuation, capability.lambda);
        capability.lambda = -capability.lambda;
      }
      return drop_rounding(capability.lambda);
    }
    capability.status = Status::kOptimal;
    capability.reason = "";
    if (eliminated) return elimination_.fill(program, tableau_, efforts, capability);
    fill(program, capability);
    if (efforts) fill_efforts(program, *simplex_, capability);
  }

 private:
  void load_facets(const WrenchProgram& program) {
    const Zonotope& set = *program.actuation;
    const int n = set.dimension();
    const int f = set.facet_pairs();
    const int k = program.columns();
    tableau_.resize(f, k);
    tableau_.c = program.c_w;
    sum_.resize(k + 1);
    for (int i = 0; i < f; ++i) {
      const auto normal = set.N.col(i);
      sum_.setZero();
      for (int row = 0; row < n; ++row) {
        const double a = normal[row];
        if (a == 0) continue;  // most are: thrusters and joints are independent
        for (int j = 0; j < k; ++j) sum_[j] += a * program.JtW(row, j);
        sum_[k] += a * program.tau_d[row];
      }
      for (int j = 0; j < k; ++j) tableau_.entry(i, j) = sum_[j];
      tableau_.low[i] = set.b_min[i] - sum_[k];
      tableau_.high[i] = set.b_max[i] - sum_[k];
    }
    tableau_.low.tail(k) = program.w_min;
    tableau_.high.tail(k) = program.w_max;
  }

  void fill(const WrenchProgram& program, Capability& capability) const {
    capability.w = tableau_.x;
    capability.beta = program.c_w.dot(tableau_.x);
    fill_lambda(*program.actuation, capability.lambda);
  }

  void fill_lambda(const Zonotope& set, Eigen::VectorXd& lambda) const {
    lambda.setZero(set.dimension());
    for (int i = 0; i < set.facet_pairs(); ++i) {
      if (tableau_.multipliers[i] != 0) lambda -= set.N.col(i) * tableau_.multipliers[i];
    }
  }

  /// From a cold start, so that the answer does not depend on earlier calls.
  void solve_assembled(const WrenchProgram& program, bool efforts, Capability& capability) {
    if (actuation_ != program.actuation || columns_ != program.columns()) {
      assembled_ = assemble(program);
      actuation_ = program.actuation;
      columns_ = program.columns();
    } else {
      update(program, assembled_);
    }
    solution_.basis.clear();
    simplex_->solve(assembled_, solution_);
    capability.status = solution_.status;
    capability.reason = solution_.reason;
    capability.iterations += solution_.iterations;
    if (solution_.status == Status::kInfeasible) capability.lambda = solution_.certificate;
    if (solution_.status != Status::kOptimal) return;
    capability.beta = solution_.objective;
    capability.w = solution_.x.tail(columns_);
    capability.lambda = solution_.lambda;
    if (efforts) capability.u = solution_.x.head(program.actuation->actuators());
  }

  Elimination elimination_;
  Tableau tableau_;
  Eigen::VectorXd sum_;
  std::unique_ptr<LpSolver> simplex_ = make_simplex();
  LinearProgram assembled_;
  LpSolution solution_;
  const Zonotope* actuation_ = nullptr;
  int columns_ = 0;
};

}  // namespace

std::unique_ptr<WrenchSolver> make_box() { return std::make_unique<Box>(); }

}  // namespace maxwrench
