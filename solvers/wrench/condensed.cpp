#include <algorithm>

#include "solvers/lp/makers.h"
#include "solvers/wrench/efforts.h"
#include "solvers/wrench/elimination.h"
#include "solvers/wrench/makers.h"
#include "solvers/wrench/padded.h"
#include "solvers/wrench/tableau.h"

namespace maxwrench {
namespace {

class Condensed : public WrenchSolver {
 public:
  void solve_well_formed(const WrenchProgram& program, bool efforts,
                         Capability& capability) override {
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
      drop_rounding(capability.lambda);
      if (proves_infeasible(program, capability.lambda)) return;
      return solve_assembled(program, efforts, capability);
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
    const int k = program.columns();
    tableau_.resize(set.facet_pairs(), k);
    tableau_.c = program.c_w;
    const int stride = tableau_.stride();
    const auto n = static_cast<Eigen::Index>(set.dimension());
    if (loads_.rows() != stride || loads_.cols() != n) loads_.setZero(stride, n);
    loads_.bottomRows(stride - k).setZero();
    for (int j = 0; j < k; ++j) {
      for (Eigen::Index row = 0; row < n; ++row) loads_(j, row) = program.JtW(row, j);
    }
    with_length(stride, [&](auto length) { load_rows(program, length); });
    tableau_.low.tail(k) = program.w_min;
    tableau_.high.tail(k) = program.w_max;
  }

  template <class Length>
  void load_rows(const WrenchProgram& program, Length stride) {
    const Zonotope& set = *program.actuation;
    for (int i = 0; i < set.facet_pairs(); ++i) {
      double offset = 0;
      for (int column = 0; column < stride; column += kLanes<Length>) {
        double sum[kLanes<Length>] = {};
        double tau = 0;
        for_normal(set, i, [&](Eigen::Index row, double a) {
          const double* const load = &loads_(column, row);
          for (int pack = 0; pack < kLanes<Length>; ++pack) sum[pack] += a * load[pack];
          tau += a * program.tau_d[row];
        });
        std::copy(sum, sum + kLanes<Length>, tableau_.row(i) + column);
        offset = tau;  // the same in each chunk
      }
      tableau_.low[i] = set.b_min[i] - offset;
      tableau_.high[i] = set.b_max[i] - offset;
    }
  }

  /// Calls body(row, entry) for the nonzero entries of normal i. Most are zero, because thrusters
  /// and joints are independent.
  template <class Body>
  static void for_normal(const Zonotope& set, int i, Body&& body) {
    const int* const begin = set.N_nonzero.outerIndexPtr() + i;
    for (int entry = begin[0]; entry < begin[1]; ++entry) {
      body(set.N_nonzero.innerIndexPtr()[entry], set.N_nonzero.valuePtr()[entry]);
    }
  }

  void fill(const WrenchProgram& program, Capability& capability) const {
    capability.w = tableau_.x;
    capability.beta = program.c_w.dot(tableau_.x);
    fill_lambda(*program.actuation, capability.lambda);
  }

  void fill_lambda(const Zonotope& set, Eigen::VectorXd& lambda) const {
    lambda.setZero(set.dimension());
    for (int i = 0; i < set.facet_pairs(); ++i) {
      const double multiplier = tableau_.multipliers[i];
      if (multiplier == 0) continue;
      for_normal(set, i, [&](Eigen::Index j, double a) { lambda[j] -= a * multiplier; });
    }
  }

  /// Counts the iterations of both methods.
  void solve_assembled(const WrenchProgram& program, bool efforts, Capability& capability) {
    const int before = capability.iterations;
    assembled_->solve_well_formed(program, efforts, capability);
    capability.iterations += before;
  }

  Elimination elimination_;
  Tableau tableau_;
  Eigen::MatrixXd loads_;  ///< (J'W)', padded with zeros as the rows of the tableau are
  std::unique_ptr<LpSolver> simplex_ = make_simplex();
  std::unique_ptr<WrenchSolver> assembled_ = make_assembled(make_simplex(), false);
};

}  // namespace

std::unique_ptr<WrenchSolver> make_condensed() { return std::make_unique<Condensed>(); }

}  // namespace maxwrench
