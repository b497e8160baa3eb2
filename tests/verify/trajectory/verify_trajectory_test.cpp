#include "verify/trajectory/verify_trajectory.h"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <limits>
#include <vector>

#include "lib/trajectory/motion_evaluator.h"
#include "maxwrench/load.h"
#include "maxwrench/trajectory.h"
#include "solvers/certify/trajectory/edge_program.h"
#include "tests/support/support.h"
#include "tests/support/trajectory_proofs.h"

namespace maxwrench {
namespace {

/// The shipped turn and its certificate.
const Problem& turn() {
  static const Problem problem = load_problem("uvms/valve_trajectory");
  return problem;
}
const TrajectoryCertificate& turn_proof() {
  static const TrajectoryCertificate proof =
      certified(turn(), shipped_knots("uvms_valve_trajectory_spline", turn()));
  return proof;
}
/// The impulse with its default posture held.
const Problem& held_impulse() {
  static const Problem problem = load_problem("uvms/valve_impulse");
  return problem;
}
const TrajectoryCertificate& impulse_proof() {
  static const TrajectoryCertificate proof =
      certified(held_impulse(), constant_knots(held_impulse(), held_impulse().motion->theta_0));
  return proof;
}

/// A path along which the wrench varies.
const Problem& fast_turn() {
  static const Problem problem = load_problem("uvms/valve_trajectory_fast");
  return problem;
}
const TrajectoryCertificate& fast_turn_proof() {
  static const TrajectoryCertificate proof = certified(fast_turn(), fast_turn_knots());
  return proof;
}

/// An impulse whose thrusters lag.
const Problem& lagged_impulse() {
  static const Problem problem = [] {
    Problem lagged = held_impulse();
    lagged.motion->thruster_lag = 0.1;
    return lagged;
  }();
  return problem;
}
const TrajectoryCertificate& lagged_proof() {
  static const TrajectoryCertificate proof =
      certified(lagged_impulse(), shipped_knots("uvms_valve_impulse_spline_lag", lagged_impulse()));
  return proof;
}

std::string rejection(const Problem& problem, const TrajectoryCertificate& proof) {
  return verify(problem, proof, 2).rejection;
}

TEST(VerifyTrajectory, VerifiesWhatIsProven) {
  EXPECT_EQ(rejection(turn(), turn_proof()), "");
  EXPECT_EQ(rejection(held_impulse(), impulse_proof()), "");
  EXPECT_EQ(rejection(fast_turn(), fast_turn_proof()), "");
  EXPECT_EQ(rejection(lagged_impulse(), lagged_proof()), "");
  const TrajectoryVerification one = verify(turn(), turn_proof(), 1);
  const TrajectoryVerification three = verify(turn(), turn_proof(), 3);
  EXPECT_EQ(one.slices, three.slices);
  EXPECT_EQ(one.clearance, three.clearance);
}

/// The least of 9,001 instants is 35.776335 N m, at 0.8972 s, by an independent model. It is below
/// the value at 25 instants per interval, 35.7770, so a claim of the latter is wrong, although it
/// holds at these instants. The check must say so near that time.
TEST(VerifyTrajectory, RejectsAValueThatHoldsAtSamplesOnly) {
  EXPECT_LE(turn_proof().value, 35.776336);
  EXPECT_GE(turn_proof().value, 35.7770 * (1 - 5e-4));
  TrajectoryCertificate wrong = turn_proof();
  wrong.value = 35.7770;
  const TrajectoryVerification result = verify(turn(), wrong, 2);
  EXPECT_NE(result.rejection, "");
  EXPECT_GT(result.t, 0.5);
  EXPECT_LT(result.t, 1.3);
}

/// Control points bound a B-spline, so each must be at least the value.
TEST(VerifyTrajectory, RejectsAPathWithAWrenchBelowItsValue) {
  ASSERT_GT(fast_turn_proof().w.size(), 0);
  EXPECT_GE(fast_turn_proof().w.minCoeff(), fast_turn_proof().value);
  TrajectoryCertificate wrong = fast_turn_proof();
  wrong.w[70] = wrong.value - 1e-9;
  EXPECT_EQ(rejection(fast_turn(), wrong), "a wrench is below its value");
  wrong.w[70] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(rejection(fast_turn(), wrong), "a number is not finite or is too large");
  wrong = fast_turn_proof();
  wrong.w *= 1.01;
  EXPECT_NE(rejection(fast_turn(), wrong), "");
  wrong.w.conservativeResize(wrong.w.size() - 1);
  EXPECT_EQ(rejection(fast_turn(), wrong), "its efforts have another size");
}

using Tamper = std::function<void(TrajectoryCertificate&)>;

/// Each is rejected: sizes, numbers that are none, limits, rates and balance.
TEST(VerifyTrajectory, RejectsTamperedCertificates) {
  const double nan = std::nan("");
  const std::vector<Tamper> all = {
      [](TrajectoryCertificate& p) { p.value += 0.01; },
      [](TrajectoryCertificate& p) { p.value = 40; },
      [](TrajectoryCertificate& p) { p.value = -200; },
      [nan](TrajectoryCertificate& p) { p.value = nan; },
      [](TrajectoryCertificate& p) { p.value = kInfinity; },
      [](TrajectoryCertificate& p) { p.digest ^= 1; },
      [](TrajectoryCertificate& p) { p.collision = false; },
      [](TrajectoryCertificate& p) { p.t_h = 3; },
      [](TrajectoryCertificate& p) { p.knots(4, 1) += 0.5; },
      [](TrajectoryCertificate& p) { p.knots.col(2).array() -= 3; },
      [](TrajectoryCertificate& p) { p.knots(0, 0) += 0.3; },
      [nan](TrajectoryCertificate& p) { p.knots(5, 3) = nan; },
      [](TrajectoryCertificate& p) { p.knots.conservativeResize(9, 4); },
      [](TrajectoryCertificate& p) { p.parts = 0; },
      [](TrajectoryCertificate& p) { p.parts *= 2; },
      [](TrajectoryCertificate& p) { p.parts = 1 << 30; },
      [](TrajectoryCertificate& p) { p.y(3, 200) += 20; },
      [](TrajectoryCertificate& p) { p.y.rowwise().reverseInPlace(); },
      [](TrajectoryCertificate& p) { p.y.setZero(); },
      [](TrajectoryCertificate& p) { p.y *= 1.5; },
      [nan](TrajectoryCertificate& p) { p.y(0, 0) = nan; },
      [](TrajectoryCertificate& p) { p.y(7, 31) = -kInfinity; },
      [](TrajectoryCertificate& p) { p.y.conservativeResize(11, p.y.cols()); },
      [](TrajectoryCertificate& p) { p.w.setOnes(p.y.cols()); },
  };
  ASSERT_GE(all.size(), 20u);
  for (std::size_t i = 0; i < all.size(); ++i) {
    TrajectoryCertificate proof = turn_proof();
    all[i](proof);
    EXPECT_NE(rejection(turn(), proof), "") << i;
  }
}

/// NaN differs from itself, but a task without a list has one trajectory only.
TEST(VerifyTrajectory, SaysThatANumberIsNoneOfATaskWithoutList) {
  TrajectoryCertificate wrong = turn_proof();
  wrong.knots(1, 0) = std::numeric_limits<double>::quiet_NaN();
  const TaskVerification result = verify(turn(), std::vector<TrajectoryCertificate>{wrong}, 2);
  EXPECT_EQ(result.rejection, "a number is not finite or is too large");
}

TEST(VerifyTrajectory, RejectsTamperedImpulses) {
  const std::vector<Tamper> all = {
      [](TrajectoryCertificate& p) { p.value += 1e-3; },
      [](TrajectoryCertificate& p) { p.t_h = 2; },
      [](TrajectoryCertificate& p) { p.t_h = 0; },
      [](TrajectoryCertificate& p) { p.w[0] = -1; },
      [](TrajectoryCertificate& p) { p.w.setConstant(p.value + 1); },
      [](TrajectoryCertificate& p) { p.w[100] = std::nan(""); },
      [](TrajectoryCertificate& p) { p.w.resize(0); },
      [](TrajectoryCertificate& p) { p.knots.row(1).array() += 0.05; },
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    TrajectoryCertificate proof = impulse_proof();
    all[i](proof);
    EXPECT_NE(rejection(held_impulse(), proof), "") << i;
  }
}

/// With the digest of a robot that can do less, the numbers themselves must fail.
TEST(VerifyTrajectory, RejectsWeakerRobots) {
  using Change = std::function<void(Problem&)>;
  const std::vector<Change> all = {
      [](Problem& p) { p.robot.actuation.u_max *= 0.99; },
      [](Problem& p) { p.robot.actuation.u_min *= 0.99; },
      [](Problem& p) { p.robot.u_rate_max *= 0.01; },
      [](Problem& p) { p.robot.links[3].mass += 0.05; },
      [](Problem& p) { p.robot.links[0].hydrodynamics[0].added_mass *= 1.2; },
      [](Problem& p) { p.robot.links[0].hydrodynamics[0].damping_quadratic *= 2; },
      [](Problem& p) { p.robot.joints[1].velocity_max *= 0.8; },
      [](Problem& p) { p.theta_r_max[1] = turn_proof().knots.col(1).maxCoeff() - 0.01; },
      [](Problem& p) { p.motion->T *= 0.9; },
      [](Problem& p) { p.motion->thruster_lag = 10; },
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    Problem problem = turn();
    all[i](problem);
    TrajectoryCertificate proof = turn_proof();
    EXPECT_EQ(rejection(problem, proof), "it is for another robot or task") << i;
    proof.digest = motion_digest(problem);
    EXPECT_NE(rejection(problem, proof), "") << i;
  }
}

/// The commands are at their limits where an impulse rises, so those of a larger lag are beyond.
TEST(VerifyTrajectory, RejectsCommandsBeyondTheirLimits) {
  Problem slower = lagged_impulse();
  slower.motion->thruster_lag *= 1.2;
  TrajectoryCertificate proof = lagged_proof();
  EXPECT_EQ(rejection(slower, proof), "it is for another robot or task");
  proof.digest = motion_digest(slower);
  EXPECT_EQ(rejection(slower, proof).find("the command of "), 0U) << rejection(slower, proof);
}

/// Any byte that changes, and any end that is missing.
TEST(VerifyTrajectory, RejectsDamagedFiles) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "proof", text = certificate_text(turn_proof());
  const auto write = [&](const std::string& contents) {
    std::ofstream(file, std::ios::binary) << contents;
  };
  write(text);
  EXPECT_TRUE(is_trajectory_certificate(file));
  EXPECT_EQ(certificate_text(read_trajectory_certificates(file).front()), text);
  Random random(1);
  for (int i = 0; i < samples(300); ++i) {
    std::string damaged = text;
    const auto at = static_cast<std::size_t>(random.uniform(0, 1) * double(text.size()));
    if (i % 4 == 0) {
      damaged.resize(at);
    } else {
      damaged[at] ^= 4;
    }
    write(damaged);
    EXPECT_THROW(read_trajectory_certificates(file), std::invalid_argument);
  }
  EXPECT_FALSE(is_trajectory_certificate(folder.path() / "none"));
}

/// The efforts between edges by the formulas of `EffortLaw`, in ordinary arithmetic and with the
/// dynamics of `lib`: they balance the wrench, keep their limits, and change no faster than their
/// rates, at 25 times as many instants as there are edges. So do the commands of thrusters that
/// lag, on average between two of these instants.
TEST(VerifyTrajectory, EffortsKeepTheirLimitsAtManyInstants) {
  const int fine = 25;
  const std::pair<const Problem&, const TrajectoryCertificate&> proofs[] = {
      {turn(), turn_proof()},
      {held_impulse(), impulse_proof()},
      {fast_turn(), fast_turn_proof()},
      {lagged_impulse(), lagged_proof()}};
  for (const auto& [problem, proof] : proofs) {
    MotionEvaluator motion(problem, make_dense_spline(*problem.motion, proof.parts * fine));
    std::vector<Instant> instants;
    motion.evaluate(all_knots(*problem.motion, proof.knots), instants);
    const Zonotope& set = problem.robot.actuation;
    const int n = proof.parts;
    const auto spline = [&](const auto& row, int interval, double place) {
      const int edge = static_cast<int>(std::lround(place)), at = interval * n + edge;
      const double s = place - edge;
      if (edge == 0) return row[at] + s * (row[at + 1] - row[at]);
      if (edge == n) return row[at] + s * (row[at] - row[at - 1]);
      return (row[at - 1] + 6 * row[at] + row[at + 1]) / 8 + s * (row[at + 1] - row[at - 1]) / 2 +
             s * s * (row[at - 1] - 2 * row[at] + row[at + 1]) / 2;
    };
    Eigen::VectorXd before;
    for (std::size_t i = 0; i < instants.size(); ++i) {
      const int all = n * fine, whole = static_cast<int>(i);
      const int interval = std::min(whole / all, (static_cast<int>(instants.size()) - 2) / all);
      const double place = (whole - interval * all) / double(fine);
      Eigen::VectorXd y(set.actuators());
      for (Eigen::Index k = 0; k < y.size(); ++k) {
        y[k] = spline(Eigen::VectorXd(proof.y.row(k)), interval, place);
      }
      const bool varies = proof.w.size() > 0;
      const double w = varies ? spline(proof.w, interval, place) : proof.value;
      EXPECT_TRUE(problem.motion->impulse || w >= proof.value);
      const Eigen::VectorXd load = instants[i].tau_d + w * (instants[i].J.transpose() * problem.c);
      const Eigen::VectorXd u = y + set.B_pinv * (load - set.B * y);
      EXPECT_LT((set.B * u - load).cwiseAbs().maxCoeff(), 1e-9);
      EXPECT_GE((u - set.u_min).minCoeff(), -1e-9) << instants[i].t;
      EXPECT_LE((u - set.u_max).maxCoeff(), 1e-9) << instants[i].t;
      if (i > 0) {
        const Eigen::VectorXd rate = (u - before) / (instants[i].t - instants[i - 1].t);
        EXPECT_LE((rate.cwiseAbs() - problem.robot.u_rate_max).maxCoeff(), 1e-6) << instants[i].t;
        const Eigen::Index thrusters = 8;
        const Eigen::VectorXd command = (u + before) / 2 + problem.motion->thruster_lag * rate;
        EXPECT_GE((command - set.u_min).head(thrusters).minCoeff(), -1e-6) << instants[i].t;
        EXPECT_LE((command - set.u_max).head(thrusters).maxCoeff(), 1e-6) << instants[i].t;
      }
      before = u;
    }
  }
}

/// A pair of points, one on the tool's link and one fixed to the base, that meet at one instant.
/// They collide only within `reach` of each other.
class MeetingPoints : public CollisionChecker {
 public:
  MeetingPoints(int link, const Eigen::Vector3d& on_base, double reach)
      : link_(link), on_base_(on_base), reach_(reach) {}
  int colliding_pair(const std::vector<Pose<double>>& links) const override {
    return distance(links) < reach_ ? 0 : -1;
  }
  int pairs() const override { return 1; }
  bool nearest(const std::vector<Pose<double>>& links, int, ClosestPoints& near) const override {
    near = {distance(links) - reach_, link_, 0, links[std::size_t(link_)].p, on_base_};
    return true;
  }
  std::string pair_name(int) const override { return "tip and needle"; }
  bool inner_bodies(int, InnerBodyPair& pair) const override {
    pair.a.link = link_;
    pair.b.link = 0;
    pair.b.placement.p = on_base_;
    pair.reach = reach_;
    return true;
  }

 private:
  double distance(const std::vector<Pose<double>>& links) const {
    return (links[std::size_t(link_)].p - on_base_).norm();
  }
  int link_;
  Eigen::Vector3d on_base_;
  double reach_;
};

/// The last link's origin meets a needle at a time midway between sub-instants. At the sub-instants
/// before and after, it is farther away than the needle reaches.
TEST(VerifyTrajectory, FindsACollisionBetweenSamples) {
  Problem problem = turn();
  const TrajectoryModel model(problem, turn_proof().knots);
  const int interval = 3, link = static_cast<int>(problem.robot.links.size()) - 1;
  const double x = (11 + 0.5) / 25;
  const Eigen::Vector3d meets = model.links(interval, x)[std::size_t(link)].p;
  const double before = (model.links(interval, x - 0.5 / 25)[std::size_t(link)].p - meets).norm();
  const double after = (model.links(interval, x + 0.5 / 25)[std::size_t(link)].p - meets).norm();
  const double reach = 0.5 * std::min(before, after);
  ASSERT_GT(reach, 10 * 1e-5);
  const auto needle = std::make_shared<MeetingPoints>(link, meets, reach);
  problem.robot.collision = needle;
  for (int part = 0; part <= 25 * 9; ++part) {  // no sample sees it
    const int i = std::min(part / 25, 8);
    ASSERT_FALSE(needle->collides(model.links(i, part / 25.0 - i))) << part;
  }
  TrajectoryCertificate proof = turn_proof();
  proof.digest = motion_digest(problem);
  const TrajectoryVerification result = verify(problem, proof, 1);
  EXPECT_EQ(result.rejection.find("tip and needle"), 0u) << result.rejection;
  EXPECT_NEAR(result.t, model.time(interval, x), problem.motion->T / 9 / 25);
}

}  // namespace
}  // namespace maxwrench
