#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "maxwrench/load.h"
#include "maxwrench/trajectory_proof.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/support.h"
#include "tests/support/trajectory_proofs.h"
#include "verify/trajectory/verify_trajectory.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;

std::string turn_file() {
  return MAXWRENCH_SOURCE_DIR "/examples/tasks/turn_along_with_a_dead_thruster.toml";
}

/// A proof of the turn with a dead thruster, whose posture is held, and its certificate.
struct ListProof {
  Problem problem = load_problem(turn_file());
  TrajectoryProof proof;
  std::vector<TrajectoryCertificate> claims;

  ListProof() {
    TrajectoryProofOptions how;
    how.keep_certificate = true;
    proof = certify_trajectory(problem, default_knots(problem), {}, how);
    const TemporaryFolder folder;
    const std::string file = folder.path() / "turn.proof";
    std::ofstream(file, std::ios::binary) << proof.certificate;
    claims = read_trajectory_certificates(file);
  }
};

const ListProof& list_proof() {
  static const ListProof proof;
  return proof;
}

/// The posture is held, so nothing lies between samples: what is proven is nearly the value between
/// knots, 12.072 N m. The value of a list is the least of its scenarios, each of which another
/// evaluation bounds.
TEST(TrajectoryListProof, SLOW_ProvesTheLeastOfAllScenarios) {
  const auto& [problem, proof, claims] = list_proof();
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  const double between = proof.answer.trajectory.value_between_knots;
  EXPECT_LE(proof.guaranteed, between + 1e-9);
  EXPECT_NEAR(proof.guaranteed, between, 5e-4 * between);
  EXPECT_EQ(proof.scenarios, 3);
  EXPECT_THAT(proof.decides, HasSubstr("dead"));
  ASSERT_EQ(claims.size(), 3u);
  EXPECT_GT(claims[0].value, 2 * proof.guaranteed);  // nothing is lost
  const TaskVerification check = verify(problem, claims, 2);
  EXPECT_EQ(check.rejection, "");
  EXPECT_EQ(check.guaranteed, proof.guaranteed);
  EXPECT_EQ(check.decides, proof.decides);
}

/// The dead thruster exerts nothing, also not the remainder of the balance.
TEST(TrajectoryListProof, DeadThrustersHaveNoEfforts) {
  const auto& [problem, proof, claims] = list_proof();
  for (std::size_t i = 1; i < claims.size(); ++i) {
    const Zonotope& limits = problem.scenarios.limits[i].actuation;
    int dead = 0;
    for (Eigen::Index k = 0; k < limits.u_min.size(); ++k) {
      if (limits.u_min[k] != 0 || limits.u_max[k] != 0) continue;
      ++dead;
      EXPECT_TRUE(claims[i].y.row(k).isZero(0)) << k;
    }
    EXPECT_EQ(dead, 1);
  }
}

TEST(TrajectoryListProof, RejectsWhatIsNotAProofOfTheList) {
  using Claims = std::vector<TrajectoryCertificate>;
  const std::vector<std::function<void(Claims&)>> all = {
      [](Claims& c) { c.pop_back(); },
      [](Claims& c) { c.clear(); },
      [](Claims& c) { c.push_back(c.back()); },
      [](Claims& c) { std::swap(c[0], c[1]); },
      [](Claims& c) { c[2] = c[1]; },
      [](Claims& c) { c[1].value *= 1.01; },
      [](Claims& c) { c[1].digest ^= 1; },
      [](Claims& c) { c[2].knots(3, 0) += 1e-9; },
      [](Claims& c) { c[2].collision = false; },
      [](Claims& c) { c[2].problem += "x"; },
      [](Claims& c) { c[1].version = "0"; },
      [](Claims& c) { c[1].y = c[0].y; },
      [](Claims& c) { c[1].y.array() += 1; },  // what is dead would exert something
  };
  const auto& [problem, proof, claims] = list_proof();
  for (std::size_t i = 0; i < all.size(); ++i) {
    Claims changed = claims;
    all[i](changed);
    EXPECT_NE(verify(problem, changed, 2).rejection, "") << i;
  }
  const Problem alone = load_problem("uvms/valve_trajectory");
  EXPECT_NE(verify(alone, claims, 2).rejection, "");
  Claims one(1, claims[0]);
  EXPECT_NE(verify(alone, one, 2).rejection, "");  // of the list, not of the shipped task
}

/// The claim is the least of all certificates, also of those after the first that is false.
TEST(TrajectoryListProof, ARejectedClaimIsThatOfAllScenarios) {
  const auto& [problem, proof, claims] = list_proof();
  for (std::size_t i = 0; i < claims.size(); ++i) {
    auto changed = claims;
    changed[i].digest ^= 1;
    const TaskVerification check = verify(problem, changed, 2);
    EXPECT_NE(check.rejection, "") << i;
    EXPECT_EQ(check.guaranteed, proof.guaranteed) << i;
    EXPECT_EQ(check.decides, proof.decides) << i;
  }
  const TaskVerification other = verify(load_problem("uvms/valve_trajectory"), claims, 2);
  EXPECT_TRUE(std::isnan(other.guaranteed));
  EXPECT_EQ(other.decides, "");
}

/// Wrenches keep their lengths: twice the wrench has half the factor.
TEST(TrajectoryListProof, FactorsAreThoseOfTheStatedWrenches) {
  Problem problem = load_problem(turn_file());
  ScenarioList& list = problem.scenarios;
  list.limits.resize(1);
  list.wrenches[0].c *= 2;
  const TrajectoryProof twice = certify_trajectory(problem, default_knots(problem));
  const Problem shipped = load_problem("uvms/valve_trajectory");
  const TrajectoryProof once = certify_trajectory(shipped, default_knots(problem));
  EXPECT_EQ(twice.status, Status::kProven) << twice.reason.str();
  EXPECT_NEAR(2 * twice.guaranteed, once.guaranteed, 1e-9 * once.guaranteed);
}

/// A dead thruster exerts nothing, exactly, though a solver of programs with a lag rounds.
TEST(TrajectoryListProof, ProvesThrustersThatLag) {
  Problem problem = load_problem(turn_file());
  problem.motion->thruster_lag = 0.1;
  const TrajectoryProof proof = certify_trajectory(problem, default_knots(problem));
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  EXPECT_LE(proof.guaranteed, list_proof().proof.guaranteed);
  EXPECT_NEAR(proof.guaranteed, list_proof().proof.guaranteed, 5e-3);
}

/// One wheel or another may be dead. All scenarios are of one motion of the dependent joints.
TEST(TrajectoryListProof, ProvesDependentJoints) {
  const TemporaryFolder folder;
  const std::string task = folder.path() / "push.toml", file = folder.path() / "push.proof";
  std::string text = read_text(MAXWRENCH_SOURCE_DIR "/problems/mobile/trajectory.toml");
  const std::string robot = "\"rover.toml\"";
  ASSERT_NE(text.find(robot), std::string::npos);
  text.replace(text.find(robot), robot.size(),
               "\"" MAXWRENCH_SOURCE_DIR "/problems/mobile/rover.toml\"");
  std::ofstream(task) << text << "\n[loss]\ncases = [[\"front_left\"], [\"rear_right\"]]\n";
  const Problem problem = load_problem(task);
  TrajectoryProofOptions how;
  how.keep_certificate = true;
  const TrajectoryProof proof = certify_trajectory(problem, default_knots(problem), {}, how);
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  EXPECT_EQ(proof.scenarios, 3);
  const double between = proof.answer.trajectory.value_between_knots;
  EXPECT_LE(proof.guaranteed, between + 1e-9);
  EXPECT_NEAR(proof.guaranteed, between, 5e-4 * between);
  std::ofstream(file, std::ios::binary) << proof.certificate;
  std::vector<TrajectoryCertificate> claims = read_trajectory_certificates(file);
  ASSERT_EQ(claims.size(), 3u);
  const TaskVerification check = verify(problem, claims, 2);
  EXPECT_EQ(check.rejection, "");
  EXPECT_EQ(check.guaranteed, proof.guaranteed);
  claims[1].dependent(0, 0) += 1e-9;
  EXPECT_EQ(verify(problem, claims, 2).rejection, "its scenarios are of different trajectories");
}

TEST(TrajectoryListProof, RefusesScenariosThatOnlyHold) {
  Problem problem = load_problem(turn_file());
  problem.scenarios.wrenches.push_back({.name = "hold", .hold = true});
  EXPECT_THAT(rejection_of([&] { certify_trajectory(problem, default_knots(problem)); }),
              HasSubstr("got wrench.hold"));
}

}  // namespace
}  // namespace maxwrench
