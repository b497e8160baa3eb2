#include <gtest/gtest.h>

#include "maxwrench/batch.h"
#include "maxwrench/bound.h"
#include "maxwrench/certify.h"
#include "maxwrench/objective.h"
#include "maxwrench/solve.h"
#include "solvers/solve/method.h"
#include "tests/support/boxes.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/contacts.h"
#include "tests/support/scenario_task.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

struct AloneForm {
  const char* wrench;
  std::string tables;
  Wrench allowed;
};

constexpr const char* kHorizontalDisc = "ball = { axes = [\"fx\", \"fy\"], radius = 2 }";

std::vector<AloneForm> alone_forms() {
  const std::string flow = "[environment]\ncurrent = [0.4, -0.2, 0.1]\n";
  const std::string loss =
      "[loss]\ncases = [[\"front_left_vertical\"], [\"rear_right_vertical\"]]\n";
  return {{kLift, flow, Wrench::kPure},
          {kTurn, flow, Wrench::kPure},
          {kTurn, flow + loss + "[uncertainty]\nmass.link_4 = 0.1\n", Wrench::kPure},
          {"set = [[0, 0, 20, 0, 0, 0], [0, 0, 0, 0, 0, 2]]", flow, Wrench::kPure},
          {kTurn, loss, Wrench::kAny},
          {kLift, loss + "[uncertainty]\ntrim = 0.2\ncom.link_2 = [0.01, 0, 0]\n", Wrench::kAny},
          {"set = [[0, 0, 0, 0, 0, 3], [0, 0, 0, 0, 0, -2]]", "", Wrench::kAny},
          {kHorizontalDisc, loss, Wrench::kAny},
          {"ball = { axes = [\"tx\", \"tz\"], radius = 0.5 }\nhold = true",
           "[uncertainty]\ntrim = 0.2\n", Wrench::kAny},
          {"ball = { axes = [\"fz\"], radius = 3 }", loss, Wrench::kAny},
          {"ball = { axes = [\"tx\", \"tz\"], radius = 0.5 }\nany = [\"fx\", \"tx\", \"tz\"]", "",
           Wrench::kAny},
          {"set = [[1, 0, 0, 0, 0, 0], [0, 0, -1, 0, 0, 0]]", loss, Wrench::kAny}};
}

/// No posture of a box exceeds its bound, and that of a small box is close.
TEST(AloneListBound, NoPostureExceedsIt) {
  for (const AloneForm& form : alone_forms()) {
    Problem task = scenario_task(form.wrench, form.tables);
    task.robot.collision = nullptr;
    Options options;
    options.wrench = form.allowed;
    const auto bound = make_capability_bound(task, "linf_polytope", form.allowed);
    const auto copy = bound->clone();
    const auto objective =
        make_capability_objective(task, form.allowed, resolve(task, options).make_measure);
    Random random(4);
    long valued = 0, tight = 0;
    const double ceiling = bound->ceiling();
    for (int i = 0; i < samples(20); ++i) {
      const RandomBox box = random_box(task, random);
      const double low = evaluate_one(*objective, (box.lower + box.upper) / 2);
      const double from = std::isfinite(low) ? low : 0;
      BoxProof proof;
      bound->evaluate(box.lower, box.upper, from, ceiling, proof);
      BoxProof half = proof, again;
      Eigen::VectorXd upper = box.upper, inside = box.lower;
      upper[0] = (box.lower[0] + box.upper[0]) / 2;
      bound->evaluate(box.lower, upper, from, proof.high, half);
      copy->evaluate(box.lower, box.upper, from, ceiling, again);
      EXPECT_EQ(again.high, proof.high);
      for (int k = 0; k < 8; ++k) {
        for (Eigen::Index j = 0; j < inside.size(); ++j) {
          inside[j] = random.uniform(box.lower[j], box.upper[j]);
        }
        const double value = evaluate_one(*objective, inside);
        if (!std::isfinite(value)) continue;
        ++valued;
        const double slack = 1e-8 * (1 + std::abs(value));
        ASSERT_LE(value, std::max(proof.high, from) + slack) << form.tables << i;
        tight += value > 0.9 * std::max(proof.high, from);
        if (inside[0] > upper[0]) continue;
        ASSERT_LE(value, std::max(half.high, from) + slack) << form.tables << i;
      }
    }
    EXPECT_GT(valued, 0) << form.tables;
    EXPECT_GT(tight, 0) << form.tables;
  }
}

/// With almost no current it is the bound of the task in still water.
TEST(AloneListBound, OfAlmostNoCurrentIsThatOfStillWater) {
  Problem still = scenario_task(kTurn, "");
  Problem slow = scenario_task(kTurn, "[environment]\ncurrent = [1e-9, 0, 0]\n");
  still.robot.collision = slow.robot.collision = nullptr;
  const auto expected = make_capability_bound(still, "linf_polytope", Wrench::kPure);
  const auto found = make_capability_bound(slow, "linf_polytope", Wrench::kPure);
  Random random(6);
  for (int i = 0; i < samples(20); ++i) {
    const Eigen::VectorXd at = random_theta_r(still, random);
    BoxProof a, b;
    expected->evaluate(at, at, 0, 1e3, a);
    found->evaluate(at, at, 0, 1e3, b);
    EXPECT_NEAR(a.high, b.high, 1e-2 * (1 + a.high));
  }
}

/// The search and the proof enclose the best posture in a current.
TEST(AloneListBound, SLOW_ProvesTheBestPostureInAKnownCurrent) {
  const Problem task = scenario_task(kLift, "[environment]\ncurrent = [0.3, 0, 0]\n");
  const Proof proof = certify(task, Options(), {.gap = 1e-2, .seconds = 600});
  EXPECT_EQ(proof.status, Status::kProven);
  EXPECT_LE(proof.gap(), 1e-2 * (1 + 1e-9));
  EXPECT_GT(proof.answer.capability.beta, evaluate(task, task.theta_r_default).beta());
  EXPECT_THROW(certify(task, Options(), {.gap = 1e-2, .keep_certificate = true}),
               std::invalid_argument);
}

/// At a point the bound of a disc with any wrenches is its value: the program turns to the normal
/// of the nearest edge, so no choice of directions remains.
TEST(AloneListBound, OfADiscIsExactAtAPoint) {
  Problem task = scenario_task(kHorizontalDisc, "[uncertainty]\ntrim = 0.2\n");
  task.robot.collision = nullptr;
  Options options;
  options.wrench = Wrench::kAny;
  const auto bound = make_capability_bound(task, "linf_polytope", Wrench::kAny);
  const auto objective =
      make_capability_objective(task, Wrench::kAny, resolve(task, options).make_measure);
  Random random(5);
  for (int values = 0; values < 20;) {
    const Eigen::VectorXd at = random_theta_r(task, random);
    const double value = evaluate_one(*objective, at);
    if (!std::isfinite(value)) continue;
    ++values;
    BoxProof proof;
    bound->evaluate(at, at, value - 1e-4 * (1 + value), bound->ceiling(), proof);
    EXPECT_NEAR(proof.high, value, 2e-6 * (1 + value));
  }
}

/// The best force in any horizontal direction with any other components, proven. The independent
/// model has 88.01 N in the default posture.
TEST(AloneListBound, SLOW_ProvesADiscWithAnyWrenches) {
  const Problem task = scenario_task(kHorizontalDisc, "");
  Options options;
  options.wrench = Wrench::kAny;
  const Proof proof = certify(task, options, {.gap = 0.1, .seconds = 600});
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  EXPECT_LE(proof.gap(), 0.1 * (1 + 1e-9));
  EXPECT_GE(2 * proof.answer.capability.beta, 88.01);
  EXPECT_NE(why_no_certificate(task, Wrench::kAny), "");
}

/// At a posture one sense of the torque needs a push on the wall and the other one none. So each
/// scenario has shares of its own, and some half of each share holds the forces of a value.
TEST(AloneListBound, ScenariosExertForcesOfTheirOwn) {
  Problem task =
      second_contact_task("bar_wall.toml", "set = [[0, 0, 0, 0, 0, 1], [0, 0, 0, 0, 0, -1]]",
                          "[loss]\ncases = [[\"front_left_vertical\"]]\n");
  task.robot.collision = nullptr;
  const auto bound = make_capability_bound(task, "linf_polytope", Wrench::kPure);
  Eigen::VectorXd least = task.theta_r_min, most = task.theta_r_max;
  bound->extend(least, most);
  constexpr Eigen::Index kPlaces = 2, kArm = 3, kShares = 4;
  ASSERT_EQ(least.size(), kPlaces + kArm + kShares);
  Random random(8);
  int valued = 0;
  for (int i = 0; i < samples(20); ++i) {
    const Answer answer = evaluate(task, near_default(task, random));
    if (answer.status != Status::kOptimal) continue;
    ++valued;
    Eigen::VectorXd x(kPlaces + kArm);
    x << answer.posture.theta_r, answer.posture.q(task.contact->follow);
    least.head(kPlaces + kArm) = x.array() - 1e-7;
    most.head(kPlaces + kArm) = x.array() + 1e-7;
    double high = -kInfinity;
    for (unsigned halves = 0; halves < 1U << kShares; ++halves) {
      Eigen::VectorXd lower = least, upper = most;
      for (Eigen::Index k = 0; k < kShares; ++k) {
        const bool second = (halves >> k & 1U) != 0;
        (second ? lower : upper)[kPlaces + kArm + k] = 0.5;
      }
      ASSERT_TRUE(bound->shrink(lower, upper, nullptr));
      BoxProof proof;
      bound->evaluate(lower, upper, 0, 1e3, proof);
      high = std::max(high, proof.high);
    }
    EXPECT_GE(high, answer.beta() * (1 - 1e-9));
    EXPECT_LE(high, answer.beta() * (1 + 1e-3));
  }
  EXPECT_GT(valued, 0);
}

/// No place of a grid on the wall exceeds the bound, and one nearly reaches it.
TEST(AloneListBound, ProvesTheBestPlaceOfALossBesideASecondContact) {
  const Problem task =
      second_contact_task("bar_wall.toml", kTurn, "[loss]\nany = 1\nactuators = [\"thrusters\"]\n");
  const Proof proof = certify(task, Options(), {.gap = 1e-3, .seconds = 300});
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  constexpr int kPlaces = kSanitized ? 5 : 25;
  double best = 0;
  for (int i = 0; i < kPlaces * kPlaces; ++i) {
    Eigen::VectorXd place(2);
    place << i % kPlaces, i / kPlaces;
    const Answer answer = evaluate(
        task, task.theta_r_min +
                  (task.theta_r_max - task.theta_r_min).cwiseProduct(place) / (kPlaces - 1));
    if (answer.status == Status::kOptimal) best = std::max(best, answer.beta());
  }
  EXPECT_LE(best, proof.bound);
  EXPECT_GE(best, (kSanitized ? 0.7 : 0.95) * proof.bound);
  EXPECT_EQ(why_no_certificate(task, Wrench::kPure), "a list with forces of a second contact");
}

/// Without shares, a box has the coordinates of the posture only, for all scenarios.
TEST(AloneListBound, NeedsNoSharesWhereTheBaseDeterminesTheForces) {
  Problem task =
      second_contact_task("two_arms.toml", "set = [[0, 0, 0, 0, 0, 1], [0, 0, 0, 0, 0, -1]]",
                          "[loss]\ncases = [[\"front_left_vertical\"]]\n");
  task.robot.collision = nullptr;
  const auto bound = make_capability_bound(task, "linf_polytope", Wrench::kPure);
  Eigen::VectorXd least = task.theta_r_min, most = task.theta_r_max;
  bound->extend(least, most);
  constexpr Eigen::Index kArm = 3;
  ASSERT_EQ(least.size(), task.redundancy() + kArm);
  EXPECT_EQ(why_no_certificate(task), "a list with forces of a second contact");
  Random random(8);
  int valued = 0;
  for (int i = 0; i < samples(40); ++i) {
    const Answer answer = evaluate(task, near_default(task, random));
    if (answer.status != Status::kOptimal) continue;
    ++valued;
    Eigen::VectorXd x(least.size());
    x << answer.posture.theta_r, answer.posture.q(task.contact->follow);
    Eigen::VectorXd lower = x.array() - 1e-6, upper = x.array() + 1e-6;
    ASSERT_TRUE(bound->shrink(lower, upper, nullptr));
    BoxProof proof;
    bound->evaluate(lower, upper, 0, 1e3, proof);
    EXPECT_GE(proof.high, answer.beta() * (1 - 1e-9));
    EXPECT_LE(proof.high, answer.beta() * (1 + 1e-3));
  }
  EXPECT_GT(valued, 0);
}

/// A list of one scenario has the bound of an ordinary task with its limits.
TEST(AloneListBound, OfOneScenarioIsThatOfAnOrdinaryTask) {
  const Problem list = second_contact_task("bar_wall.toml", kTurn, "[uncertainty]\nthrust = 0.1\n");
  Problem task = second_contact_task("bar_wall.toml", kTurn, "");
  Zonotope& set = task.robot.actuation;
  Eigen::VectorXd share = Eigen::VectorXd::Ones(set.actuators());
  share.head(static_cast<Eigen::Index>(task.robot.thrusters.size())).setConstant(0.9);
  set = make_zonotope(set.B, set.u_min.cwiseProduct(share).eval(),
                      set.u_max.cwiseProduct(share).eval());
  const ProofOptions how{.gap = 1e-3, .seconds = 300};
  const Proof one = certify(list, Options(), how), other = certify(task, Options(), how);
  EXPECT_EQ(one.status, Status::kProven);
  EXPECT_NEAR(one.answer.beta(), other.answer.beta(), 1e-3 * other.answer.beta());
  EXPECT_LE(other.answer.beta(), one.bound);
  EXPECT_LE(one.answer.beta(), other.bound);
}

TEST(AloneListBound, RejectsWhatItDoesNotBound) {
  const auto rejects = [](const char* wrench, const std::string& tables, Wrench allowed) {
    const Problem task = scenario_task(wrench, tables);
    return rejection_of([&] { make_capability_bound(task, "linf_polytope", allowed); });
  };
  const std::string flow = "[environment]\ncurrent = [0.3, 0, 0]\n";
  EXPECT_NE(rejects(kLift, flow, Wrench::kAny).find("any wrenches in a current"),
            std::string::npos);
  EXPECT_NE(rejects("ball = { axes = [\"fx\", \"fy\"], radius = 1 }", flow, Wrench::kPure)
                .find("a known current with a ball"),
            std::string::npos);
  EXPECT_NE(rejects(kLift, flow + "[loss]\nany = 3\n", Wrench::kPure).find("at most 64"),
            std::string::npos);
  const auto rejects_at_wall = [](const char* wrench, const std::string& tables) {
    const Problem task = second_contact_task("bar_wall.toml", wrench, tables);
    return rejection_of([&] { make_capability_bound(task, "linf_polytope", Wrench::kPure); });
  };
  EXPECT_NE(rejects_at_wall(kTurn, "[loss]\nany = 3\n")
                .find("forces of a second contact with many scenarios, expected at most 64"),
            std::string::npos);
  EXPECT_NE(rejects_at_wall("ball = { axes = [\"fx\", \"fy\"], radius = 1 }", "")
                .find("forces of a second contact with a ball of several axes"),
            std::string::npos);
}

}  // namespace
}  // namespace maxwrench
