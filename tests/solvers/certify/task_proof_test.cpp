#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <regex>
#include <string>

#include "maxwrench/certify.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/contacts.h"
#include "tests/support/refusals.h"
#include "tests/support/snake.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

Options of_ellipsoid(int threads = 0) {
  Options options;
  options.measure = "ellipsoid";
  options.threads = threads;
  return options;
}

ProofOptions to(double gap, bool keep_certificate = false) {
  ProofOptions how;
  how.gap = gap;
  how.keep_certificate = keep_certificate;
  return how;
}

/// A certificate in a file.
class Written {
 public:
  explicit Written(const std::string& text) { std::ofstream(file(), std::ios::binary) << text; }
  std::filesystem::path file() const { return folder_.path() / "task.proof"; }

 private:
  TemporaryFolder folder_;
};

Problem from_files(const std::string& name) { return load_problem(name); }

/// The paper's optimum, 1.9075 N.
TEST(CertifyTask, ProvesTheOptimum) {
  const Problem task = load_problem("planar/force");
  ProofOptions how = to(1e-4);
  long calls = 0;
  how.progress = [&](double bound, double value) {
    ++calls;
    EXPECT_GE(bound, value);
  };
  const Proof proof = certify(task, of_ellipsoid(), how);
  EXPECT_EQ(proof.status, Status::kProven);
  EXPECT_TRUE(proof.reason.empty());
  EXPECT_NEAR(proof.answer.beta(), 1.9075, 1e-3);
  EXPECT_GE(proof.bound, proof.answer.beta());
  EXPECT_LE(proof.gap(), 1.0001e-4);
  EXPECT_NEAR(proof.gap() * proof.answer.beta(), proof.bound - proof.answer.beta(), 1e-12);
  EXPECT_EQ(proof.answer.status, Status::kBestFound);
  EXPECT_EQ(proof.search, default_search(task, "ellipsoid"));
  EXPECT_GT(proof.boxes, 10);
  EXPECT_GT(calls, 0);
  EXPECT_GT(proof.search_s, 0);
  EXPECT_TRUE(proof.certificate.empty());
}

/// One evaluation finds next to nothing: the better points come from the bounds.
TEST(CertifyTask, ABetterPointIsStillWhatWasFound) {
  const Problem task = load_problem("planar/force");
  Options options = of_ellipsoid();
  options.search = "sample";
  options.budget = 1;
  const Answer alone = solve(task, options);
  const Proof proof = certify(task, options, to(1e-3));
  EXPECT_EQ(proof.status, Status::kProven);
  EXPECT_NEAR(proof.answer.beta(), 1.9075, 3e-3);
  EXPECT_GT(proof.answer.beta(), alone.beta());
  EXPECT_EQ(proof.answer.status, Status::kBestFound);
  EXPECT_EQ(proof.answer.choice.search, "sample");
  EXPECT_EQ(proof.answer.evaluations, 1);
  EXPECT_EQ(proof.answer.beta(), evaluate(task, proof.answer.posture.theta_r, options).beta());
}

TEST(CertifyTask, WritesACertificateThatIsVerified) {
  const Problem task = load_problem("planar/force");
  const Proof proof = certify(task, of_ellipsoid(1), to(1e-4, true));
  EXPECT_EQ(certify(task, of_ellipsoid(4), to(1e-4, true)).certificate, proof.certificate);
  const Written written(proof.certificate);
  for (const int threads : {0, 3}) {
    const VerifiedProof verified = verify_certificate(written.file(), from_files, threads);
    EXPECT_TRUE(verified.verified()) << verified.rejection;
    EXPECT_EQ(verified.problem, "planar/force");
    EXPECT_EQ(verified.measure, "ellipsoid");
    EXPECT_EQ(verified.wrench, Wrench::kPure);
    EXPECT_TRUE(verified.collision);
    EXPECT_EQ(verified.unit, "N");
    EXPECT_EQ(verified.theta_r, proof.answer.posture.theta_r);
    EXPECT_EQ(verified.value, proof.answer.beta());
    EXPECT_EQ(verified.bound, proof.bound);
    EXPECT_EQ(verified.gap(), proof.gap());
    EXPECT_GT(verified.by_multiplier, 0);
    const long leaves =
        verified.by_multiplier + verified.by_collision + verified.by_equations + verified.by_parent;
    EXPECT_EQ(2 * leaves, verified.boxes + 1);  // a binary tree
  }
  // It proves nothing of another task.
  EXPECT_FALSE(verify_certificate(written.file(), [](const std::string&) {
                 return load_problem("mobile/push");
               }).verified());
  expect_rejected("threads", [&] { verify_certificate(written.file(), from_files, -1); });
}

TEST(CertifyTask, IsVerifiedWithoutCollisionsAndWithoutFiles) {
  Problem task = load_problem("planar/force");
  task.name = "made in code";
  task.robot.collision = nullptr;
  const Proof proof = certify(task, of_ellipsoid(), to(1e-2, true));
  EXPECT_EQ(proof.colliding, 0);
  const Written written(proof.certificate);
  std::string asked;
  const VerifiedProof verified = verify_certificate(written.file(), [&](const std::string& name) {
    asked = name;
    return task;
  });
  EXPECT_TRUE(verified.verified()) << verified.rejection;
  EXPECT_FALSE(verified.collision);
  EXPECT_EQ(asked, "made in code");
}

TEST(CertifyTask, RejectsDamagedCertificates) {
  std::string text =
      certify(load_problem("planar/force"), of_ellipsoid(), to(1e-2, true)).certificate;
  text[text.size() / 2] ^= 1;
  for (const std::string& bad :
       {text, text.substr(0, 30), std::string(), std::string("no proof")}) {
    const Written written(bad);
    EXPECT_THROW(verify_certificate(written.file(), from_files), std::invalid_argument);
  }
  EXPECT_THROW(verify_certificate("/no/such/file", from_files), std::invalid_argument);
}

TEST(CertifyTask, GivesABracketWithoutTime) {
  ProofOptions how = to(1e-6, true);
  how.seconds = 0;
  const Proof proof = certify(load_problem("planar/force"), of_ellipsoid(), how);
  EXPECT_EQ(proof.status, Status::kBracket);
  EXPECT_EQ(proof.reason.str(), "the time ran out");
  EXPECT_GT(proof.gap(), 1e-6);
  // The smaller claim is as true.
  const Written written(proof.certificate);
  const VerifiedProof verified = verify_certificate(written.file(), from_files);
  EXPECT_TRUE(verified.verified()) << verified.rejection;
}

TEST(CertifyTask, EndsWhenItIsInterrupted) {
  for (const bool at_once : {true, false}) {
    bool proving = at_once;
    Options options = of_ellipsoid();
    options.interrupted = [&proving] { return proving; };
    ProofOptions how = to(1e-7);
    how.progress = [&proving](double, double) { proving = true; };
    const Proof proof = certify(load_problem("planar/force"), options, how);
    EXPECT_EQ(proof.status, Status::kBracket);
    EXPECT_EQ(proof.reason.str(), "interrupted");
    EXPECT_EQ(proof.answer.has_value(), !at_once);
    EXPECT_EQ(std::isfinite(proof.gap()), !at_once);
  }
}

/// Arms that are too weak to hold themselves up.
TEST(CertifyTask, ProvesThatNothingHasAValue) {
  const Snake snake(2);
  const std::string urdf = snake.path() / "robot.urdf";
  const std::string text = read_text(urdf);
  std::ofstream(urdf) << std::regex_replace(text, std::regex("effort=\"9\""), "effort=\"0.001\"");
  const Proof proof = certify(load_problem(snake.task()), {}, to(1e-3, true));
  EXPECT_EQ(proof.status, Status::kProven);
  EXPECT_EQ(proof.reason.str(), "no posture has a value");
  EXPECT_FALSE(proof.answer.has_value());
  EXPECT_EQ(proof.gap(), kInfinity);
  EXPECT_TRUE(proof.certificate.empty());
}

/// The vehicle floats over the plane, and its vertical thruster carries less than its 10.2 kg: so
/// something must hold the end effector up. c leans by 0.06, which the horizontal thrusters can
/// balance in some postures. There the vertical balance gives the value:
/// beta c_z = 60 N - 10.2 kg g.
TEST(CertifyTask, ProvesNegativeValues) {
  Robot robot = vehicle();
  robot.base_axes = {0, 1, 2, 5};
  robot.thrusters.push_back({"up", {0, 0, 0}, {0, 0, 1}, -5, 60});
  TaskSpec spec = push(finalize(robot, vehicle_shapes()));
  spec.c << 0.06, 0, 1, 0, 0, 0;
  spec.any.reset();
  const Problem task = make_problem(spec);
  const Proof proof = certify(task, {}, to(1e-3, true));
  ASSERT_TRUE(proof.answer.has_value()) << proof.answer.reason.c_str();
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.c_str();
  const double expected = (60 - 10.2 * robot.gravity) * std::hypot(0.06, 1.0);
  EXPECT_NEAR(proof.answer.beta(), expected, 1e-9);
  EXPECT_GE(proof.bound, proof.answer.beta());
  EXPECT_LE(proof.gap(), 1.0001e-3);
  const Written written(proof.certificate);
  const VerifiedProof verified =
      verify_certificate(written.file(), [&task](const std::string&) { return task; });
  EXPECT_TRUE(verified.verified()) << verified.rejection;
  EXPECT_EQ(verified.gap(), proof.gap());
}

/// Without any effort a vehicle in balance holds still and exerts nothing.
TEST(CertifyTask, BoundsAValueOfZero) {
  Robot robot = vehicle();
  for (Thruster& thruster : robot.thrusters) thruster.force_min = thruster.force_max = 0;
  for (Joint& joint : robot.joints) joint.effort_max = 0;
  const Problem task = make_problem(push(finalize(robot, vehicle_shapes())));
  ProofOptions how = to(1e-3);
  how.seconds = 2;
  const Proof proof = certify(task, {}, how);
  ASSERT_TRUE(proof.answer.has_value()) << proof.answer.reason.c_str();
  EXPECT_EQ(proof.answer.beta(), 0);
  EXPECT_GE(proof.bound, 0);
  EXPECT_LT(proof.bound, 1e-6);
  EXPECT_EQ(proof.status == Status::kProven, proof.bound == 0) << proof.reason.c_str();
  EXPECT_EQ(proof.gap(), proof.bound > 0 ? kInfinity : 0);
}

/// The base determines all three forces of the second contact.
TEST(CertifyTask, ProvesTwoArmsThatBothExertForces) {
  const Problem task = two_arms_about_the_best(kSanitized ? 0.02 : 0.1);
  ProofOptions how = to(5e-3);
  how.seconds = 300;
  const Proof proof = certify(task, Options(), how);
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  EXPECT_GE(proof.bound, kBestOfTwoArms);
  EXPECT_LE(proof.bound, (kBestOfTwoArms + 1e-4) * 1.005);
}

TEST(CertifyTask, SaysWhichContactsHaveNoCertificate) {
  Problem task = load_problem("dual_arm/bar_wall");
  EXPECT_EQ(why_no_certificate(task), "");
  task.scenarios.wrenches = {{"one", task.c}, {"other", -task.c}};
  EXPECT_EQ(why_no_certificate(task), "a list with forces of a second contact");
}

TEST(CertifyTask, RejectsBadOptions) {
  const Problem task = load_problem("planar/force");
  // Before the search, which would count evaluations.
  Options options = of_ellipsoid();
  options.progress = [](long) { ADD_FAILURE() << "searches"; };
  for (const double bad : {std::nan(""), 0.0, -1.0, 1e-9, kInfinity}) {
    expect_rejected("gap", [&] { certify(task, options, to(bad)); });
  }
  for (const double bad : {std::nan(""), -1.0}) {
    ProofOptions how;
    how.seconds = bad;
    expect_rejected("seconds", [&] { certify(task, options, how); });
  }
  Problem list = load_problem("dual_arm/bar_wall");
  list.scenarios.wrenches = {{"one", list.c}, {"other", -list.c}};
  expect_rejected("keep_certificate", [&list] { certify(list, {}, to(1e-3, true)); });
  options.threads = -1;
  expect_rejected("threads", [&] { certify(task, options); });
  options = of_ellipsoid();
  options.solver = "magic";
  expect_rejected("solver", [&] { certify(task, options); });
  options = of_ellipsoid();
  options.measure = "manipulability";
  expect_rejected("measure", [&] { certify(task, options); });
  EXPECT_THROW(certify(load_problem("planar/trajectory")), std::invalid_argument);
  add_measure({"own_unbounded", "", false, false, nullptr,
               [](const Problem& problem, auto) { return make_ellipsoid(problem.robot); }});
  options.measure = "own_unbounded";
  expect_rejected("measure", [&] { certify(task, options); });
}

}  // namespace
}  // namespace maxwrench
