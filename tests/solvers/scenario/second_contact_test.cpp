#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "maxwrench/sensitivity.h"
#include "maxwrench/solve.h"
#include "tests/solvers/scenario/gradients.h"
#include "tests/solvers/scenario/ordinary_tasks.h"
#include "tests/support/contacts.h"
#include "tests/support/no_allocations.h"
#include "tests/support/scenario_task.h"

namespace maxwrench {
namespace {

/// All thrusters and joints with shares of their limits.
Problem weaker(Problem task, double thrust, double torque) {
  const Zonotope& set = task.robot.actuation;
  Eigen::VectorXd share = Eigen::VectorXd::Constant(set.actuators(), torque);
  share.head(static_cast<Eigen::Index>(task.robot.thrusters.size())).setConstant(thrust);
  task.robot.actuation = make_zonotope(set.B, set.u_min.cwiseProduct(share).eval(),
                                       set.u_max.cwiseProduct(share).eval());
  return task;
}

/// A body that is heavier by `more` at its centre of mass.
Problem heavier(Problem task, const std::string& body, double more) {
  for (const BodyPart& part : task.robot.parts) {
    if (part.name != body) continue;
    Link& link = task.robot.links[static_cast<std::size_t>(part.link)];
    const Eigen::Vector3d com = part.frame.R * part.com + part.frame.p;
    link.com = (link.mass * link.com + more * com) / (link.mass + more);
    link.mass += more;
    return task;
  }
  ADD_FAILURE() << body;
  return task;
}

Problem trimmed(Problem task, double more) {
  task.robot.trim.buoyancy_mass += more;
  return task;
}

std::vector<OrdinaryTask> two_wrenches(const Problem& plain) {
  Vector6d first = Vector6d::Unit(5), second;
  second << 5, 0, 0, 0, 0, -2;
  return {{along_c(plain, first), 1}, {along_c(plain, second), second.norm()}};
}

std::vector<OrdinaryTask> corners(const Problem& plain) {
  std::vector<OrdinaryTask> all;
  for (const double hull : {0.2, -0.2}) {
    for (const double tool : {0.1, -0.1}) {
      for (const double trim : {0.3, -0.3}) {
        const Problem loaded = heavier(heavier(plain, "right_link_4", tool), "vehicle", hull);
        all.push_back({weaker(trimmed(loaded, trim), 0.9, 0.95)});
      }
    }
  }
  return all;
}

std::vector<OrdinaryTask> corners_and_losses(const Problem& plain) {
  std::vector<OrdinaryTask> all;
  for (const OrdinaryTask& each : two_wrenches(plain)) {
    for (const Problem& left : {each.task, dead(each.task, "front_left_vertical"),
                                dead(dead(each.task, "rear_left_horizontal"), "right_q3_elbow")}) {
      for (const double tool : {0.1, -0.1}) {
        all.push_back({heavier(left, "right_link_4", tool), each.length});
      }
    }
  }
  return all;
}

/// A kilogram at [0.05, 0, 0.02] m that displaces 1.27e-4 m^3.
std::vector<OrdinaryTask> carried_mass(const Problem& plain) {
  Vector6d c;
  c << 0, 0, 1, 0, -0.05, 0;  // [0.05, 0, 0.02] x e_z
  const double weight = 9.81 * (1 - 998 * 1.27e-4);
  return {{along_c(plain, c), weight * c.norm()}};
}

struct ContactList {
  const char* name;
  const char* file;
  std::string wrench, tables;
  std::vector<OrdinaryTask> (*scenarios)(const Problem& plain);
  bool hold = false;           ///< whether the list holds without a wrench as well
  bool requires_push = false;  ///< whether factors are not negative
};
void PrintTo(const ContactList& list, std::ostream* out) { *out << list.name; }

const char* const kUncertainOrDead =
    "[uncertainty]\nmass.right_link_4 = 0.1\n[loss]\ncases = [['front_left_vertical'], "
    "['rear_left_horizontal', 'right_q3_elbow']]\n";
const char* const kTwoWrenches = "set = [[0,0,0,0,0,1], [5,0,0,0,0,-2]]";

const ContactList kContactLists[] = {
    {"wrenches", kTwoArms, kTwoWrenches, "", two_wrenches},
    {"held", kBarAndWall, std::string(kTwoWrenches) + "\nhold = true", "", two_wrenches, true},
    {"any_dead", kBarAndWall, kTurn, "[loss]\nany = 1\nactuators = ['thrusters']\n", any_dead},
    {"any_dead_of_two_arms", kTwoArms, kTurn, "[loss]\nany = 1\nactuators = ['thrusters']\n",
     any_dead},
    {"corners", kTwoArms, kTurn, kUncertain, corners},
    {"corners_at_the_wall", kBarAndWall, kTurn, kUncertain, corners},
    {"everything", kTwoArms, kTwoWrenches, kUncertainOrDead, corners_and_losses},
    {"payload", kTwoArms, "", "[payload]\ncom = [0.05, 0, 0.02]\nvolume_per_kg = 1.27e-4\n",
     carried_mass, false, true},
    {"no_forces", kBarAlone, kTurn, kUncertain, corners},
};

/// The interval of a scenario: its ends are the values along c and against it.
struct Interval {
  double low, high;
};
Interval interval_of(const OrdinaryTask& one, const Posture& posture) {
  return {-value_at(along_c(one.task, -one.task.c), posture, Wrench::kPure) / one.length,
          value_at(one.task, posture, Wrench::kPure) / one.length};
}

class SecondContactList : public testing::TestWithParam<ContactList> {
 protected:
  const ContactList& list_ = GetParam();
  const Problem task_ = second_contact_task(list_.file, list_.wrench, list_.tables);
  const Problem plain_ = second_contact_task(list_.file, kTurn, "");
};

/// The value is the least of the upper ends of ordinary tasks if it is a factor of all of them.
TEST_P(SecondContactList, AgreesWithOrdinaryTasks) {
  const std::vector<OrdinaryTask> ordinary = list_.scenarios(plain_);
  const std::vector<std::string> solvers = supported_solvers(task_, Case().measure, Wrench::kPure);
  Random random(7);
  int values = 0;
  for (int i = 0; i < samples(12); ++i) {
    const Eigen::VectorXd theta_r = i == 0 ? task_.theta_r_default : near_default(task_, random);
    Options options;
    options.check_collision = false;
    const Answer answer = evaluate(task_, theta_r, options);
    if (answer.posture.status != Status::kValid) continue;
    const std::vector<ScenarioEnds> ends = scenario_ends(answer);
    ASSERT_EQ(ends.size(), ordinary.size() + (list_.hold ? 1 : 0));
    double high = kInfinity, low = list_.requires_push ? 0 : -kInfinity;
    for (std::size_t s = 0; s < ordinary.size(); ++s) {
      const Interval own = interval_of(ordinary[s], answer.posture);
      high = std::min(high, own.high);
      low = std::max(low, own.low);
      const bool held = std::isfinite(own.high);
      ASSERT_EQ(ends[s].held, held) << ends[s].name;
      if (!held) continue;
      EXPECT_NEAR(ends[s].high, own.high, 1e-8 * (1 + std::abs(own.high))) << ends[s].name;
      const double least = list_.requires_push ? std::max(own.low, 0.0) : own.low;
      EXPECT_NEAR(ends[s].low, least, 1e-8 * (1 + std::abs(own.low))) << ends[s].name;
    }
    const Interval without = interval_of(ordinary[0], answer.posture);
    const bool rests = !list_.hold || (without.low <= 0 && without.high >= 0);
    const bool feasible = rests && low <= high;
    ASSERT_EQ(answer.status, feasible ? Status::kOptimal : Status::kInfeasible)
        << answer.reason.str();
    if (!feasible) continue;
    ++values;
    EXPECT_NEAR(answer.beta(), high, 1e-8 * (1 + std::abs(high)));
    EXPECT_TRUE(answer.residual().within(1e-8));
    for (const std::string& solver : solvers) {
      // Slow, and without a proof for a scenario without a wrench.
      if (solver == "ipopt" && (i > 0 || list_.hold)) continue;
      options.solver = solver;
      const Answer other = evaluate(task_, theta_r, options);
      ASSERT_EQ(other.status, Status::kOptimal) << solver << ": " << other.reason.str();
      EXPECT_NEAR(other.beta(), high, (solver == "ipopt" ? 1e-6 : 1e-8) * (1 + std::abs(high)))
          << solver;
      EXPECT_LT((other.capability.h - other.beta() * other.capability.decides.c).norm(),
                1e-7 * (1 + std::abs(high)))
          << solver;
    }
  }
  EXPECT_GT(values, 0);
}

/// Facets do not count the forces of the contact, so they are not offered where it has some.
TEST_P(SecondContactList, HasSolversOfSeveralColumns) {
  const auto solvers = supported_solvers(task_, Case().measure, Wrench::kPure);
  const bool facets = std::find(solvers.begin(), solvers.end(), "facets") != solvers.end();
  EXPECT_EQ(facets, task_.contact_columns() == 0);
  Options options;
  options.check_collision = false;
  const Answer answer = evaluate(task_, task_.theta_r_default, options);
  EXPECT_EQ(answer.choice.solver, facets ? "facets" : "condensed");
}

TEST_P(SecondContactList, GradientsAreThoseOfDifferences) {
  Options options;
  options.check_collision = false;
  Random random(5);
  expect_gradients(task_, options, random);
}

TEST_P(SecondContactList, LoopAllocatesNothing) {
  std::vector<Eigen::VectorXd> points(10, task_.theta_r_default);
  for (std::size_t i = 0; i < points.size(); ++i) points[i][0] += 0.002 * static_cast<double>(i);
  expect_no_allocations(task_, "condensed", points);
}

INSTANTIATE_TEST_SUITE_P(All, SecondContactList, testing::ValuesIn(kContactLists),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace maxwrench
