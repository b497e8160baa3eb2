#include "solvers/lp/box.h"

#include "solvers/lp/assembled.h"
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

  /// The iterations are those of both methods.
  void solve_assembled(const WrenchProgram& program, bool efforts, Capability& capability) {
    const int before = capability.iterations;
    assembled_->solve(program, efforts, capability);
    capability.iterations += before;
  }

  Elimination elimination_;
  Tableau tableau_;
  Eigen::VectorXd sum_;
  std::unique_ptr<LpSolver> simplex_ = make_simplex();
  std::unique_ptr<WrenchSolver> assembled_ = make_assembled(make_simplex(), false);
};

}  // namespace

std::unique_ptr<WrenchSolver> make_box() { return std::make_unique<Box>(); }

}  // namespace maxwrench
