#include "solvers/search/composition.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "maxwrench/strategies.h"
#include "tests/support/known.h"

namespace maxwrench {
namespace {

double hill(const Eigen::VectorXd& x) {
  return -(x.array() - 0.3).matrix().squaredNorm() - std::abs(x[0] - x[1]);
}

Known objective_of(const Known::Function& f) {
  return {f, Eigen::VectorXd::Constant(3, -1), Eigen::VectorXd::Constant(3, 1)};
}

SearchResult run_search(const char* name, Known& known, long budget) {
  SearchOptions options;
  options.budget = budget;
  return find_search(name).make()->maximize(known, options);
}

/// A tenth is for the sample: 100 evaluations of 1000.
TEST(Composition, FirstStageIsThatSearchAlone) {
  Known known = objective_of(hill);
  const SearchResult sample = run_search("sample", known, 100);
  const SearchResult both = run_search("sample+slsqp", known, 1000);
  ASSERT_GT(both.history.size(), sample.history.size());
  for (std::size_t i = 0; i < sample.history.size(); ++i) {
    EXPECT_EQ(both.history[i].value, sample.history[i].value);
    EXPECT_EQ(both.history[i].evaluations, sample.history[i].evaluations);
  }
  EXPECT_GT(both.history[sample.history.size()].evaluations, 100);
}

TEST(Composition, LaterStageBeginsAtTheBest) {
  std::vector<Eigen::VectorXd> seen;
  Known known = objective_of([&](const Eigen::VectorXd& x) {
    seen.push_back(x);
    return hill(x);
  });
  const SearchResult sample = run_search("sample", known, 100);
  seen.clear();
  run_search("sample+cobyla", known, 1000);
  ASSERT_GT(seen.size(), 100U);
  EXPECT_LT((seen[100] - sample.theta_r).norm(), 1e-12);
}

/// The flow has half of the evaluations and ends soon; the next stage gets what it leaves.
TEST(Composition, LeftoversGoOn) {
  Known known = objective_of([](const Eigen::VectorXd& x) { return -x.squaredNorm(); });
  const SearchResult first = run_search("nullspace", known, 2000);
  const SearchResult both = run_search("nullspace+crs2", known, 4000);
  EXPECT_LT(first.evaluations, 2000);
  long spent = 0;
  for (const Call& call : both.calls) spent += call.method == "crs2" ? call.evaluations : 0;
  EXPECT_GT(spent, 2000);
  EXPECT_LE(both.evaluations, 4000);
}

TEST(Composition, CallsStandInOrder) {
  Known known = objective_of(hill);
  const SearchResult result = run_search("sample+slsqp+cmaes", known, 3000);
  bool later = false;
  for (const Call& call : result.calls) {
    EXPECT_TRUE(call.method == "slsqp" || call.method == "cmaes") << call.method;
    EXPECT_FALSE(later && call.method == "slsqp");
    later = later || call.method == "cmaes";
  }
  EXPECT_TRUE(later);
}

/// Without a value in the first stage the next one begins by itself.
TEST(Composition, GoesOnFromNothing) {
  long count = 0;
  Known known =
      objective_of([&](const Eigen::VectorXd& x) { return ++count <= 100 ? -kInfinity : hill(x); });
  const SearchResult result = run_search("sample+cmaes", known, 1000);
  EXPECT_EQ(result.status, Status::kBestFound);
  EXPECT_GT(result.value, -0.1);
}

std::string rejection(const char* name) {
  try {
    find_search(name);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Composition, RejectsWhatIsNoStage) {
  for (const char* name : {"", "+", "cmaes+", "+cmaes", "sample+nothing", "sample cmaes"}) {
    EXPECT_NE(rejection(name).find("expected one of slp dp joint_nlp sample grid annealing"),
              std::string::npos)
        << name << ": " << rejection(name);
  }
  for (const char* name : {"cmaes+grid", "sample+sample", "sample+cmaes+direct_l"}) {
    EXPECT_NE(rejection(name).find("expected as a later stage one of slp annealing cmaes"),
              std::string::npos)
        << name << ": " << rejection(name);
  }
  EXPECT_THROW(find_search("sample+dp"), std::invalid_argument);
  EXPECT_NO_THROW(find_search("dp+slp"));
  EXPECT_NO_THROW(find_search("slp+cmaes"));
}

TEST(Composition, IsLocalIfAllItsStagesAre) {
  EXPECT_TRUE(find_search("nullspace").local);
  EXPECT_FALSE(find_search("nullspace+cmaes").local);
  EXPECT_FALSE(find_search("sample+nullspace").local);
  EXPECT_EQ(find_search("sample+nullspace").name, "sample+nullspace");
}

}  // namespace
}  // namespace maxwrench
