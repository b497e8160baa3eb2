#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <vector>

#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "tests/support/own_strategies.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// Not even an exception of the standard library.
struct OwnFault {
  long at;
};

/// Throws at one of its evaluations, or of its calls of `differentiate`, counted over all threads.
class OwnThrowing : public OwnEase {
 public:
  OwnThrowing(std::atomic<long>& left, bool in_derivatives)
      : left_(left), in_derivatives_(in_derivatives) {}
  void evaluate_well_formed(const Posture& posture, const WrenchProgram& program, bool efforts,
                            Capability& capability) override {
    if (!in_derivatives_) count();
    OwnEase::evaluate_well_formed(posture, program, efforts, capability);
  }
  void differentiate(const Posture& /*posture*/, const WrenchProgram& /*program*/,
                     Capability& /*capability*/) override {
    if (in_derivatives_) count();
  }

 private:
  void count() {
    if (--left_ == 0) throw OwnFault{50};
  }
  std::atomic<long>& left_;
  bool in_derivatives_;
};

/// The library never ends in a fault of ours: neither a crash nor a hang, and the very exception.
void expect_fault(const std::string& search, bool in_derivatives) {
  static std::atomic<long> left;
  static bool derivatives;
  derivatives = in_derivatives;
  add_measure({"own_throwing", "", false, false, "-", [](const Problem&, auto) {
                 return std::make_unique<OwnThrowing>(left, derivatives);
               }});
  for (const int threads : {1, 4}) {
    if (kSanitized && threads == 1) continue;
    SCOPED_TRACE(search + " on " + std::to_string(threads));
    Options options = of_measure("own_throwing", search, 2000);
    options.threads = threads;
    left = 50;
    try {
      solve(load_problem("uvms/lift"), options);
      ADD_FAILURE() << "nothing was thrown, " << left << " left";
    } catch (const OwnFault& fault) {
      EXPECT_EQ(fault.at, 50);
    }
    // Nothing of it remains.
    left = -1;
    options.budget = 100;
    EXPECT_TRUE(solve(load_problem("uvms/lift"), options).has_value());
  }
}

class OwnFaultsInSearches : public testing::TestWithParam<std::string> {};

std::vector<std::string> faulty_searches() {
  std::vector<std::string> names = {"sample+cmaes", "restart:crs2+cmaes", "restart:slsqp"};
  for (const SearchEntry& entry : searches()) names.emplace_back(entry.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, OwnFaultsInSearches, testing::ValuesIn(faulty_searches()),
                         [](const testing::TestParamInfo<std::string>& entry) {
                           std::string title = entry.param;
                           std::replace_if(
                               title.begin(), title.end(),
                               [](char c) { return c == '+' || c == ':'; }, '_');
                           return title;
                         });

TEST_P(OwnFaultsInSearches, OfAMeasureReachTheCaller) { expect_fault(GetParam(), false); }

class OwnFaultsOfDerivatives : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(All, OwnFaultsOfDerivatives,
                         testing::Values("multistart", "slsqp", "mma", "lbfgs", "mlsl",
                                         "nullspace"));

TEST_P(OwnFaultsOfDerivatives, ReachTheCaller) { expect_fault(GetParam(), true); }

TEST(OwnFaults, OfASearchReachTheCaller) {
  add_search({"own_fault", "", false,
              [] {
                return std::make_unique<OwnResult>(
                    [](const SearchOptions&) -> SearchResult { throw OwnFault{1}; });
              },
              true});
  for (const char* name : {"own_fault", "sample+own_fault", "restart:own_fault"}) {
    for (const int threads : {1, 4}) {
      Options options = of_measure("ellipsoid", name, 2000);
      options.threads = threads;
      EXPECT_THROW(solve(load_problem("planar/force"), options), OwnFault) << name;
    }
  }
}

TEST(OwnFaults, OfMakersAndEvaluationsReachTheCaller) {
  add_measure({"own_unmade", "", false, false, "-",
               [](const Problem&, auto) -> std::unique_ptr<Measure> { throw OwnFault{1}; }});
  const Problem problem = load_problem("planar/force");
  EXPECT_THROW(solve(problem, of_measure("own_unmade", "cmaes", 100)), OwnFault);
  EXPECT_THROW(evaluate(problem, problem.theta_r_default, of_measure("own_unmade")), OwnFault);
}

}  // namespace
}  // namespace maxwrench
