#include <gtest/gtest.h>

#include "tests/support/bad_input.h"

namespace maxwrench {
namespace {

constexpr const char* kDirection = "c = [0, 0, 0, 0, 0, 1]";
constexpr const char* kSetTask = "valve.toml";

/// uvms/valve with wrenches that are none.
const std::vector<ChangedProblem> kBadWrenchSets = {
    {"set_beside_c",
     kSetTask,
     kDirection,
     "c = [0,0,0,0,0,1]\nset = [[0,0,0,0,0,1]]",
     {"wrench.c: got [0, 0, 0, 0, 0, 1]", "no such key beside wrench.set"}},
    {"set_empty", kSetTask, kDirection, "set = []", {"wrench.set: got []", "lists of 6 finite numbers"}},
    {"set_of_numbers",
     kSetTask,
     kDirection,
     "set = [1, 2, 3, 4, 5, 6]",
     {"wrench.set: got 1", "lists of 6 finite numbers"}},
    {"set_of_five",
     kSetTask,
     kDirection,
     "set = [[0,0,0,0,0,1], [1,0,0,0,0]]",
     {"wrench.set: got [1, 0, 0, 0, 0]", "lists of 6 finite numbers"}},
    {"set_nan",
     kSetTask,
     kDirection,
     "set = [[0,0,nan,0,0,1]]",
     {"wrench.set: got [0, 0, nan", "lists of 6 finite numbers"}},
    {"set_zero",
     kSetTask,
     kDirection,
     "set = [[0,0,0,0,0,1], [0,0,0,0,0,0]]",
     {"wrench.set[1]: got [0, 0, 0, 0, 0, 0]", "a wrench of nonzero length"}},
    {"set_too_large",
     kSetTask,
     kDirection,
     "set = [[1e10,0,0,0,0,0]]",
     {"wrench.set[0]: got [1", "at most 1e+09 N or N m"}},
    {"set_outside_any",
     kSetTask,
     kDirection,
     "set = [[0,0,0,0,0,1], [1,0,0,0,0,0]]\nany = [\"fy\", \"tz\"]",
     {"wrench.set[1]: got [1, 0, 0, 0, 0, 0]", "a direction within any = fy, tz"}},
    {"nothing", kSetTask, kDirection, "reference = 1", {"wrench.c: got nothing", "6 finite numbers"}},
    {"hold_alone", kSetTask, kDirection, "hold = true", {"wrench.c: got nothing"}},
    {"hold_no_truth",
     kSetTask,
     kDirection,
     "c = [0,0,0,0,0,1]\nhold = 1",
     {"wrench.hold: got 1", "true or false"}},
    {"ball_unknown_key",
     kSetTask,
     kDirection,
     "ball = { axis = [\"fx\"], radius = 1 }",
     {"wrench.ball.axis: got an unknown key"}},
    {"ball_without_axes",
     kSetTask,
     kDirection,
     "ball = { axes = [], radius = 1 }",
     {"wrench.ball.axes: got []", "one or more"}},
    {"ball_of_no_table", kSetTask, kDirection, "ball = 1", {"wrench.ball: got 1", "a table"}},
    {"ball_axes_unknown",
     kSetTask,
     kDirection,
     "ball = { axes = [\"fx\", \"mz\"], radius = 1 }",
     {"wrench.ball.axes: got ['fx', 'mz']", "some of fx, fy"}},
    {"ball_axes_twice",
     kSetTask,
     kDirection,
     "ball = { axes = [\"fx\", \"fx\"], radius = 1 }",
     {"wrench.ball.axes: got ['fx', 'fx']", "each once"}},
    {"ball_of_both_units",
     kSetTask,
     kDirection,
     "ball = { axes = [\"fx\", \"tz\"], radius = 1 }",
     {"wrench.ball.axes: got ['fx', 'tz']", "forces or torques, not both"}},
    {"ball_without_radius",
     kSetTask,
     kDirection,
     "ball = { axes = [\"fx\"] }",
     {"wrench.ball.radius: got nothing"}},
    {"ball_radius_zero",
     kSetTask,
     kDirection,
     "ball = { axes = [\"fx\"], radius = 0 }",
     {"wrench.ball.radius: got 0", "a number > 0"}},
    {"ball_beside_c_of_zero",
     kSetTask,
     kDirection,
     "c = [0,0,0,0,0,0]\nball = { axes = [\"fx\"], radius = 1 }",
     {"wrench.c: got [0, 0, 0, 0, 0, 0]", "a direction of nonzero length"}},
    {"ball_outside_any",
     kSetTask,
     kDirection,
     "any = [\"fy\"]\nball = { axes = [\"fy\", \"fz\"], radius = 1 }",
     {"wrench.ball.axes: got ['fy', 'fz']", "within any = fy"}},
    {"table_of_wrenches", kSetTask, kDirection, "file = \"cutting.csv\"", {"wrench.file: got an unknown key"}},
};

class BadWrenchSets : public testing::TestWithParam<ChangedProblem> {};

INSTANTIATE_TEST_SUITE_P(All, BadWrenchSets, testing::ValuesIn(kBadWrenchSets),
                         [](const auto& each) { return std::string(each.param.name); });

TEST_P(BadWrenchSets, IsRejected) { expect_rejected(GetParam(), "uvms/valve"); }

}  // namespace
}  // namespace maxwrench
