#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

using nlohmann::json;

/// The list of planar/force.
TEST(WithinCommand, ListsClusters) {
  const CommandResult result = run_maxwrench("certify planar/force --within 1% --json");
  EXPECT_EQ(result.exit_status, 0) << result.err;
  const json proof = json::parse(result.out);
  EXPECT_EQ(proof["status"], "proven");
  const double beta = proof["beta"], gap = proof["gap"];
  EXPECT_LE(gap, 0.001001);
  const json& within = proof["within"];
  EXPECT_EQ(within["status"], "proven");
  EXPECT_EQ(within["share"], 0.01);
  EXPECT_EQ(within["resolution"], 0.05);
  EXPECT_LE(within["widest"], 0.0500001);
  EXPECT_NEAR(within["least"], 0.99 * beta, 1e-9);
  long boxes = 0;
  double last = beta;
  for (const json& cluster : within["clusters"]) {
    boxes += cluster["boxes"].get<long>();
    EXPECT_LE(cluster["beta"], last);
    last = cluster["beta"];
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_LE(cluster["lower"][i], cluster["theta_r"][i]);
      EXPECT_GE(cluster["upper"][i], cluster["theta_r"][i]);
    }
    EXPECT_GT(cluster["volume"], 0);
    EXPECT_LT(cluster["volume"], 1);
  }
  EXPECT_EQ(within["boxes"], boxes);
  EXPECT_EQ(within["clusters"][0]["status"], "holds");
  EXPECT_EQ(within["clusters"][0]["beta"], beta);
}

/// With dependent joints, boxes and clusters have these too, in the order of `coordinates`.
TEST(WithinCommand, ListsDependentJoints) {
  const TemporaryFolder folder;
  const CommandResult result = run_maxwrench(
      "certify gallery/panda/push --within 5% --resolution 0.2 --json --boxes boxes.csv --figure "
      "boxes.svg",
      folder.path());
  EXPECT_EQ(result.exit_status, 0) << result.err;
  const json proof = json::parse(result.out);
  const json& within = proof["within"];
  EXPECT_EQ(within["status"], "proven");
  ASSERT_EQ(within["coordinates"].size(), 7U);
  EXPECT_EQ(within["coordinates"][0], "panda_joint3");
  EXPECT_EQ(within["coordinates"][1], "panda_joint1");
  for (const json& cluster : within["clusters"]) {
    ASSERT_EQ(cluster["lower"].size(), 7U);
    if (cluster["x"].is_null()) continue;
    EXPECT_EQ(cluster["x"][0], cluster["theta_r"][0]);
    for (std::size_t i = 0; i < 7; ++i) {
      EXPECT_LE(cluster["lower"][i], cluster["x"][i].get<double>() + 1e-7);
      EXPECT_GE(cluster["upper"][i], cluster["x"][i].get<double>() - 1e-7);
    }
  }
  EXPECT_EQ(within["clusters"][0]["beta"], proof["beta"]);
  const std::string rows = read_text(folder.path() / "boxes.csv");
  EXPECT_EQ(rows.rfind("lower_1,lower_2,lower_3,lower_4,lower_5,lower_6,lower_7,upper_1,", 0), 0U);
  EXPECT_NE(read_text(folder.path() / "boxes.svg").find("joint7"), std::string::npos);
}

TEST(WithinCommand, RejectsSecondContacts) {
  for (const char* words : {"certify planar/two_arms", "view planar/two_arms", "view fixed/push"}) {
    const CommandResult result = run_maxwrench(std::string(words) + " --within 1%");
    EXPECT_EQ(result.exit_status, 2) << words;
    EXPECT_NE(result.err.find("--within: got "), std::string::npos) << result.err;
  }
}

/// The gap is a tenth of the share at most, however it is written.
TEST(WithinCommand, ReadsShares) {
  for (const char* share : {"0.1%", "'0.1 %'", "0.001", "1e-3"}) {
    const CommandResult result =
        run_maxwrench("certify planar/force --json --within " + std::string(share));
    EXPECT_EQ(result.exit_status, 0) << result.err;
    const json proof = json::parse(result.out);
    EXPECT_DOUBLE_EQ(proof["within"]["share"], 0.001);
    EXPECT_DOUBLE_EQ(proof["asked"], 1e-4);
  }
  const json proof = json::parse(run_maxwrench("certify planar/force --json").out);
  EXPECT_TRUE(proof["within"].is_null());
}

TEST(WithinCommand, SaysWhatIsProven) {
  const CommandResult result = run_maxwrench("certify planar/force --within 1%");
  EXPECT_EQ(result.exit_status, 0) << result.err;
  for (const char* text : {"\nproven\n", "\nwithin    1 %: proven\n",
                           ": no posture outside is within 1 % of the best\n", "\nclusters  1 hold",
                           "\n1   holds       3.47748", " shoulder ", " rad\n"}) {
    EXPECT_NE(result.out.find(text), std::string::npos) << text << " in\n" << result.out;
  }
}

TEST(WithinCommand, WritesBoxesAndFigure) {
  const TemporaryFolder folder;
  const CommandResult result =
      run_maxwrench("certify planar/force --within 1% --boxes boxes.csv --figure boxes.svg --json",
                    folder.path());
  EXPECT_EQ(result.exit_status, 0) << result.err;
  const json within = json::parse(result.out)["within"];
  std::istringstream rows(read_text(folder.path() / "boxes.csv"));
  std::string row;
  std::getline(rows, row);
  EXPECT_EQ(row, "lower_1,lower_2,upper_1,upper_2,cluster,high");
  int count = 0;
  while (std::getline(rows, row)) {
    ++count;
    std::replace(row.begin(), row.end(), ',', ' ');
    std::istringstream numbers(row);
    double lower[2], upper[2], cluster = 0, high = 0;
    numbers >> lower[0] >> lower[1] >> upper[0] >> upper[1] >> cluster >> high;
    EXPECT_LT(lower[0], upper[0]);
    EXPECT_LT(lower[1], upper[1]);
    EXPECT_GE(cluster, 1);
    EXPECT_GE(high, within["least"].get<double>());
  }
  EXPECT_EQ(count, within["boxes"].get<int>());
  const std::string svg = read_text(folder.path() / "boxes.svg");
  for (const char* text : {"planar/force: within 1 %", "shoulder", "elbow", "1: 3.4775 N"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
}

/// Larger boxes are listed all the same, and the status is that of an answer in part.
TEST(WithinCommand, EndsEarly) {
  for (const char* words :
       {"certify uvms/valve --time 0",
        "--version > /dev/null; timeout --foreground --preserve-status -s INT 3 '" MAXWRENCH_COMMAND
        "' certify uvms/valve --resolution 0.001"}) {
    const CommandResult result = run_maxwrench(std::string(words) + " --within 1% --json");
    EXPECT_EQ(result.exit_status, 1) << result.err;
    const json within = json::parse(result.out)["within"];
    EXPECT_EQ(within["status"], "bracket");
    EXPECT_NE(within["reason"], "");
    EXPECT_GT(within["widest"], within["resolution"]);
    EXPECT_GE(within["clusters"].size(), 1U);
  }
}

TEST(WithinCommand, RejectsInOneLine) {
  const auto rejected = [](const std::string& words, const char* mention) {
    const CommandResult result = run_maxwrench("certify planar/force " + words);
    EXPECT_EQ(result.exit_status, 2) << words;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find(mention), std::string::npos) << result.err;
  };
  for (const char* share : {"0", "-1%", "101%", "1.01", "nan", "nan%", "one", "%", "''"}) {
    rejected("--within " + std::string(share), "--within");
  }
  for (const char* side : {"0", "-0.1", "nan", "inf", "fine"}) {
    rejected("--within 1% --resolution " + std::string(side), "--resolution");
  }
  rejected("--resolution 0.1", "--within");
  rejected("--boxes boxes.csv", "--within");
  rejected("--figure boxes.svg", "--within");
  rejected("--within 1% --boxes same --figure same", "same");
}

}  // namespace
}  // namespace maxwrench
