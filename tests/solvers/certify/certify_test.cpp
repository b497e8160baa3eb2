#include "solvers/certify/certify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/search/forwarding.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "tests/support/loops.h"
#include "tests/support/multimodal.h"
#include "tests/support/refusals.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// A problem, a measure and what a search of it found.
struct ProofCase {
  Problem problem;
  std::string measure;
  Wrench wrench;
  MeasureMaker make;

  ProofCase(const char* name, const char* of, Wrench allowed)
      : problem(load_problem(name)), measure(of), wrench(allowed) {
    make = [this] {
      const bool one = wrench == Wrench::kPure && !problem.contact;
      return find_measure(measure).make(problem,
                                        find_wrench_solver(one ? "facets" : "condensed").make());
    };
  }
  ProofCase(const ProofCase&) = delete;

  std::unique_ptr<Objective> objective() const {
    return make_capability_objective(problem, wrench, make);
  }
  Candidate searched() const {
    const auto f = objective();
    SearchOptions options;
    options.start = problem.theta_r_default;
    options.budget = 2000;
    const SearchResult found = find_search(general_search()).make()->maximize(*f, options);
    return {found.theta_r, found.value};
  }
  CertifyResult prove(const Candidate& incumbent, const CertifyOptions& options) const {
    const auto f = objective();
    return certify(*f, *make_capability_bound(problem, measure, wrench), incumbent, options);
  }
};

CertifyOptions to_gap(double gap) {
  CertifyOptions options;
  options.gap = gap;
  return options;
}

struct KnownOptimum {
  const char* problem;
  const char* measure;
  Wrench wrench;
  double beta;
  double gap;
  bool collision = true;
};

class Certified : public testing::TestWithParam<KnownOptimum> {};

/// Figures of another branch and bound, with other bounds.
INSTANTIATE_TEST_SUITE_P(
    Known, Certified,
    testing::Values(KnownOptimum{"planar/force", "linf_polytope", Wrench::kPure, 3.4775, 1e-4},
                    KnownOptimum{"planar/force", "linf_polytope", Wrench::kAny, 3.8806, 1e-4},
                    KnownOptimum{"planar/force", "ellipsoid", Wrench::kPure, 1.9075, 1e-4},
                    KnownOptimum{"uvms/lift", "linf_polytope", Wrench::kPure, 108.40954, 1e-3},
                    KnownOptimum{"uvms/valve", "linf_polytope", Wrench::kPure, 35.40830, 1e-2},
                    KnownOptimum{"uvms/lift", "linf_polytope", Wrench::kAny, 237.70153, 1e-3},
                    KnownOptimum{"uvms/valve", "linf_polytope", Wrench::kAny, 96.78678, 1e-3},
                    KnownOptimum{"uvms/lift", "ellipsoid", Wrench::kPure, 42.17966, 1e-2},
                    KnownOptimum{"uvms/valve", "ellipsoid", Wrench::kPure, 16.58489, 1e-2},
                    // The wheels, at 45 degrees to the push, give all they have.
                    KnownOptimum{"mobile/push_any_height", "linf_polytope", Wrench::kPure,
                                 4 * 135 / std::numbers::sqrt2, 1e-3},
                    KnownOptimum{"uvms/lift", "linf_polytope", Wrench::kPure, 127.79, 1e-3, false},
                    KnownOptimum{"uvms/valve", "linf_polytope", Wrench::kPure, 35.487, 1e-2,
                                 false}));

TEST_P(Certified, IsProven) {
  const KnownOptimum& known = GetParam();
  ProofCase at(known.problem, known.measure, known.wrench);
  if (!known.collision) at.problem.robot.collision = nullptr;
  const CertifyResult result = at.prove(at.searched(), to_gap(known.gap));
  EXPECT_EQ(result.status, Status::kProven) << result.reason.c_str();
  EXPECT_NEAR(result.best.value, known.beta, (1e-3 + known.gap) * known.beta);
  EXPECT_GE(result.bound, result.best.value);
  EXPECT_LE(result.bound, result.best.value * (1 + 1.000001 * known.gap));
  // A list of IK solutions that is continued from another place has other rounding.
  EXPECT_NEAR(at.objective()->evaluate(result.best.theta_r), result.best.value, 1e-12 * known.beta);
}

/// The L2 polytope lies in the L-infinity polytope.
TEST(Certify, OrdersTheMeasures) {
  ProofCase l2("planar/force", "l2_polytope", Wrench::kPure);
  const CertifyResult result = l2.prove(l2.searched(), to_gap(1e-4));
  EXPECT_EQ(result.status, Status::kProven);
  EXPECT_LE(result.best.value, 3.4775);
}

/// A function of no values, as of one that could not be improved.
class Frozen final : public ForwardingObjective {
 public:
  using ForwardingObjective::ForwardingObjective;
  double evaluate(const Eigen::VectorXd& /*x*/, Eigen::VectorXd* /*gradient*/) override {
    return -kInfinity;
  }
  std::unique_ptr<Objective> clone() const override {
    return std::make_unique<Frozen>(objective_->clone());
  }
};

TEST(Certify, DoesNotProveWhatIsOnePercentTooLow) {
  for (const char* measure : {"linf_polytope", "l2_polytope", "ellipsoid"}) {
    ProofCase at("planar/force", measure, Wrench::kPure);
    const Candidate best = at.searched();
    Frozen frozen(at.objective());
    const auto bound = make_capability_bound(at.problem, measure, Wrench::kPure);
    CertifyOptions options = to_gap(1e-3);
    options.boxes = 20000;
    const CertifyResult result =
        certify(frozen, *bound, {best.theta_r, 0.99 * best.value}, options);
    EXPECT_EQ(result.status, Status::kBracket);
    EXPECT_FALSE(result.reason.empty());
    EXPECT_GE(result.bound, best.value);
  }
}

/// The last one knows nothing at first, and finds it at centres of boxes.
TEST(Certify, FindsWhatItIsNotGiven) {
  ProofCase at("planar/force", "linf_polytope", Wrench::kPure);
  for (const Candidate& start : {Candidate{at.problem.theta_r_default, 0.1}, Candidate{}}) {
    const CertifyResult result = at.prove(start, to_gap(1e-2));
    EXPECT_EQ(result.status, Status::kProven);
    EXPECT_NEAR(result.best.value, 3.4775, 0.04);
    EXPECT_GE(result.bound, 3.4774);
  }
}

/// Where the incumbent is far below the best, centres of boxes and local searches from there lead
/// to it.
TEST(Certify, ImprovesAPoorIncumbent) {
  ProofCase at("uvms/lift", "linf_polytope", Wrench::kPure);
  const Eigen::VectorXd& start = at.problem.theta_r_default;
  const double value = at.objective()->evaluate(start);
  ASSERT_LT(value, 80);
  const CertifyResult result = at.prove({start, value}, to_gap(1e-3));
  EXPECT_EQ(result.status, Status::kProven) << result.reason.c_str();
  EXPECT_GE(result.best.value, 108.40954 * (1 - 1e-3));
  EXPECT_GE(result.bound, 108.40953);
}

bool is_inside(const CertifiedBox& box, const Eigen::VectorXd& x) {
  return (x.array() >= box.lower.array()).all() && (x.array() <= box.upper.array()).all();
}

/// 1,000 valid postures through a whole run: each lies in a box of the proof, none of which says
/// that it collides or is worse than it is.
TEST(Certify, HoldsForPosturesOneByOne) {
  ProofCase at("uvms/lift", "linf_polytope", Wrench::kPure);
  const auto objective = at.objective();
  std::vector<Candidate> postures;
  Random random(1);
  while (postures.size() < samples(1000)) {
    const Eigen::VectorXd theta_r = random_theta_r(at.problem, random);
    const double value = objective->evaluate(theta_r);
    if (value > -kInfinity) postures.push_back({theta_r, value});
  }
  std::vector<int> leaves(postures.size(), 0);
  CertifyOptions options = to_gap(1e-2);
  options.sink = [&](const CertifiedBox& box) {
    for (std::size_t i = 0; i < postures.size(); ++i) {
      if (!is_inside(box, postures[i].theta_r)) continue;
      EXPECT_NE(box.proof.kind, BoxProof::Kind::kCollision);
      EXPECT_LE(postures[i].value, std::max(box.low, box.proof.high));
      EXPECT_LE(postures[i].value, std::max(box.low, box.high));
      leaves[i] += box.cut_axis < 0 ? 1 : 0;
    }
  };
  const Candidate best = at.searched();
  const CertifyResult result = at.prove(best, options);
  EXPECT_EQ(result.status, Status::kProven);
  for (const int count : leaves) EXPECT_GE(count, 1);
  for (const Candidate& posture : postures) EXPECT_LE(posture.value, result.bound);
}

/// The same where joints follow: no IK solution of the postures is cut off from the boxes.
TEST(Certify, SLOW_HoldsForPosturesWhoseJointsFollow) {
  for (const char* name : {"mobile/push", "dual_arm/bar_wall"}) {
    ProofCase at(name, "linf_polytope", Wrench::kPure);
    PostureSource source(at.problem, at.measure);
    std::vector<ValuedPosture> postures;
    Random random(1);
    while (postures.size() < samples(1000)) {
      const ValuedPosture* const posture = source.draw(random);
      if (posture != nullptr) postures.push_back(*posture);
    }
    std::vector<int> leaves(postures.size(), 0);
    CertifyOptions options = to_gap(1e-4);
    options.sink = [&](const CertifiedBox& box) {
      for (std::size_t i = 0; i < postures.size(); ++i) {
        const Eigen::ArrayXd x = postures[i].x;
        if ((x < box.lower.array() - 1e-9).any() || (x > box.upper.array() + 1e-9).any()) continue;
        const double value = postures[i].value - 1e-8 * std::abs(postures[i].value);
        if (box.cut_axis < 0 && value <= std::max(box.low, box.proof.high)) ++leaves[i];
      }
    };
    const CertifyResult result = at.prove(at.searched(), options);
    EXPECT_EQ(result.status, Status::kProven) << name;
    for (const int count : leaves) EXPECT_GE(count, 1) << name;
    for (const ValuedPosture& posture : postures) EXPECT_LE(posture.value, result.bound) << name;
  }
}

/// Against all postures at points of a grid, in all IK solutions.
TEST(Certify, SLOW_IsNearTheBestOfAGrid) {
  for (const char* name : {"mobile/push", "dual_arm/bar_wall", "dual_arm/bar_alone"}) {
    ProofCase at(name, "linf_polytope", Wrench::kPure);
    const auto f = at.objective();
    const int points = 100;
    double best = -kInfinity;
    for (int i = 0; i <= points; ++i) {
      for (int j = 0; j <= points; ++j) {
        const Eigen::Array2d share(static_cast<double>(i) / points,
                                   static_cast<double>(j) / points);
        best = std::max(
            best, f->evaluate(f->lower().array() + share * (f->upper() - f->lower()).array()));
      }
    }
    const CertifyResult result = at.prove(at.searched(), to_gap(1e-3));
    EXPECT_EQ(result.status, Status::kProven) << name;
    EXPECT_GE(result.bound, best) << name;
    EXPECT_LE(result.best.value, best * 1.02) << name;
  }
}

/// What is cut is halved, what is not is proven, and the halves make up the whole.
TEST(Certify, HandsOverATree) {
  ProofCase at("planar/force", "ellipsoid", Wrench::kPure);
  double volume = 0, highest = -kInfinity;
  CertifyOptions options = to_gap(1e-3);
  options.sink = [&](const CertifiedBox& box) {
    if (box.cut_axis >= 0) return;
    highest = std::max(highest, std::max(box.low, box.proof.high));
    EXPECT_NE(box.proof.kind, BoxProof::Kind::kNone);
    volume += (box.upper - box.lower).prod();
  };
  const CertifyResult result = at.prove(at.searched(), options);
  EXPECT_LE(highest, result.bound);
  EXPECT_NEAR(volume, (at.problem.theta_r_max - at.problem.theta_r_min).prod(), 1e-9);
}

TEST(Certify, SLOW_IsTheSameAtAnyThreadCount) {
  for (const char* name : {"uvms/lift", "mobile/push"}) {
    ProofCase at(name, "linf_polytope", Wrench::kPure);
    const Candidate best = at.searched();
    std::vector<std::vector<double>> highs;
    for (const int threads : {1, 2, 8}) {
      CertifyOptions options = to_gap(1e-1);
      options.threads = threads;
      auto& of_run = highs.emplace_back();
      options.sink = [&](const CertifiedBox& box) {
        of_run.push_back(box.proof.high);
        of_run.push_back(box.lower.sum());
      };
      const CertifyResult result = at.prove(best, options);
      of_run.push_back(result.bound);
      of_run.push_back(static_cast<double>(result.boxes));
    }
    EXPECT_EQ(highs[0], highs[1]) << name;
    EXPECT_EQ(highs[0], highs[2]) << name;
  }
}

/// What is not finished is a true bound as well.
TEST(Certify, EndsEarlyWithABracket) {
  ProofCase at("uvms/valve", "linf_polytope", Wrench::kPure);
  const Candidate best = at.searched();
  CertifyOptions few = to_gap(1e-4), short_of_time = few, stopped = few;
  few.boxes = 500;
  short_of_time.seconds = 0;
  stopped.interrupted = [] { return true; };
  for (const auto& [options, reason] :
       {std::pair(few, "boxes"), {short_of_time, "time"}, {stopped, "interrupted"}}) {
    const CertifyResult result = at.prove(best, options);
    EXPECT_EQ(result.status, Status::kBracket);
    EXPECT_NE(result.reason.str().find(reason), std::string::npos) << result.reason.c_str();
    EXPECT_GT(result.bound, 1.001 * best.value);
    EXPECT_LE(result.boxes, 1000);
  }
}

/// Where no posture can do what is asked without help, the best value is negative.
TEST(Certify, ProvesWhatIsBelowZero) {
  const auto at = [](double x) { return Eigen::VectorXd::Constant(1, x).eval(); };
  const Multimodal multimodal = {at(-1), at(1), {at(0.3)}, -1};
  MultimodalObjective objective(multimodal);
  const CertifyResult result =
      certify(objective, MultimodalBound(multimodal), {at(-0.5), -1.8}, to_gap(1e-3));
  EXPECT_EQ(result.status, Status::kProven);
  EXPECT_GE(result.bound, -1);
  EXPECT_NEAR(result.best.value, -1, 1e-3);
}

TEST(Certify, RejectsOptionsOutOfRange) {
  ProofCase at("planar/force", "ellipsoid", Wrench::kPure);
  const auto rejected = [&](const char* key, const auto& spoil, double value = -kInfinity) {
    CertifyOptions options = to_gap(1e-3);
    spoil(options);
    expect_rejected(key, [&] { at.prove({at.problem.theta_r_default, value}, options); });
  };
  for (const double gap : {1e-9, -1.0, kInfinity, std::nan("")}) {
    rejected("gap", [&](CertifyOptions& options) { options.gap = gap; });
  }
  for (const double seconds : {-1.0, -kInfinity, std::nan("")}) {
    rejected("seconds", [&](CertifyOptions& options) { options.seconds = seconds; });
  }
  rejected("boxes", [](CertifyOptions& options) { options.boxes = 0; });
  rejected("threads", [](CertifyOptions& options) { options.threads = 0; });
  rejected("threads", [](CertifyOptions& options) { options.threads = 1025; });
  rejected(
      "incumbent", [](CertifyOptions&) {}, std::nan(""));
}

}  // namespace
}  // namespace maxwrench
