#include "verify/verify.h"

#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "solvers/certify/certify.h"
#include "solvers/certify/proof_recorder.h"
#include "solvers/solve/method.h"
#include "tests/support/contacts.h"
#include "tests/support/support.h"
#include "tests/support/written_proof.h"
#include "verify/coordinates.h"

namespace maxwrench {
namespace {

struct Shipped {
  const char* problem;
  const char* measure;
  Wrench wrench;
  double gap;
};

class VerifyShipped : public testing::TestWithParam<Shipped> {};

/// The problem with four joints at a gap that takes no second.
INSTANTIATE_TEST_SUITE_P(
    Static, VerifyShipped,
    testing::Values(Shipped{"planar/force", "linf_polytope", Wrench::kPure, 1e-4},
                    Shipped{"planar/force", "linf_polytope", Wrench::kAny, 1e-4},
                    Shipped{"planar/force", "l2_polytope", Wrench::kPure, 1e-4},
                    Shipped{"planar/force", "ellipsoid", Wrench::kPure, 1e-4},
                    Shipped{"uvms/lift", "linf_polytope", Wrench::kPure, 1e-2},
                    Shipped{"uvms/lift", "linf_polytope", Wrench::kAny, 1e-2},
                    Shipped{"mobile/push", "linf_polytope", Wrench::kPure, 1e-3},
                    Shipped{"mobile/push", "l2_polytope", Wrench::kPure, 1e-2},
                    Shipped{"mobile/push", "ellipsoid", Wrench::kPure, 1e-2},
                    Shipped{"mobile/push_any_height", "linf_polytope", Wrench::kPure, 1e-2},
                    Shipped{"dual_arm/bar_alone", "linf_polytope", Wrench::kPure, 1e-3},
                    Shipped{"dual_arm/bar_wall", "linf_polytope", Wrench::kPure, 1e-3},
                    Shipped{"dual_arm/bar_wall", "l2_polytope", Wrench::kPure, 1e-3},
                    Shipped{"planar/two_arms", "linf_polytope", Wrench::kPure, 1e-2},
                    Shipped{"mobile/push", "linf_polytope", Wrench::kAny, 1e-1}));
// Many boxes, some of which only the equations exclude.
INSTANTIATE_TEST_SUITE_P(
    SLOW_Static, VerifyShipped,
    testing::Values(Shipped{"gallery/gen3/lift", "linf_polytope", Wrench::kPure, 3e-1},
                    Shipped{"fixed/push", "linf_polytope", Wrench::kPure, 1e-1},
                    Shipped{"fixed/push", "linf_polytope", Wrench::kAny, 1e-1}));

TEST_P(VerifyShipped, IsVerifiedAtAnyThreadCount) {
  const Shipped& shipped = GetParam();
  const WrittenProof at(shipped.problem, shipped.measure, shipped.wrench, shipped.gap);
  for (const int threads : {1, 3}) {
    if (kSanitized && threads == 1) continue;
    const Verification result = verify(at.problem, at.proof, threads);
    EXPECT_EQ(result.rejection, "");
    // `certify` begins with no less, and not with much more.
    const double ceiling =
        make_capability_bound(at.problem, shipped.measure, shipped.wrench)->ceiling();
    EXPECT_TRUE(ceiling == result.ceiling ||
                (ceiling >= result.ceiling && ceiling <= 1.001 * result.ceiling))
        << ceiling << ' ' << result.ceiling;
    EXPECT_EQ(result.boxes, static_cast<long>(at.proof.tree.nodes.size()));
    const long leaves =
        result.by_multiplier + result.by_collision + result.by_equations + result.by_parent;
    EXPECT_EQ(2 * leaves, result.boxes + 1);  // of a tree in which each other box has two parts
  }
}

/// A bound of a wrench along c alone is none of those with free components.
TEST(Verify, RejectsABoundOfPureWrenchesAsOneOfAny) {
  WrittenProof at("mobile/push", "linf_polytope", Wrench::kPure, 1e-2);
  at.proof.wrench = Wrench::kAny;
  EXPECT_NE(at.rejection(at.proof), "");
}

/// The bound of any wrenches has the rows of all joints.
TEST(Verify, RejectsAnyWrenchesWithoutAJointAboutTheYaw) {
  WrittenProof at("mobile/push", "linf_polytope", Wrench::kAny, 2e-1);
  ASSERT_GE(joint_about_yaw(at.problem), 0);
  at.proof.without_yaw_joint = true;
  EXPECT_NE(at.rejection(at.proof).find("leaves out a joint"), std::string::npos);
}

/// Without other components than c, any wrench is a multiple of it.
TEST(Verify, AcceptsAnyWrenchesAlongOneDirection) {
  Problem problem = load_problem("mobile/push");
  problem.W_any = problem.c;
  const WrittenProof at(problem, "mobile/push", "linf_polytope", Wrench::kAny, 1e-2);
  EXPECT_EQ(at.rejection(at.proof), "");
}

/// Where the boxes ran out the claim is smaller, and as true.
TEST(Verify, AcceptsABracket) {
  const WrittenProof at("uvms/lift", "linf_polytope", Wrench::kPure, 1e-3, 500);
  EXPECT_GT(at.proof.gap, 1e-3);
  EXPECT_EQ(at.rejection(at.proof), "");
}

/// A vehicle without an arm: one posture, and a box of no side.
TEST(Verify, AcceptsAProofWithoutCoordinates) {
  Random random(3);
  const Problem problem = random_problem(random, 0);
  for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
    const auto bound = make_capability_bound(problem, "linf_polytope", wrench);
    Case c;
    c.problem = "random";
    c.wrench = wrench;
    c.search = "";
    const Answer row = evaluate(problem, problem.theta_r_default, {c});
    ASSERT_TRUE(row.has_value());
    ProofRecorder recorder;
    CertifiedBox root;
    root.low = row.capability.beta * (1 + 1e-6);
    root.high = bound->ceiling();
    bound->evaluate(root.lower, root.upper, root.low, root.high, root.proof);
    recorder.add(root);
    CertifyResult result;
    result.bound = std::max(root.low, root.proof.high);
    EXPECT_EQ(verify(problem, recorder.certificate(row, result.bound, 1e-3), 1).rejection, "");
  }
}

using Tree = CertificateTree;

/// The end of the part of the tree that begins with a node.
std::size_t end_of(const Tree& tree, std::size_t node) {
  std::size_t open = 1;
  for (; open > 0; ++node) open += tree.nodes[node].axis < 0 ? std::size_t(-1) : 1;
  return node;
}

/// Proofs that have become false, each in its own way.
class Tampering {
 public:
  Tampering(const WrittenProof& at, std::uint64_t seed) : at_(at), random_(seed) {}

  static constexpr int kWays = 9;
  ProofCertificate next(int way) {
    ProofCertificate proof = at_.proof;
    Tree& tree = proof.tree;
    const std::size_t leaf = draw(tree, true);
    const auto place = tree.nodes.begin() + static_cast<std::ptrdiff_t>(leaf);
    if (way == 0) tree.nodes.erase(place);           // dropped
    if (way == 1) tree.nodes.insert(place, *place);  // there twice
    if (way == 2) drop_halves(tree);
    if (way == 3) tree.nodes[leaf] = other_reason(tree.nodes[leaf]);
    if (way == 4) spoil_multiplier(proof);
    const double share = std::pow(10, random_.uniform(-5, -0.5));
    if (way == 5) proof.value += share * std::abs(proof.value);  // the incumbent raised
    if (way == 6) proof.bound = proof.value - share * std::abs(proof.value);
    if (way == 7) shrink_root(proof, share);
    if (way == 8) {  // a box that is cut is said to collide
      Tree::Node& cut = tree.nodes[draw(tree, false)];
      cut.reason = Tree::Reason::kCollision;
      cut.pair = -1;
    }
    return proof;
  }

 private:
  std::size_t draw(const Tree& tree, bool leaf) {
    for (;;) {
      const double at = random_.uniform(0, 1) * static_cast<double>(tree.nodes.size());
      const auto node = static_cast<std::size_t>(at);
      if ((tree.nodes[node].axis < 0) == leaf) return node;
    }
  }
  /// A box that had to be cut becomes a leaf.
  void drop_halves(Tree& tree) {
    const std::size_t node = draw(tree, false);
    const auto begin = tree.nodes.begin() + static_cast<std::ptrdiff_t>(node);
    tree.nodes.erase(begin + 1,
                     tree.nodes.begin() + static_cast<std::ptrdiff_t>(end_of(tree, node)));
    tree.nodes[node].axis = -1;
  }
  /// No box of a proof collides if its multiplier was needed, or the other way round.
  Tree::Node other_reason(Tree::Node node) {
    const bool collides = node.reason == Tree::Reason::kCollision;
    node.reason = collides ? Tree::Reason::kNone : Tree::Reason::kCollision;
    node.pair = static_cast<int>(random_.uniform(-1, 30));
    return node;
  }
  /// Nothing follows from zero but what was known, and from the opposite nothing of use.
  void spoil_multiplier(ProofCertificate& proof) {
    Tree& tree = proof.tree;
    for (;;) {
      const Tree::Node& node = tree.nodes[draw(tree, true)];
      if (tree.numbers(node) == 0) continue;
      const double factor = -random_.uniform(0, 1);
      for (std::size_t i = 0; i < tree.numbers(node); ++i) {
        tree.multipliers[node.multiplier + i] *= factor;
      }
      return;
    }
  }
  void shrink_root(ProofCertificate& proof, double share) {
    const auto axis =
        static_cast<Eigen::Index>(random_.uniform(0, 1) * static_cast<double>(proof.lower.size()));
    proof.lower[axis] += share * (proof.upper[axis] - proof.lower[axis]);
  }

  const WrittenProof& at_;
  Random random_;
};

/// 680 in all, on seven problems. None of them goes through a file, so no checksum helps.
TEST(Verify, RejectsFalseProofs) {
  const auto reject_all = [](const WrittenProof& at, int count) {
    ASSERT_EQ(at.rejection(at.proof), "");
    Tampering tampering(at, 7);
    for (int i = 0; i < count; ++i) {
      const int way = i % Tampering::kWays;
      EXPECT_NE(at.rejection(tampering.next(way)), "") << "way " << way << ", tampering " << i;
    }
  };
  reject_all({"planar/force", "linf_polytope", Wrench::kPure, 1e-3}, samples(200));
  reject_all({"planar/force", "ellipsoid", Wrench::kPure, 1e-2}, samples(200));
  reject_all({"mobile/push", "linf_polytope", Wrench::kPure, 1e-2}, samples(80));
  reject_all({"uvms/lift", "linf_polytope", Wrench::kPure, 1e-1}, samples(40));
  reject_all({"dual_arm/bar_wall", "linf_polytope", Wrench::kPure, 1e-2}, samples(80));
  reject_all({"mobile/push", "linf_polytope", Wrench::kAny, 2e-1}, samples(40));
  reject_all(
      {two_arms_about_the_best(0.02), "dual_arm/two_arms", "linf_polytope", Wrench::kPure, 1e-2},
      samples(40));
}

/// What compares with nothing, or overflows, proves nothing.
TEST(Verify, RejectsWhatIsNoNumber) {
  const WrittenProof at("planar/force", "linf_polytope", Wrench::kPure, 1e-3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double x : {nan, kInfinity, -kInfinity, 1e300}) {
    std::vector<ProofCertificate> bad(7, at.proof);
    for (double& each : bad[0].tree.multipliers) each = x;
    bad[1].bound = x;
    bad[2].value = x;
    bad[3].lower[0] = std::isnan(x) ? x : std::abs(x);
    bad[4].x[0] = x;
    bad[5].u[0] = x;
    bad[6].upper[0] = std::isnan(x) ? x : -std::abs(x);
    for (const ProofCertificate& each : bad) EXPECT_NE(at.rejection(each), "") << x;
  }
  ProofCertificate narrow = at.proof;
  narrow.tree.width = 0;
  narrow.tree.multipliers.clear();
  EXPECT_NE(at.rejection(narrow), "");
}

/// Cut after cut off one corner, a tree as deep as its file is long; no leaf of it has anything to
/// prove.
TEST(Verify, RejectsTreesWithoutEnd) {
  const WrittenProof at("planar/force", "linf_polytope", Wrench::kPure, 1e-3);
  ProofCertificate deep = at.proof;
  deep.bound = 1e30;
  deep.gap = 1e40;
  constexpr std::size_t kCuts = 100000;
  Tree::Node cut;
  cut.axis = 1;
  deep.tree.nodes.assign(kCuts, cut);
  deep.tree.nodes.resize(2 * kCuts + 1);
  EXPECT_NE(at.rejection(deep).find("too narrow to be cut"), std::string::npos);
}

TEST(Verify, RejectsOtherRulesOfCollision) {
  const WrittenProof at("planar/force", "linf_polytope", Wrench::kPure, 1e-3);
  ProofCertificate other = at.proof;
  other.collision = false;
  EXPECT_NE(at.rejection(other), "");
}

/// Ten percent more of all efforts reach more, so the old bound is false, whatever the digest says.
TEST(Verify, RejectsStrongerRobots) {
  WrittenProof at("planar/force", "linf_polytope", Wrench::kPure, 1e-3);
  at.problem.robot.actuation.u_max *= 1.1;
  at.problem.robot.actuation.u_min *= 1.1;
  EXPECT_NE(at.rejection(at.proof).find("another robot or task"), std::string::npos);
  at.proof.digest = digest(at.problem);
  EXPECT_NE(at.rejection(at.proof).find("not excluded"), std::string::npos);
}

/// The value of a posture that is off by what is tolerated, above the bound of all.
TEST(Verify, RejectsABoundBelowItsValue) {
  const WrittenProof at("planar/force", "linf_polytope", Wrench::kPure, 1e-3);
  ProofCertificate below = at.proof;
  below.value = std::nextafter(below.bound, kInfinity);
  EXPECT_NE(at.rejection(below).find("below its value"), std::string::npos);
}

/// Postures up to the tolerance of limits count, and each needs its box.
TEST(Verify, RejectsARootThatLeavesOutALimit) {
  for (const char* name : {"planar/force", "dual_arm/bar_alone"}) {
    const WrittenProof at(name, "linf_polytope", Wrench::kPure, 1e-2);
    for (Eigen::Index i = 0; i < at.proof.lower.size(); ++i) {
      if (at.proof.upper[i] - at.proof.lower[i] > 6) continue;  // a whole turn
      ProofCertificate less = at.proof;
      less.lower[i] += 2e-13;
      EXPECT_NE(at.rejection(less).find("does not contain the limits"), std::string::npos);
      less = at.proof;
      less.upper[i] -= 2e-13;
      EXPECT_NE(at.rejection(less).find("does not contain the limits"), std::string::npos);
    }
  }
}

/// A cut elsewhere than at the middle must be within the box.
TEST(Verify, RejectsOtherCuts) {
  const WrittenProof at("mobile/push", "linf_polytope", Wrench::kPure, 1e-2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const int enough = std::max(2, samples(10));
  int seen = 0;
  for (std::size_t i = 0; i < at.proof.tree.nodes.size() && seen < enough; ++i) {
    const Tree::Node& node = at.proof.tree.nodes[i];
    if (!node.at) continue;
    ++seen;
    for (const double x : {nan, 1e9, -1e9}) {
      ProofCertificate other = at.proof;
      other.tree.nodes[i].at = x;
      EXPECT_NE(at.rejection(other), "") << x;
    }
  }
  EXPECT_EQ(seen, enough);
}

TEST(Verify, RejectsOtherTasks) {
  WrittenProof at("planar/force", "linf_polytope", Wrench::kPure, 1e-3);
  at.problem = load_problem("uvms/lift");
  EXPECT_NE(at.rejection(at.proof), "");
  at.proof.digest = digest(at.problem);
  EXPECT_NE(at.rejection(at.proof), "");
}

}  // namespace
}  // namespace maxwrench
