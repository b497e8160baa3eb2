#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

using nlohmann::json;

constexpr const char* kShippedTurn =
    "uvms/valve_trajectory --theta-r results/trajectories/uvms_valve_trajectory_spline.csv ";

/// From the command to its certificate and the check.
TEST(CertifyTrajectoryCommand, ProvesAndIsVerified) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "turn.proof";
  const CommandResult result =
      run_maxwrench(std::string("certify ") + kShippedTurn + "--json --certificate " + file);
  EXPECT_EQ(result.exit_status, 0) << result.err;
  const json proof = json::parse(result.out);
  EXPECT_EQ(proof["status"], "proven");
  EXPECT_EQ(proof["unit"], "N m");
  EXPECT_TRUE(proof["t"].is_null());
  const double guaranteed = proof["guaranteed"], between = proof["value_between_knots"];
  EXPECT_LE(guaranteed, 35.776336);  // the least of 9,001 instants of an independent model
  EXPECT_GE(guaranteed, between * (1 - 5e-4));
  const CommandResult check = run_maxwrench("verify --json " + file);
  EXPECT_EQ(check.exit_status, 0) << check.err;
  EXPECT_EQ(json::parse(check.out)["status"], "verified");
  EXPECT_EQ(json::parse(check.out)["guaranteed"], guaranteed);
  const CommandResult text = run_maxwrench("verify " + file);
  EXPECT_EQ(text.out.find("uvms/valve_trajectory\nverified\nguaranteed 35.7"), 0u) << text.out;
  const CommandResult other =
      run_maxwrench("verify --problem uvms/valve_trajectory_fast --json " + file);
  EXPECT_EQ(other.exit_status, 1);
  EXPECT_EQ(json::parse(other.out)["reason"], "it is for another robot or task");
  const CommandResult rows = run_maxwrench("verify --sample 3 " + file);
  EXPECT_EQ(rows.exit_status, 2);
  EXPECT_EQ(rows.err, "maxwrench: --sample: got 3, expected no such option with a certificate\n");
}

/// Joints that depend on the base's free axes. The certificate is for this task alone.
TEST(CertifyTrajectoryCommand, ProvesDependentJoints) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "mobile.proof";
  const CommandResult result =
      run_maxwrench("certify mobile/trajectory --theta-r 0,-1 --json --certificate " + file);
  EXPECT_EQ(result.exit_status, 0) << result.err;
  const json proof = json::parse(result.out);
  EXPECT_EQ(proof["status"], "proven");
  const double guaranteed = proof["guaranteed"], between = proof["value_between_knots"];
  EXPECT_LE(guaranteed, between);
  EXPECT_GE(guaranteed, between * (1 - 5e-4));
  const CommandResult check = run_maxwrench("verify --json " + file);
  EXPECT_EQ(check.exit_status, 0) << check.err;
  EXPECT_EQ(json::parse(check.out)["guaranteed"], guaranteed);
  const CommandResult other = run_maxwrench("verify --problem planar/trajectory --json " + file);
  EXPECT_EQ(other.exit_status, 1);
  EXPECT_EQ(json::parse(other.out)["reason"], "it is for another robot or task");
}

/// A damaged file has exit status 2 and one line.
TEST(CertifyTrajectoryCommand, RejectsADamagedCertificate) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "turn.proof";
  run_maxwrench("certify planar/trajectory --theta-r 0.3,0.1 --certificate " + file);
  std::string text = read_text(file);
  text[text.size() / 2] ^= 1;
  std::ofstream(file, std::ios::binary) << text;
  const CommandResult result = run_maxwrench("verify " + file);
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_NE(result.err.find("got a damaged file"), std::string::npos) << result.err;
}

TEST(CertifyTrajectoryCommand, RefusesWithTheInstant) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "turn.proof";
  const CommandResult result = run_maxwrench(
      "certify uvms/valve_trajectory --scheme forward --theta-r "
      "results/trajectories/uvms_valve_trajectory_forward.csv --certificate " +
      file);
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_NE(result.out.find("\ninvalid_posture: t = 0."), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("guaranteed"), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("not written: nothing is proven"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(file));
}

/// One line each, with exit status 2.
TEST(CertifyTrajectoryCommand, RejectsWhatDoesNotApply) {
  for (const char* words :
       {"certify planar/trajectory --theta-r 0,0 --gap 0.1",
        "certify planar/trajectory --theta-r 0,0 --time 3",
        "certify planar/trajectory --certificate x", "certify planar/force --bound",
        "certify planar/trajectory --theta-r 0,0 --bound --certificate x",
        "certify planar/trajectory --within 1%", "certify planar/force --theta-r 0,0",
        "certify planar/force --scheme ends", "certify planar/trajectory --wrench any",
        "certify planar/trajectory --measure ellipsoid", "certify mobile/trajectory",
        "certify planar/trajectory --theta-r 0,0,0", "certify planar/trajectory --theta-r none.csv",
        "certify uvms/valve_impulse --theta-r 0,0,0,0 --t-h 2 --certificate x",
        "certify planar/trajectory --theta-r 0,0 --thruster-lag 1 --certificate x",
        "solve planar/force --proven"}) {
    const CommandResult result = run_maxwrench(words);
    EXPECT_EQ(result.exit_status, 2) << words << result.out;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << words << result.err;
    EXPECT_NE(result.err.find("expected"), std::string::npos) << words << result.err;
  }
}

/// Without a trajectory: no trajectory exceeds the bound.
TEST(BoundTrajectoriesCommand, SLOW_BoundsWhatItFinds) {
  const CommandResult result = run_maxwrench("certify planar/trajectory --json");
  EXPECT_EQ(result.exit_status, 1) << result.err;
  const json bound = json::parse(result.out);
  EXPECT_EQ(bound["status"], "bracket");
  EXPECT_EQ(bound["certificate"], false);
  const double value = bound["value"], most = bound["bound"], gap = bound["gap"];
  EXPECT_LT(value, most);
  EXPECT_DOUBLE_EQ(gap, (most - value) / value);
  EXPECT_GE(most, bound["allowed"].get<double>());
  const CommandResult text = run_maxwrench("certify planar/trajectory --theta-r 0.3,0.1 --bound");
  EXPECT_EQ(text.exit_status, 1);
  EXPECT_NE(text.out.find("of the given trajectory\nbound "), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("\nno certificate: "), std::string::npos) << text.out;
}

TEST(SolveProvenCommand, ProvesWhatItFinds) {
  const CommandResult result =
      run_maxwrench("solve planar/trajectory --proven --budget 60 --seed 2 --json");
  EXPECT_EQ(result.exit_status, 0) << result.err;
  const json answer = json::parse(result.out);
  EXPECT_EQ(answer["status"], "best_found");
  EXPECT_EQ(answer["proof"]["status"], "proven");
  const double value = answer["value"], guaranteed = answer["guaranteed"];
  EXPECT_LE(guaranteed, value);
  EXPECT_GE(guaranteed, 0.99 * value);
  const CommandResult text = run_maxwrench("solve planar/trajectory --proven --budget 60 --seed 2");
  EXPECT_NE(text.out.find("\nguaranteed "), std::string::npos) << text.out;
}

}  // namespace
}  // namespace maxwrench
