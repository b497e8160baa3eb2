#include <gtest/gtest.h>

#include "lib/scenario/scenario_list.h"
#include "maxwrench/batch.h"
#include "maxwrench/bound.h"
#include "maxwrench/certify.h"
#include "maxwrench/load.h"
#include "maxwrench/objective.h"
#include "solvers/solve/method.h"
#include "tests/support/boxes.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/list_tasks.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// The values of many postures of many boxes, none of which exceeds the bound of its box.
void expect_bounded(const std::string& name, Problem task, int boxes, int postures) {
  task.robot.collision = nullptr;
  const auto bound = make_capability_bound(task, "linf_polytope", Wrench::kPure);
  const auto objective =
      make_capability_objective(task, Wrench::kPure, resolve(task, Options()).make_measure);
  Random random(4);
  long valued = 0, tight = 0;
  for (int i = 0; i < boxes; ++i) {
    RandomBox box = random_box(task, random);
    const double low = evaluate_one(*objective, (box.lower + box.upper) / 2);
    BoxProof proof;
    bound->evaluate(box.lower, box.upper, std::isfinite(low) ? low : 0, bound->ceiling(), proof);
    // The multiplier of a box is valid for any part of it.
    BoxProof half = proof;
    Eigen::VectorXd upper = box.upper;
    upper[0] = (box.lower[0] + box.upper[0]) / 2;
    bound->evaluate(box.lower, upper, std::isfinite(low) ? low : 0, proof.high, half);
    for (int k = 0; k < postures; ++k) {
      for (Eigen::Index j = 0; j < box.lower.size(); ++j) {
        box.inside[j] = random.uniform(box.lower[j], box.upper[j]);
      }
      const double value = evaluate_one(*objective, box.inside);
      if (!std::isfinite(value)) continue;
      ++valued;
      const double slack = 1e-10 * (1 + std::abs(value));
      const double most =
          std::isfinite(low) ? std::max(proof.high, low) : std::max(proof.high, 0.0);
      ASSERT_LE(value, most + slack) << name << ", box " << i;
      if (value > 0.99 * most) ++tight;
      if (box.inside[0] > upper[0]) continue;
      const double half_most =
          std::isfinite(low) ? std::max(half.high, low) : std::max(half.high, 0.0);
      ASSERT_LE(value, half_most + slack) << name << ", half of box " << i;
    }
  }
  EXPECT_GT(valued, 0) << name;
  EXPECT_GT(tight, 0) << name;
}

TEST(ListBound, NoPostureExceedsIt) {
  for (const ListForm& form : list_forms()) {
    expect_bounded(form.name, scenario_task(form.wrench, form.tables), 40, 50);
  }
}

/// 100,000 postures of each form.
TEST(SLOW_ListBound, NoPostureOfManyExceedsIt) {
  for (const ListForm& form : list_forms()) {
    expect_bounded(form.name, scenario_task(form.wrench, form.tables), samples(1000), 100);
  }
}

/// tau_d and J'c of one scenario in long double, from a robot with its own masses.
struct ScenarioRowsOf {
  Problem task;
  MultiAffine rows;
  ScenarioRowsOf(Problem of, const Vector6d& c)
      : task(std::move(of)), rows((task.c = c, pure_rows(task))) {}
};

ScenarioRowsOf rows_of_part(const Problem& problem, const Eigen::VectorXd& part) {
  const ScenarioList& list = problem.scenarios;
  Problem one = problem;
  one.scenarios = {};
  Eigen::Index next = 2;
  for (const LoadGroup& group : list.loads) {
    for (const LinkLoad& change : group[static_cast<std::size_t>(part[next])].loads) {
      Link& link = one.robot.links[static_cast<std::size_t>(change.link)];
      const Eigen::Vector3d moment = link.mass * link.com + change.moment;
      link.mass += change.mass;
      link.com = moment / link.mass;
    }
    ++next;
  }
  Vector6d c = list.wrenches[static_cast<std::size_t>(part[0])].c;
  if (list.ball) {
    const Eigen::VectorXd z = part.segment(next, list.ball->E.cols());
    EXPECT_LE(z.norm(), 1);
    c += list.ball->radius * list.ball->E * z;
  }
  return {one, c};
}

/// U of a multiplier follows from its scenarios, each an ordinary task, at the corners of a box of
/// no size. So the blocks and their weights are right.
TEST(ListBound, IsThatOfItsScenarios) {
  for (const ListForm& form : list_forms()) {
    Problem task = scenario_task(form.wrench, form.tables);
    if (form.name == std::string("carried mass")) continue;  // the weight does not turn with a pose
    task.robot.collision = nullptr;
    const auto bound = make_capability_bound(task, "linf_polytope", Wrench::kPure);
    const ScenarioList& list = task.scenarios;
    const Eigen::Index n = task.robot.velocities();
    Eigen::Index keys = 2 + static_cast<Eigen::Index>(list.loads.size());
    if (list.ball) keys += list.ball->E.cols();
    Random random(5);
    for (int i = 0; i < samples(20); ++i) {
      const Eigen::VectorXd at = random_theta_r(task, random);
      BoxProof proof;
      bound->evaluate(at, at, 0, bound->ceiling(), proof);
      if (proof.kind != BoxProof::Kind::kMultiplier) continue;
      ASSERT_EQ(proof.multiplier.size() % (keys + n), 0);
      double s = 0, g = 0, h = 0;
      for (Eigen::Index from = 0; from < proof.multiplier.size(); from += keys + n) {
        const Eigen::VectorXd part = proof.multiplier.segment(from, keys);
        const Eigen::VectorXd lambda = proof.multiplier.segment(from + keys, n);
        const Zonotope& set = list.limits[static_cast<std::size_t>(part[1])].actuation;
        const Eigen::VectorXd slope = set.B.transpose() * lambda;
        for (Eigen::Index k = 0; k < slope.size(); ++k) {
          s += std::max(slope[k] * set.u_min[k], slope[k] * set.u_max[k]);
        }
        const ScenarioRowsOf own = rows_of_part(task, part);
        const Eigen::VectorXd rows = own.rows.evaluate(at);
        g += lambda.dot(rows.head(n));
        h += lambda.dot(rows.tail(n));
      }
      const double T = bound->ceiling();
      double U = s - g + std::max(T * (1 - h), 0.0);
      if (h > 0) U = std::min(U, (s - g) / h);
      EXPECT_GE(proof.high, U - 1e-9 * (1 + std::abs(U))) << form.name;
      EXPECT_LE(proof.high, U + 1e-5 * (1 + std::abs(U))) << form.name;  // the tolerance of ends
    }
  }
}

/// Joints that follow, and a base that only drives and turns. The value is the best over all IK
/// solutions.
TEST(ListBound, SLOW_SupportsDependentJoints) {
  Problem task = load_problem("mobile/push");
  ScenarioList& list = task.scenarios;
  list.wrenches = {{.name = "", .c = task.c}};
  list.limits = {{"", task.robot.actuation},
                 {"weaker", with_limits(task.robot.actuation, 0.9 * task.robot.actuation.u_min,
                                        0.9 * task.robot.actuation.u_max)}};
  list.unit = "N";
  Options options;
  options.budget = 4000;
  ProofOptions how;
  how.gap = kSanitized ? 5e-2 : 1e-2;
  how.seconds = 600;
  const Proof proof = certify(task, options, how);
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.str();
  // The same robot, always weaker.
  Problem weaker = load_problem("mobile/push");
  weaker.robot.actuation = list.limits[1].actuation;
  const Proof alone = certify(weaker, options, how);
  EXPECT_NEAR(proof.answer.beta(), alone.answer.beta(), how.gap * alone.answer.beta());
  EXPECT_LE(alone.answer.beta(), proof.bound);
  EXPECT_LE(proof.answer.beta(), alone.bound);
}

Proof proven_list(const std::string& wrench, const std::string& tables, double gap) {
  ProofOptions how;
  how.gap = gap;
  how.seconds = 300;
  return certify(scenario_task(wrench, tables), {}, how);
}

/// Values of an independent model, which proved the first to 0.1 %.
TEST(SLOW_ListBound, ProvesTheReferenceValues) {
  struct Reference {
    std::string wrench, tables;
    double best, gap;
  };
  const std::string parameters = kParameters, any = "[loss]\nany = 1\n";
  for (const Reference& each :
       {Reference{"set = [[0,0,0,0,0,1], [0,0,0,0,0,-1]]", "", 32.06824, 1e-3},
        Reference{kTurn, parameters, 35.0743, 1e-3}, Reference{kLift, parameters, 104.3809, 1e-3},
        Reference{kTurn, any, 19.0175, 1e-3}, Reference{kLift, any, 67.6647, 1e-3},
        Reference{kTurn, "[loss]\ncases = [['front_right_vertical']]\n", 24.8078, 1e-3},
        Reference{kLift, "[loss]\ncases = [['front_right_vertical']]\n", 102.0152, 1e-3},
        Reference{"ball = { axes = ['fx', 'fy'], radius = 1 }", "", 75.47647, 2e-3},
        Reference{"", "[payload]\ncom = [0.05, 0, 0.02]\nvolume_per_kg = 1.2738853503184714e-4\n",
                  11.85426, 1e-3}}) {
    const Proof proof = proven_list(each.wrench, each.tables, each.gap);
    EXPECT_EQ(proof.status, Status::kProven) << each.wrench << each.tables << proof.reason.str();
    EXPECT_GE(proof.bound, each.best * (1 - 1e-5)) << each.wrench << each.tables;
    EXPECT_GE(proof.answer.beta(), each.best * (1 - each.gap)) << each.wrench << each.tables;
    EXPECT_LE(proof.gap(), each.gap * 1.001);
  }
}

/// The proof is the same at any number of threads.
TEST(ListBound, DoesNotDependOnThreads) {
  const Problem task = scenario_task(kLift, "[loss]\nany = 1\n");
  ProofOptions how;
  how.gap = 1e-2;
  Options options;
  options.threads = 1;
  const Proof one = certify(task, options, how);
  options.threads = 3;
  const Proof three = certify(task, options, how);
  EXPECT_EQ(one.status, Status::kProven) << one.reason.str();
  EXPECT_EQ(one.boxes, three.boxes);
  EXPECT_EQ(one.bound, three.bound);
}

TEST(ListBound, RejectsWhatItCannotBound) {
  const auto line = [](const std::string& wrench, const std::string& tables, Wrench allowed) {
    const Problem task = scenario_task(wrench, tables);
    return rejection_of([&] { make_capability_bound(task, "linf_polytope", allowed); });
  };
  const std::string set = "set = [[1,0,0,0,0,0]]";
  EXPECT_EQ(line(set, "", Wrench::kAny), "accepted");
  Problem many = scenario_task(set, "");
  many.robot.actuation.has_facets = false;
  EXPECT_TRUE(rejection_of([&] {
                make_capability_bound(many, "linf_polytope", Wrench::kPure);
              }).starts_with("certify: got a list for actuators with too many facets"));
}

}  // namespace
}  // namespace maxwrench
