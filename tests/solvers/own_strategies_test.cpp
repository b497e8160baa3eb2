#include "tests/support/own_strategies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "solvers/solve/method.h"
#include "tests/support/refusals.h"

namespace maxwrench {
namespace {

TEST(OwnStrategies, RejectNames) {
  const auto measure = [](const char* name) {
    expect_rejected("measure", [&] { add_measure(ease_entry(name)); });
  };
  const auto search = [](const char* name) {
    expect_rejected("search", [&] { add_search(random_entry(name)); });
  };
  for (const char* name : {"", "a b", "a+b", "restart:a", "a-b", "\xc3\xa4", "a\n", "a'b"}) {
    measure(name);
    search(name);
  }
  measure(nullptr);
  search(nullptr);
  for (const MeasureEntry& entry : measures()) measure(entry.name);
  for (const auto& table : {searches(), trajectory_searches(), facet_searches()}) {
    for (const SearchEntry& entry : table) search(entry.name);
  }
  expect_rejected("measure", [] { add_measure({"own_empty", "", false, false, "", nullptr}); });
  expect_rejected("search", [] { add_search({"own_empty", "", false, nullptr}); });
  SearchEntry entry = random_entry("own_fraction");
  for (const double bad : {-0.1, 1.1, std::nan("")}) {
    entry.budget_fraction = bad;
    expect_rejected("budget_fraction", [&] { add_search(entry); });
  }
  entry.budget_fraction = 0;
  entry.cost = 0;
  expect_rejected("cost", [&] { add_search(entry); });
  for (const char* name : {"own_empty", "own_fraction"}) {
    expect_rejected("search", [&] { find_search(name); });
  }
}

TEST(OwnStrategies, AreNotInTheTablesButInMessages) {
  add_measure(ease_entry("own_listed"));
  add_search(random_entry("own_listed"));
  add_search(random_entry("own_listed"));
  for (const MeasureEntry& entry : measures()) EXPECT_STRNE(entry.name, "own_listed");
  for (const SearchEntry& entry : searches()) EXPECT_STRNE(entry.name, "own_listed");
  EXPECT_FALSE(one_at_a_time("own_listed"));
  const auto message = [](const auto& find) -> std::string {
    try {
      find("no_such_name");
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  for (const std::string& text : {message(find_measure), message(find_search)}) {
    const std::size_t first = text.find("own_listed");
    ASSERT_NE(first, std::string::npos) << text;
    EXPECT_EQ(text.find("own_listed", first + 1), std::string::npos) << text;
  }
}

/// A notebook runs its cells again. What holds the earlier entry keeps it.
TEST(OwnStrategies, AreReplaced) {
  const Problem problem = load_problem("planar/force");
  const auto value = [&] {
    return evaluate(problem, problem.theta_r_default, of_measure("own_again")).beta();
  };
  {
    std::string name = "own_again", unit = "first";
    MeasureEntry entry = ease_entry(name.c_str(), 1);
    entry.unit = unit.c_str();
    add_measure(entry);
    name = unit = "xxxxxxxxx";  // the texts were copied
  }
  const double one = value();
  const MeasureEntry& before = find_measure("own_again");
  const Method method = resolve(problem, of_measure("own_again"));
  add_measure(ease_entry("own_again", 2));
  EXPECT_NEAR(value(), 2 * one, 1e-9 * std::abs(one));
  EXPECT_STREQ(before.name, "own_again");
  EXPECT_STREQ(before.unit, "first");
  const auto objective = make_objective(problem, method);
  EXPECT_EQ(objective->evaluate(problem.theta_r_default), one);
}

TEST(OwnStrategies, RejectMakersOfNothing) {
  add_measure({"own_null", "", false, false, "-",
               [](const Problem&, auto) { return std::unique_ptr<Measure>(); }});
  add_search({"own_null", "", false, [] { return std::unique_ptr<Search>(); }, true});
  const Problem problem = load_problem("planar/force");
  expect_rejected("measure", [&] { solve(problem, of_measure("own_null", "cmaes", 100)); });
  for (const char* name : {"own_null", "sample+own_null", "restart:own_null"}) {
    expect_rejected("search", [&] { solve(problem, of_measure("ellipsoid", name, 1000)); });
  }
}

}  // namespace
}  // namespace maxwrench
