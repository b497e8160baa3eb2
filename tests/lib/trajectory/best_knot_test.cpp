#include <glpk.h>
#include <gtest/gtest.h>

#include <memory>

#include "lib/math/random.h"
#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

// The best knot of an impulse is a choice, so it is a mixed-integer program over all k peaks at
// once:
//
//     max t   subject to the impulse's rows,   t <= w_h + M (1 - z_h),   sum z_h = 1,   z_h in {0,
//     1}.
//
// w_h, the only column of knot h's wrench, lies between the values low_h and high_h that its own
// balance allows without its neighbours. Some z_h is 1, so t <= max high at an optimum, and with
// M = max high - min low the rows of all other knots say nothing.
class ByIntegers {
 public:
  explicit ByIntegers(const TrajectoryProgram& program) : problem_(glp_create_prob()) {
    glp_set_obj_dir(problem_.get(), GLP_MAX);
    LinearProgram lp = assemble(program);
    add(lp);
    t_ = glp_add_cols(problem_.get(), 1);
    glp_set_col_bnds(problem_.get(), t_, GLP_FR, 0, 0);
    glp_set_obj_coef(problem_.get(), t_, 1);
    one_ = glp_add_rows(problem_.get(), 1);
    glp_set_row_bnds(problem_.get(), one_, GLP_FX, 1, 1);
  }

  void add_peak(int w, double M) {
    const int z = glp_add_cols(problem_.get(), 1);
    glp_set_col_kind(problem_.get(), z, GLP_BV);
    const int row = glp_add_rows(problem_.get(), 1);
    glp_set_row_bnds(problem_.get(), row, GLP_UP, 0, M);
    const int columns[] = {0, t_, w + 1, z};
    const double values[] = {0, 1, -1, M};
    glp_set_mat_row(problem_.get(), row, 3, columns, values);
    choices_.push_back(z);
  }

  double solve() {
    std::vector<int> columns = {0};
    columns.insert(columns.end(), choices_.begin(), choices_.end());
    const std::vector<double> ones(columns.size(), 1);
    glp_set_mat_row(problem_.get(), one_, static_cast<int>(choices_.size()), columns.data(),
                    ones.data());
    glp_smcp relaxed;
    glp_init_smcp(&relaxed);
    relaxed.msg_lev = GLP_MSG_OFF;
    if (glp_simplex(problem_.get(), &relaxed) != 0) return -kInfinity;
    glp_iocp options;
    glp_init_iocp(&options);
    options.msg_lev = GLP_MSG_OFF;
    if (glp_intopt(problem_.get(), &options) != 0) return -kInfinity;
    if (glp_mip_status(problem_.get()) != GLP_OPT) return -kInfinity;
    return glp_mip_obj_val(problem_.get());
  }

 private:
  void add(const LinearProgram& lp) {
    glp_add_rows(problem_.get(), lp.rows());
    glp_add_cols(problem_.get(), lp.cols());
    for (int r = 0; r < lp.rows(); ++r) {
      glp_set_row_bnds(problem_.get(), r + 1, GLP_FX, lp.b[r], lp.b[r]);
    }
    std::vector<int> rows;
    std::vector<double> values;
    for (int c = 0; c < lp.cols(); ++c) {
      const bool low = lp.l[c] > -kInfinity, high = lp.u[c] < kInfinity;
      const int kind = lp.l[c] == lp.u[c] ? GLP_FX
                       : low && high      ? GLP_DB
                       : low              ? GLP_LO
                       : high             ? GLP_UP
                                          : GLP_FR;
      glp_set_col_bnds(problem_.get(), c + 1, kind, low ? lp.l[c] : 0, high ? lp.u[c] : 0);
      rows.assign(1, 0);
      values.assign(1, 0);
      for (Eigen::SparseMatrix<double>::InnerIterator it(lp.A, c); it; ++it) {
        rows.push_back(static_cast<int>(it.row()) + 1);
        values.push_back(it.value());
      }
      glp_set_mat_col(problem_.get(), c + 1, static_cast<int>(rows.size()) - 1, rows.data(),
                      values.data());
    }
  }

  struct Delete {
    void operator()(glp_prob* problem) const { glp_delete_prob(problem); }
  };
  std::unique_ptr<glp_prob, Delete> problem_;
  std::vector<int> choices_;
  int t_ = 0, one_ = 0;
};

/// The best over all knots; `starts_wanted` are their instants.
double by_integers(const TrajectoryProgram& program, const std::vector<int>& peaks) {
  const auto box = find_wrench_solver("condensed").make();
  double low = kInfinity, high = -kInfinity;
  Capability capability;
  for (const int peak : peaks) {
    WrenchProgram at = program.instants[static_cast<std::size_t>(peak)];
    box->solve(at, false, capability);
    if (capability.status != Status::kOptimal) return -kInfinity;
    high = std::max(high, capability.beta);
    at.c_w *= -1;
    box->solve(at, false, capability);
    if (capability.status != Status::kOptimal) return -kInfinity;
    low = std::min(low, -capability.beta);
  }
  ByIntegers choice(program);
  // The columns of an instant are its efforts and its wrench.
  const int efforts = program.instants.front().actuation->actuators();
  for (const int peak : peaks) choice.add_peak(peak * (efforts + 1) + efforts, high - low);
  return choice.solve();
}

/// The knot found, after comparing with the mixed-integer program; 0 where both have no answer.
int compare(const Problem& problem, const Eigen::MatrixXd& knots) {
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, find_trajectory_solver("ipm").make);
  const Trajectory& trajectory = evaluator.evaluate(knots);
  const TrajectoryProgram& program = evaluator.program();
  const int k = problem.motion->k;
  // All these impulses begin with a block for the start, and knots are evenly spaced after it.
  const int spacing = (program.size() - 1) / k;
  EXPECT_EQ(spacing * k + 1, program.size());
  std::vector<int> peaks;
  for (int knot = 1; knot <= k; ++knot) peaks.push_back(knot * spacing);
  const double best = by_integers(program, peaks);
  EXPECT_EQ(trajectory.status == Status::kOptimal, best > -kInfinity) << trajectory.reason.c_str();
  if (trajectory.status != Status::kOptimal) return 0;
  EXPECT_NEAR(trajectory.value, best, 1e-7 * (1 + std::abs(best)));
  return trajectory.t_h;
}

Problem load_impulse(const char* name, Scheme scheme, double T) {
  Problem problem = load_problem(name);
  problem.motion->scheme = scheme;
  problem.motion->T = T;
  problem.motion->t_h = 0;
  problem.robot.collision = nullptr;
  return problem;
}

TEST(BestKnot, OfTheShippedImpulsesIsThatOfAMixedIntegerProgram) {
  for (const char* name : {"uvms/valve_impulse", "uvms/lift_impulse"}) {
    for (const Scheme scheme : {Scheme::kSpline, Scheme::kForward, Scheme::kBackward}) {
      const Problem problem = load_impulse(name, scheme, 2.5);
      EXPECT_GT(compare(problem, problem.theta_r_default.transpose().replicate(4, 1)), 0) << name;
    }
  }
}

TEST(BestKnot, OfRandomTablesIsThatOfAMixedIntegerProgram) {
  Random random(3);
  std::vector<int> found(5, 0);
  for (const char* name : {"uvms/valve_impulse", "uvms/lift_impulse"}) {
    for (const Scheme scheme : {Scheme::kForward, Scheme::kBackward}) {
      const Problem problem = load_impulse(name, scheme, 2.5);
      for (int sample = 0; sample < 10; ++sample) {
        Eigen::MatrixXd knots = problem.theta_r_default.transpose().replicate(4, 1);
        for (double& q : knots.reshaped()) q += random.uniform(-0.1, 0.1);
        ++found[static_cast<std::size_t>(compare(problem, knots))];
      }
    }
  }
  // The comparison means something: most have an answer, and not always at one knot.
  EXPECT_LT(found[0], 20);
  EXPECT_GE(std::count_if(found.begin() + 1, found.end(), [](int n) { return n > 0; }), 2);
}

}  // namespace
}  // namespace maxwrench
