#include "lib/scenario/scenario_list.h"

#include <gtest/gtest.h>

#include "tests/support/list_tasks.h"
#include "tests/support/scenario_task.h"

namespace maxwrench {
namespace {

std::string name_of_last(const std::string& tables) {
  const Problem task = scenario_task(kTurn, tables);
  return describe(task.scenarios, all_scenarios(task.scenarios).back());
}

TEST(ScenarioList, TellsScenariosApart) {
  EXPECT_EQ(name_of_last("[uncertainty]\nthrust = 0.1\n"), "weaker actuators");
  EXPECT_EQ(name_of_last("[loss]\ncases = [[\"front_left_vertical\"]]\n"),
            "front_left_vertical dead");
}

}  // namespace
}  // namespace maxwrench
