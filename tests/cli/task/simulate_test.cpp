#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

using nlohmann::json;

constexpr const char* kShort = "simulate uvms/valve --planned 4 --ramp 0.5 --hold 0.5 ";

json simulated(const std::string& words) {
  const CommandResult result = run_maxwrench(words + " --json");
  EXPECT_EQ(result.exit_status, 0) << result.err;
  return json::parse(result.out);
}

TEST(SimulateCommand, SLOW_SaysWhetherTheTrajectoryIsHeld) {
  const json held = simulated(kShort);
  EXPECT_EQ(held["status"], "reached");
  EXPECT_EQ(held["planned"], 4);
  EXPECT_EQ(held["held"], true);
  EXPECT_EQ(held["end"], 1.5);
  ASSERT_EQ(held["across"].size(), 6U);
  EXPECT_EQ(held["across"][5], 0);  // c itself
  for (const double value : held["across"]) EXPECT_LT(std::abs(value), 0.02 * 4);
  const json lost = simulated("simulate uvms/valve --planned 10 --ramp 2 --hold 2");
  EXPECT_EQ(lost["held"], false);
  EXPECT_EQ(lost["saturated"], 1);
  // Of the hold, which is half a second after a ramp: the reading creeps up to the trajectory.
  EXPECT_NEAR(held["mean"].get<double>(), 4, 0.02 * 4);
  const CommandResult text = run_maxwrench(kShort);
  for (const std::string& words :
       {std::string("planned     4.00000 N m"), std::string("across      "),
        fmt::format("reading     {:.5f}, ", held["mean"].get<double>()),
        std::string("held, ended at 1.5 s")}) {
    EXPECT_NE(text.out.find(words), std::string::npos) << text.out;
  }
  const std::string early = run_maxwrench("simulate uvms/valve --planned 34").out;
  EXPECT_NE(early.find("reading     none, the posture was lost"), std::string::npos) << early;
  EXPECT_EQ(early.find("nan"), std::string::npos) << early;
  // No step succeeds.
  const std::string wild = "simulate uvms/valve --thrust-noise 1e300";
  const std::string none = run_maxwrench(wild).out;
  EXPECT_NE(none.find("reading     none, the experiment ended"), std::string::npos) << none;
  EXPECT_EQ(none.find("theta_r_error"), std::string::npos) << none;
  const json object = json::parse(run_maxwrench(wild + " --json").out);
  EXPECT_TRUE(object["theta_r_error"].is_null());
  EXPECT_EQ(object["end"], 0);
}

TEST(SimulateCommand, WritesOneRowForEachPeriodAndAFigure) {
  const TemporaryFolder folder;
  const CommandResult result =
      run_maxwrench(kShort + std::string("--out a.csv --figure a.svg"), folder.path());
  ASSERT_EQ(result.exit_status, 0) << result.err;
  const std::string csv = read_text(folder.path() / "a.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 150);
  std::istringstream lines(csv);
  std::string header, row;
  std::getline(lines, header);
  EXPECT_TRUE(header.starts_with("t,planned,reading,f_x,")) << header;
  while (std::getline(lines, row)) {
    EXPECT_EQ(std::count(row.begin(), row.end(), ','),
              std::count(header.begin(), header.end(), ','));
  }
  const std::string svg = read_text(folder.path() / "a.svg");
  EXPECT_NE(svg.find("time [s]"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(SimulateCommand, SLOW_SameSeedSameRows) {
  const TemporaryFolder folder;
  const auto rows = [&](const std::string& words) {
    EXPECT_EQ(run_maxwrench(kShort + words + " --out rows.csv", folder.path()).exit_status, 0);
    return read_text(folder.path() / "rows.csv");
  };
  const std::string noisy = rows("--thrust-noise 0.5 --seed 3");
  EXPECT_EQ(rows("--thrust-noise 0.5 --seed 3"), noisy);
  EXPECT_NE(rows("--thrust-noise 0.5 --seed 4"), noisy);
  EXPECT_EQ(rows("--seed 3"), rows(""));
}

/// The whole kilograms that the polytope carries.
TEST(SimulateCommand, SLOW_FindsTheHeaviestLoad) {
  const json lift = json::parse(run_maxwrench("eval uvms/lift --json").out);
  const int most = static_cast<int>(std::floor(lift["beta"].get<double>() / 9.81));
  EXPECT_GT(most, 0);
  EXPECT_EQ(simulated("simulate uvms/lift --heaviest --ramp 2 --hold 2")["heaviest"], most);
  const json load = simulated(fmt::format("simulate uvms/lift --load {} --ramp 2 --hold 1", most));
  EXPECT_EQ(load["held"], true);
  EXPECT_NEAR(load["mean"].get<double>(), most * 9.81, 0.02 * most * 9.81);
  EXPECT_NEAR(load["planned"].get<double>(), most * 9.81, 1e-12);
}

TEST(SimulateCommand, FollowsATurn) {
  const json turn = simulated("simulate uvms/valve_trajectory");
  EXPECT_EQ(turn["status"], "reached");
  EXPECT_EQ(turn["scheme"], "spline");
  EXPECT_EQ(turn["interpolation"], "spline");
  EXPECT_EQ(turn["planned"], turn["value_between_knots"]);
  EXPECT_EQ(turn["held"], true);
  EXPECT_EQ(turn["violations"], 0);
  EXPECT_EQ(turn["end"], 5);
  EXPECT_TRUE(turn["t_h"].is_null());
  EXPECT_TRUE(turn["at_t_h"].is_null());
  const double planned = turn["planned"], low = turn["low"];
  EXPECT_GT(low, 0.97 * planned);
  EXPECT_LT(turn["deviation"].get<double>(), 0.03 * planned);
  const CommandResult text = run_maxwrench("simulate uvms/valve_trajectory");
  EXPECT_EQ(text.exit_status, 0);
  for (const std::string& words :
       {fmt::format("planned     {:.5f} N m", planned), fmt::format("least {:.5f} at ", low),
        std::string("held, ended at 5 s")}) {
    EXPECT_NE(text.out.find(words), std::string::npos) << text.out;
  }
}

TEST(SimulateCommand, FollowsAImpulseToItsPeak) {
  const json impulse = simulated("simulate uvms/valve_impulse --t-h 2");
  EXPECT_EQ(impulse["t_h"], 1.25);
  EXPECT_EQ(impulse["end"], 2.5);
  EXPECT_EQ(impulse["held"], true);
  const double planned = impulse["planned"];
  EXPECT_NEAR(impulse["at_t_h"].get<double>(), planned, 0.03 * planned);
  const json less = simulated("simulate uvms/valve_impulse --planned 20 --scheme forward");
  EXPECT_EQ(less["planned"], 20);
  EXPECT_EQ(less["interpolation"], "linear");
  EXPECT_EQ(less["held"], true);
}

/// A trajectory whose four steps are no motion has no peak on the spline through its knots.
TEST(SimulateCommand, SaysWhyATrajectoryIsNotRun) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "knots.csv")
      << "3.070,0.772,0.453,-2.983\n3.046,0.550,0.615,-3.008\n"
         "3.156,0.709,0.477,-3.048\n3.035,0.656,0.474,-2.968\n";
  const std::string words = "simulate uvms/valve_impulse --scheme backward --theta-r knots.csv ";
  const CommandResult none = run_maxwrench(
      words + "--interpolation spline --json --out a.csv --figure a.svg", folder.path());
  EXPECT_EQ(none.exit_status, 1) << none.err;
  const json object = json::parse(none.out);
  EXPECT_EQ(object["status"], "infeasible");
  EXPECT_TRUE(object["low"].is_null());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.svg"));
  const CommandResult own = run_maxwrench(words + "--json", folder.path());
  EXPECT_EQ(own.exit_status, 0) << own.err;
  EXPECT_EQ(json::parse(own.out)["held"], false);
  const CommandResult beyond = run_maxwrench("simulate uvms/valve_trajectory --theta-r 9,0,0,0");
  EXPECT_EQ(beyond.exit_status, 1);
  EXPECT_NE(beyond.out.find("not held, invalid_posture: "), std::string::npos) << beyond.out;
}

TEST(SimulateCommand, WritesTheSeriesAndTheFigureOfATurn) {
  const TemporaryFolder folder;
  const std::string words =
      "simulate uvms/valve_trajectory --planned 20 --out a.csv --figure a.svg";
  ASSERT_EQ(run_maxwrench(words, folder.path()).exit_status, 0);
  const std::string csv = read_text(folder.path() / "a.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 500);
  std::istringstream lines(csv);
  std::string header, row;
  std::getline(lines, header);
  EXPECT_TRUE(header.ends_with(",theta_r_q3_elbow,theta_r_q4_wrist_roll,angle")) << header;
  while (std::getline(lines, row)) {
    EXPECT_EQ(std::count(row.begin(), row.end(), ','),
              std::count(header.begin(), header.end(), ','));
  }
  const std::string svg = read_text(folder.path() / "a.svg");
  for (const char* name :
       {"along c [N m]", "thrusters [N]", "theta_r [rad]", "turned [rad]", "</svg>"}) {
    EXPECT_NE(svg.find(name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace maxwrench
