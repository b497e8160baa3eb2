#include <gtest/gtest.h>

#include "tests/support/bad_input.h"

namespace maxwrench {
namespace {

constexpr const char* kC = "c = [0, 0, 0, 0, 0, 1]";
constexpr const char* kTables = "[theta_r]";
constexpr const char* kTask = "valve.toml";

/// uvms/valve with intervals that are none, and with more cases than a list may have.
const std::vector<ChangedProblem> kBadScenarios = {
    {"uncertainty_empty",
     kTask,
     kTables,
     "[uncertainty]\n\n[theta_r]",
     {"uncertainty: got an empty table", "one or more keys"}},
    {"uncertainty_unknown_key",
     kTask,
     kTables,
     "[uncertainty]\nmasses = 1\n\n[theta_r]",
     {"uncertainty.masses: got an unknown key"}},
    {"uncertainty_no_table",
     kTask,
     "type = \"static\"",
     "type = \"static\"\nuncertainty = 5",
     {"uncertainty: got 5", "a table"}},
    {"mass_empty",
     kTask,
     kTables,
     "[uncertainty]\nmass = {}\n\n[theta_r]",
     {"uncertainty.mass: got an empty table"}},
    {"mass_of_no_body",
     kTask,
     kTables,
     "[uncertainty]\nmass.arm = 1\n\n[theta_r]",
     {"uncertainty.mass.arm: got an unknown key",
      "one of vehicle, base, link_1, link_2, link_3, link_4"}},
    {"mass_negative",
     kTask,
     kTables,
     "[uncertainty]\nmass.base = -0.1\n\n[theta_r]",
     {"uncertainty.mass.base: got -0.1", "a number >= 0"}},
    {"mass_beyond_itself",
     kTask,
     kTables,
     "[uncertainty]\nmass.link_4 = 0.5\n\n[theta_r]",
     {"uncertainty.mass.link_4: got 0.5", "at most the mass itself, 0.36 kg"}},
    {"mass_of_120_percent",
     kTask,
     kTables,
     "[uncertainty]\nmass.link_4 = \"120%\"\n\n[theta_r]",
     {"uncertainty.mass.link_4: got 0.432", "at most the mass itself"}},
    {"mass_of_no_number",
     kTask,
     kTables,
     "[uncertainty]\nmass.link_4 = \"5 %\"\n\n[theta_r]",
     {"uncertainty.mass.link_4: got '5 %'", "a share such as '5%'"}},
    {"mass_of_a_bare_percent",
     kTask,
     kTables,
     "[uncertainty]\nmass.link_4 = \"%\"\n\n[theta_r]",
     {"uncertainty.mass.link_4: got '%'", "a share such as '5%'"}},
    {"mass_of_negative_percent",
     kTask,
     kTables,
     "[uncertainty]\nmass.link_4 = \"-5%\"\n\n[theta_r]",
     {"uncertainty.mass.link_4: got '-5%'", "a share such as '5%'"}},
    {"mass_true",
     kTask,
     kTables,
     "[uncertainty]\nmass.link_4 = true\n\n[theta_r]",
     {"uncertainty.mass.link_4: got true", "a finite number"}},
    {"com_of_no_body",
     kTask,
     kTables,
     "[uncertainty]\ncom.arm = [0, 0, 0]\n\n[theta_r]",
     {"uncertainty.com.arm: got an unknown key", "one of vehicle"}},
    {"com_of_two",
     kTask,
     kTables,
     "[uncertainty]\ncom.base = [0, 0]\n\n[theta_r]",
     {"uncertainty.com.base: got [0, 0]", "3 finite numbers"}},
    {"com_negative",
     kTask,
     kTables,
     "[uncertainty]\ncom.base = [0, 0, -0.1]\n\n[theta_r]",
     {"uncertainty.com.base: got [0, 0, -0.1]", "3 numbers >= 0"}},
    {"volume_beyond_itself",
     kTask,
     kTables,
     "[uncertainty]\nvolume.base = 0.001\n\n[theta_r]",
     {"uncertainty.volume.base: got 0.001", "at most the volume itself, 0.00016 m^3"}},
    {"cob_of_no_body",
     kTask,
     kTables,
     "[uncertainty]\ncob.arm = [0, 0, 0]\n\n[theta_r]",
     {"uncertainty.cob.arm: got an unknown key"}},
    {"trim_negative",
     kTask,
     kTables,
     "[uncertainty]\ntrim = -1\n\n[theta_r]",
     {"uncertainty.trim: got -1", "a number >= 0"}},
    {"payload_without_mass",
     kTask,
     kTables,
     "[uncertainty]\npayload.com = [0,0,0]\n\n[theta_r]",
     {"uncertainty.payload.mass: got nothing"}},
    {"payload_negative",
     kTask,
     kTables,
     "[uncertainty]\npayload.mass = -1\n\n[theta_r]",
     {"uncertainty.payload.mass: got -1", "a number >= 0"}},
    {"thrust_one",
     kTask,
     kTables,
     "[uncertainty]\nthrust = 1\n\n[theta_r]",
     {"uncertainty.thrust: got 1", "a share from 0 to 1, below 1"}},
    {"torque_negative",
     kTask,
     kTables,
     "[uncertainty]\ntorque = -0.1\n\n[theta_r]",
     {"uncertainty.torque: got -0.1", "a share from 0 to 1, below 1"}},
    {"current_empty",
     kTask,
     kTables,
     "[uncertainty]\ncurrent = {}\n\n[theta_r]",
     {"uncertainty.current.speed: got nothing"}},
    {"current_negative",
     kTask,
     kTables,
     "[uncertainty]\ncurrent.speed = -1\n\n[theta_r]",
     {"uncertainty.current.speed: got -1", "a number >= 0"}},
    {"current_from_nowhere",
     kTask,
     kTables,
     "[uncertainty]\ncurrent = { speed = 1, directions = 0 }\n\n[theta_r]",
     {"uncertainty.current.directions: got 0", "a whole number from 1 to 99999"}},
    {"current_of_both_kinds",
     kTask,
     kTables,
     "[uncertainty]\ncurrent = { speed = 1, vectors = [[1,0,0]] }\n\n[theta_r]",
     {"uncertainty.current.speed: got 1", "no such key beside vectors"}},
    {"current_vectors_empty",
     kTask,
     kTables,
     "[uncertainty]\ncurrent = { vectors = [] }\n\n[theta_r]",
     {"uncertainty.current.vectors: got []", "lists of 3 finite numbers"}},

    {"too_many_scenarios",
     kTask,
     kTables,
     "[loss]\nany = 4\n[uncertainty]\ntrim = 1\ncurrent.speed = 1\n"
     "com.vehicle = [1,1,1]\n\n[theta_r]",
     {"uncertainty: got 190", "scenarios, expected at most 100000"}},
    {"far_too_many_corners",
     kTask,
     kTables,
     "[uncertainty]\ncurrent = { speed = 1, directions = 99999 }\ntrim = 1\n\n[theta_r]",
     {"uncertainty: got 200000 scenarios", "at most 100000"}},
};

class BadScenarios : public testing::TestWithParam<ChangedProblem> {};

INSTANTIATE_TEST_SUITE_P(All, BadScenarios, testing::ValuesIn(kBadScenarios),
                         [](const auto& each) { return std::string(each.param.name); });

TEST_P(BadScenarios, IsRejected) { expect_rejected(GetParam(), "uvms/valve"); }

/// What lists in time do not have.
TEST(BadScenariosInTime, AreRejected) {
  for (const char* task : {"uvms/valve_trajectory", "uvms/valve_impulse"}) {
    const std::string file = std::string(task).substr(5) + ".toml";
    const auto expect = [&](const std::string& from, const std::string& to,
                            const std::string& message, const std::string& expected) {
      expect_rejected({"in_time", file.c_str(), from.c_str(), to.c_str(), {message, expected}},
                      task);
    };
    for (const auto& [key, value] :
         {std::pair("mass", "{ vehicle = 0.1 }"), std::pair("com", "{ vehicle = [0.1, 0, 0] }"),
          std::pair("volume", "{ vehicle = 1e-5 }"), std::pair("cob", "{ vehicle = [0.1, 0, 0] }"),
          std::pair("trim", "0.1"), std::pair("payload", "{ mass = 1, com = [0, 0, 0] }"),
          std::pair("current", "{ speed = 0.1 }")}) {
      expect("[motion]", std::string("[uncertainty]\n") + key + " = " + value + "\n\n[motion]",
             std::string("uncertainty.") + key + ": got a value",
             "no such key except in static tasks");
    }
    expect("[motion]", "[loss]\nany = 0\n\n[motion]", "loss.any: got 0", "a whole number from 1");
    expect("[motion]", "[loss]\ncases = [[\"q3_elbow\"]]\njoints = \"locked\"\n\n[motion]",
           "loss.joints: got 'locked'", "'limp' in tasks in time");
    expect("[motion]", "[loss]\ncases = [[\"q3_elbow\"]]\nfriction = 0.5\n\n[motion]",
           "loss.friction: got 0.5", "0 in tasks in time");
    expect(kC, "ball = { axes = [\"fx\"], radius = 1 }", "wrench.ball: got a table",
           "no such key except in static tasks");
    expect(kC, "set = [[0,0,0,0,0,0]]", "wrench.set[0]", "a wrench of nonzero length");
  }
  // Twenty wrenches with each of the 255 sets of up to seven thrusters dead.
  std::string many = "set = [[0,0,0,0,0,1]";
  for (int i = 2; i <= 20; ++i) many += ", [0,0,0,0,0," + std::to_string(i) + "]";
  many += "]\n\n[loss]\nany = 7";
  expect_rejected({"long",
                   "valve_trajectory.toml",
                   kC,
                   many.c_str(),
                   {"motion.k: got 10 knots of 5100 scenarios",
                    "at most 5000 knots of all scenarios together"}},
                  "uvms/valve_trajectory");
}

/// fixed/push: an arm in air. What cannot matter to it is no silent default.
TEST(BadScenarios, KeysThatCannotMatterAreRejected) {
  const auto expect = [](const char* table, const char* key, const char* expected) {
    const std::string tables = std::string(table) + "\n\n[theta_r]";
    expect_rejected({"arm", "push.toml", "[theta_r]", tables.c_str(), {key, expected}},
                    "fixed/push");
  };
  expect("[uncertainty]\nthrust = 0.1", "uncertainty.thrust: got 0.1", "no thrusters");
  expect("[uncertainty]\ntrim = 0.1", "uncertainty.trim: got 0.1", "the base is fixed");
  expect("[loss]\nany = 1", "loss.actuators: got ['thrusters'], expected 'joints' or some of",
         "each once");
}

}  // namespace
}  // namespace maxwrench
