#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "benchmarks/tables/csv.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST(MapCommand, WritesCellsAndAFigure) {
  const TemporaryFolder folder;
  const std::string out = folder.path() / "m", figure = folder.path() / "m.svg";
  const std::string words = "map planar/force --over yaw=-0.5:0.5:3 azimuth=0:3:5 --budget 200 ";
  const CommandResult result =
      run_maxwrench(words + "--check 0.5 --out " + out + " --figure " + figure);
  EXPECT_EQ(result.exit_status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("cells     15, 15 with a value"));
  EXPECT_THAT(read_text(figure), HasSubstr("azimuth [rad]"));
  const CsvFile rows = read_csv(folder.path() / "m" / "map.csv.gz", {"i_yaw", "azimuth", "beta"});
  ASSERT_EQ(rows.rows.size(), 15u);
  const json object = json::parse(run_maxwrench(words + "--json").out);
  EXPECT_EQ(object["cells"], 15);
  EXPECT_EQ(object["unit"], "N");
  double most = 0;
  for (std::size_t i = 0; i < 15; ++i) most = std::max(most, *rows.number(i, "beta"));
  EXPECT_EQ(object["largest"]["beta"], most);
}

TEST(MapCommand, PartsMergeToTheWhole) {
  const TemporaryFolder folder;
  const std::string words =
      "map planar/force --over yaw=-0.5:0.5:6 azimuth=0:3:6 --budget 200 --out ";
  EXPECT_EQ(run_maxwrench(words + "whole", folder.path()).exit_status, 0);
  EXPECT_EQ(run_maxwrench(words + "p1 --shard 1/2", folder.path()).exit_status, 0);
  EXPECT_EQ(run_maxwrench(words + "p2 --shard 2/2 --threads 1", folder.path()).exit_status, 0);
  const CommandResult merged = run_maxwrench("merge all p1 p2", folder.path());
  EXPECT_EQ(merged.exit_status, 0) << merged.err;
  EXPECT_THAT(merged.out, HasSubstr("36 cells"));
  EXPECT_EQ(csv_text(folder.path() / "all" / "map.csv.gz"),
            csv_text(folder.path() / "whole" / "map.csv.gz"));
}

/// Somebody changed a value of the table: the posture of the row does not have it.
TEST(MapCommand, NoticesAnotherValue) {
  const TemporaryFolder folder;
  const std::string words = "map planar/force --over azimuth=0:3:5 --budget 200 --out m";
  EXPECT_EQ(run_maxwrench(words, folder.path()).exit_status, 0);
  const std::filesystem::path packed = folder.path() / "m" / "map.csv.gz";
  const std::string table = csv_text(packed);
  const CsvFile rows = read_csv(packed, {"beta", "azimuth"});
  const auto resume_with = [&](const std::string& column, const std::string& value) {
    std::string changed = table;
    const std::string& before = rows.text(2, column);
    changed.replace(changed.rfind(before), before.size(), value);
    std::filesystem::remove(packed);
    std::ofstream(folder.path() / "m" / "map.csv") << changed;
    return run_maxwrench(words, folder.path());
  };
  const CommandResult beta = resume_with("beta", "99.5");
  EXPECT_EQ(beta.exit_status, 2);
  EXPECT_THAT(beta.err, HasSubstr("map.csv.gz: cell 2: got beta 99.5, expected"));
  EXPECT_EQ(std::count(beta.err.begin(), beta.err.end(), '\n'), 1) << beta.err;
}

/// The folder of a map over values of the robot: verified, and damaged.
TEST(MapCommand, ValuesOfTheRobotAreChecked) {
  const TemporaryFolder folder;
  const std::string words =
      "map uvms/lift --over environment.gravity=8:10:2 links.link_4.mass=0:1:2 --budget 50 --out m";
  EXPECT_EQ(run_maxwrench(words, folder.path()).exit_status, 0);
  EXPECT_EQ(run_maxwrench("verify m", folder.path()).exit_status, 0);
  const CsvFile rows =
      read_csv(folder.path() / "m" / "map.csv.gz", {"environment.gravity", "links.link_4.mass"});
  ASSERT_EQ(rows.rows.size(), 4u);
  EXPECT_EQ(*rows.number(1, "links.link_4.mass"), 1);
}

TEST(MapCommand, SaysWhatChangesNothing) {
  const CommandResult result = run_maxwrench("map uvms/lift --over x=-1:1:2 --budget 20");
  EXPECT_THAT(result.out, HasSubstr("x changes nothing"));
}

struct BadMap {
  const char *words, *line;
};
void PrintTo(const BadMap& bad, std::ostream* out) { *out << bad.words; }

class BadMapCommand : public testing::TestWithParam<BadMap> {};

TEST_P(BadMapCommand, IsOneLine) {
  const CommandResult result = run_maxwrench(std::string("map ") + GetParam().words);
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr(GetParam().line));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

INSTANTIATE_TEST_SUITE_P(
    All, BadMapCommand,
    testing::Values(
        BadMap{"uvms/lift --over x=0:1:1000000 z=0:1:1000000", "--over: got a grid of 1e+12 cells"},
        BadMap{"uvms/lift --over x=0:1:1000000000000", "--over: got a grid of 1e+12 cells"},
        BadMap{"uvms/lift --over x=0:1:99999999999999999999", "--over: got 'x=0:1:9999"},
        BadMap{"uvms/lift --over x=1:0:4", "--over: got 'x=1:0:4', expected low < high"},
        BadMap{"uvms/lift --over tilt=0:1:4", "one of the coordinates"},
        BadMap{"uvms/lift --over environment.water_density=-1:9:2",
               "--over: got 'environment.water_density=-1:9:2', expected densities of at least 0"},
        BadMap{"uvms/lift --over environment.density=0:9:2", "environment.water_density"},
        BadMap{"uvms/lift --over joints.q3_elbow.effort=1:9:2", "or the name of an actuator"},
        BadMap{"uvms/lift --over environment.current.x=0:0.3:2 --measure ellipsoid", "--measure"},
        BadMap{"uvms/lift --over x=nan:1:4", "finite limits"},
        BadMap{"uvms/lift --over x=0:1", "expected NAME=LOW:HIGH:COUNT"},
        BadMap{"uvms/lift --over x=0:1:2:3", "expected NAME=LOW:HIGH:COUNT"},
        BadMap{"uvms/lift --over x=0:1:2.5", "expected NAME=LOW:HIGH:COUNT"},
        BadMap{"uvms/lift", "--over"}, BadMap{"uvms/nothing --over x=0:1:2", "uvms/nothing"},
        BadMap{"uvms/valve_trajectory --over x=0:1:2", "expected a static task"},
        BadMap{"uvms/lift --over x=0:1:2 --refine 1000000000000",
               "--refine: got '1000000000000', expected a whole number from 0 to 10"},
        BadMap{"uvms/lift --over x=0:1:2 --refine 2.5", "--refine: got '2.5', expected a whole"},
        BadMap{"uvms/lift --over x=0:1:2 --tolerance wide",
               "--tolerance: got 'wide', expected a number"},
        BadMap{"uvms/lift --over x=0:1:2 --check -1", "--check: got -1"},
        BadMap{"uvms/lift --over x=0:1:2 --check-budget 0", "--check-budget"},
        BadMap{"uvms/lift --over x=0:1:2 --certify --time nan", "--time: got nan"},
        BadMap{"uvms/lift --over x=0:1:2 --certify --measure manipulability",
               "--measure: got 'manipulability'"},
        BadMap{"uvms/lift --over x=0:1:2 --shard 3/2", "--shard: got '3/2'"},
        BadMap{"uvms/lift --over x=0:1:2 --search swim", "--search: got 'swim'"}));

}  // namespace
}  // namespace maxwrench
