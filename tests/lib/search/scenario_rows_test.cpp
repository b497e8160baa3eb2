#include "lib/search/scenario_rows.h"

#include <gtest/gtest.h>

#include "lib/math/random.h"
#include "lib/search/facet_program.h"
#include "maxwrench/solve.h"
#include "solvers/solve/method.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/list_tasks.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

class ScenarioRowsOf : public testing::TestWithParam<ListForm> {
 protected:
  /// Calls see(program, theta_r, w) at postures that have a value.
  template <class See>
  void at_postures(std::uint64_t seed, const See& see) {
    const Problem task = scenario_task(GetParam().wrench, GetParam().tables);
    FacetProgram program(task, Wrench::kPure, resolve_lower_level(task, Case()).make_measure);
    Random random(seed);
    int seen = 0;
    for (int draw = 0; draw < 4000 && seen < samples(100); ++draw) {
      Eigen::VectorXd theta_r(task.redundancy());
      for (Eigen::Index i = 0; i < theta_r.size(); ++i) {
        theta_r[i] = random.uniform(task.theta_r_min[i], task.theta_r_max[i]);
      }
      Eigen::VectorXd w;
      if (!program.set_out(theta_r, 0, w) || w.isZero()) continue;
      ++seen;
      see(task, program, theta_r, w, random);
    }
    EXPECT_GE(seen, samples(40));
  }
};

INSTANTIATE_TEST_SUITE_P(All, ScenarioRowsOf, testing::ValuesIn(list_forms()),
                         [](const auto& each) {
                           std::string name = each.param.name;
                           for (char& c : name)
                             c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

/// The value of the list keeps all rows, and no more does: its scan and the rows are two ways to
/// the same end.
TEST_P(ScenarioRowsOf, HoldTheValueAndNoMore) {
  at_postures(1, [](const Problem& task, FacetProgram& program, const Eigen::VectorXd& theta_r,
                    const Eigen::VectorXd& w, Random&) {
    const auto exceeded = [&](double t) {
      EXPECT_TRUE(program.evaluate(theta_r, Eigen::VectorXd::Constant(1, t)));
      const Eigen::Index rows = ScenarioRows::count(task, Wrench::kPure);
      return (program.rows() - program.row_max()).head(rows).maxCoeff();
    };
    EXPECT_LE(exceeded(w[0]), 1e-7 * (1 + std::abs(w[0])));
    EXPECT_GT(exceeded(w[0] + 1e-3 * (1 + std::abs(w[0]))), 0);
  });
}

/// By theta_r and t, at any t. A row has a kink where its worst case changes, so few may differ.
TEST_P(ScenarioRowsOf, DerivativesAreThoseOfDifferences) {
  long rows = 0, off = 0;
  at_postures(2, [&](const Problem& task, FacetProgram& program, const Eigen::VectorXd& theta_r,
                     const Eigen::VectorXd&, Random& random) {
    constexpr double kStep = 1e-6;
    const Eigen::VectorXd w = Eigen::VectorXd::Constant(1, random.uniform(-10, 10));
    ASSERT_TRUE(program.evaluate(theta_r, w));
    program.linearize();
    const Eigen::VectorXd dw = Eigen::VectorXd::Constant(1, random.uniform(-1, 1));
    const Eigen::VectorXd dtheta =
        Eigen::VectorXd::NullaryExpr(theta_r.size(), [&] { return random.uniform(-1, 1); });
    const Eigen::VectorXd exact = program.by_theta_r() * dtheta + program.by_w() * dw;
    if (!program.evaluate(theta_r + kStep * dtheta, w + kStep * dw)) return;
    const Eigen::VectorXd above = program.rows();
    if (!program.evaluate(theta_r - kStep * dtheta, w - kStep * dw)) return;
    const Eigen::VectorXd slope = (above - program.rows()) / (2 * kStep);
    const Eigen::Index count = ScenarioRows::count(task, Wrench::kPure);
    const auto size = (program.row_unit() + slope.cwiseAbs()).head(count).array();
    rows += count;
    off += ((exact - slope).head(count).array().abs() > 1e-5 * size).count();
  });
  EXPECT_LE(off, rows / 1000);
}

/// The default search of a list solves between the facets and ends at its
/// optimum, whatever the seed.
TEST_P(ScenarioRowsOf, SLOW_TheDefaultSearchEndsAtOneValue) {
  const Problem task = scenario_task(GetParam().wrench, GetParam().tables);
  EXPECT_EQ(default_search(task, "linf_polytope"), "facet_sqp+cmaes");
  double best = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    Options options;
    options.seed = seed;
    const double beta = solve(task, options).beta();
    if (seed == 1) best = beta;
    EXPECT_NEAR(beta, best, 1e-5 * best);
  }
}

TEST(ScenarioRows, AreOfPureWrenchesWithFacets) {
  const Problem list = scenario_task("set = [[0,0,0,0,0,2], [0,0,0,0,0,-1]]", "");
  const Eigen::Index pairs = list.robot.actuation.facet_pairs();
  EXPECT_EQ(ScenarioRows::count(list, Wrench::kPure), 4 * pairs);
  EXPECT_EQ(ScenarioRows::count(list, Wrench::kAny), 0);  // w would be of one scenario
  EXPECT_EQ(ScenarioRows::count(load_problem("uvms/valve"), Wrench::kPure), 0);
  EXPECT_EQ(default_search(list, "linf_polytope", Wrench::kAny), general_search());
  Options options;
  options.search = "facet_sqp";
  options.wrench = Wrench::kAny;
  EXPECT_NE(rejection_of([&] { solve(list, options); }).find("facet_sqp"), std::string::npos);
}

}  // namespace
}  // namespace maxwrench
