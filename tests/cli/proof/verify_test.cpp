#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "benchmarks/tables/csv.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using nlohmann::json;

class VerifyCommand : public testing::Test {
 protected:
  std::string certificate(const std::string& words) const {
    const std::string file = folder_.path() / "proof.mwc";
    const CommandResult result = run_maxwrench("certify " + words + " --certificate " + file);
    EXPECT_EQ(result.exit_status, 0) << result.err;
    return file;
  }
  TemporaryFolder folder_;
};

TEST_F(VerifyCommand, Verifies) {
  const std::string file = certificate("planar/force --measure ellipsoid");
  const CommandResult text = run_maxwrench("verify " + file);
  EXPECT_EQ(text.exit_status, 0) << text.err;
  for (const char* line : {"planar/force  measure ellipsoid  wrench pure\nverified\n",
                           ": no posture has more\n", " by a multiplier, "}) {
    EXPECT_NE(text.out.find(line), std::string::npos) << line << " in\n" << text.out;
  }
  const json object = json::parse(run_maxwrench("verify --json " + file).out);
  EXPECT_EQ(object["status"], "verified");
  EXPECT_EQ(object["reason"], "");
  EXPECT_GE(object["bound"], object["beta"]);
  EXPECT_GE(object["ceiling"], object["bound"]);
  EXPECT_TRUE(object["collision"]);
}

TEST_F(VerifyCommand, KnowsWhetherCollisionsCounted) {
  const std::string file = certificate("uvms/lift --ignore-collision --gap 0.1");
  const CommandResult result = run_maxwrench("verify " + file);
  EXPECT_EQ(result.exit_status, 0) << result.out;
  EXPECT_NE(result.out.find("collisions ignored"), std::string::npos);
}

TEST_F(VerifyCommand, RejectsAnotherTask) {
  const std::string file = certificate("planar/force");
  const CommandResult result = run_maxwrench("verify --problem uvms/valve " + file);
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_NE(result.out.find("\nrejected: it is for another robot or task\n"), std::string::npos)
      << result.out;
}

TEST_F(VerifyCommand, RejectsOtherFilesInOneLine) {
  const auto rejected = [](const std::string& words, const char* mention) {
    const CommandResult result = run_maxwrench("verify " + words);
    EXPECT_EQ(result.exit_status, 2) << words;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find(mention), std::string::npos) << result.err;
  };
  rejected("README.md", "README.md: got something else");
  rejected("no_such_file", "no_such_file: got no data");
  const std::string file = certificate("planar/force");
  std::string text = read_text(file);
  text[text.size() / 2] ^= 1;
  std::ofstream(file, std::ios::binary) << text;
  rejected(file, "damaged");
}

TEST_F(VerifyCommand, SaysThatAFolderIsNoCertificate) {
  const CommandResult result = run_maxwrench("verify " + std::string(folder_.path()));
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_EQ(result.err, "maxwrench: " + std::string(folder_.path()) +
                            ": got a folder without map.json, expected the folder of 'map --out', "
                            "or a file: a certificate or the values.csv.gz of 'run'\n");
}

/// A certificate of nothing is none.
TEST(CertifyCommand, WritesNoCertificateWithoutABound) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "proof.mwc";
  const CommandResult result =
      run_maxwrench("certify mobile/push_any_height --time 0 --certificate " + file);
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_NE(result.out.find("\nbound     none proven\ngap       unknown\n"), std::string::npos)
      << result.out;
  EXPECT_NE(result.err.find("not written"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(file));
}

/// The rows of the project's own run; and one that claims a tenth more is rejected by its name.
TEST_F(VerifyCommand, ChecksRowsOfARun) {
  const std::string rows = MAXWRENCH_SOURCE_DIR "/results/values.csv.gz";
  const int sample = std::max(20, samples(200));
  const json good =
      json::parse(run_maxwrench(fmt::format("verify --json --sample {} {}", sample, rows)).out);
  EXPECT_EQ(good["status"], "verified") << good["rejected"];
  EXPECT_EQ(good["checked"], sample);
  EXPECT_GT(good["values"], sample / 2);
  EXPECT_LT(good["deviation"], 1e-6);
  const std::string file = folder_.path() / "values.csv.gz";
  const CommandResult run = run_maxwrench(
      "run planar/force measure=linf_polytope solver=facets search=crs2 budget=500 --out " +
      folder_.path().string());
  ASSERT_EQ(run.exit_status, 0) << run.err;
  EXPECT_EQ(run_maxwrench("verify " + file).exit_status, 0);
  std::string text = csv_text(file);
  const std::size_t beta = text.find("best_found,3.") + std::string("best_found,").size();
  ASSERT_LT(beta, text.size());
  std::ofstream(file) << text.replace(beta, 3, "3.9");
  const CommandResult other = run_maxwrench("verify " + file);
  EXPECT_EQ(other.exit_status, 1);
  EXPECT_NE(other.out.find("rejected: planar/force,linf_polytope,pure,facets,crs2,1,500"),
            std::string::npos)
      << other.out;
  std::ofstream(file, std::ios::app) << "planar/force,linf_polytope\n";
  const CommandResult torn = run_maxwrench("verify " + file);
  EXPECT_EQ(torn.exit_status, 2);
  EXPECT_NE(torn.err.find("got 2 fields, expected"), std::string::npos) << torn.err;
}

}  // namespace
}  // namespace maxwrench
