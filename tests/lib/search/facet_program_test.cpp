#include "lib/search/facet_program.h"

#include <gtest/gtest.h>

#include <string>

#include "lib/math/random.h"
#include "maxwrench/load.h"
#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "tests/support/free_poses.h"

namespace maxwrench {
namespace {

MeasureMaker linf_polytope(const Problem& problem) {
  return [&problem] {
    return find_measure("linf_polytope").make(problem, find_wrench_solver("simplex").make());
  };
}

Eigen::VectorXd draw_theta_r(const Problem& problem, Random& random) {
  Eigen::VectorXd theta_r(problem.redundancy());
  for (Eigen::Index i = 0; i < theta_r.size(); ++i) {
    theta_r[i] = random.uniform(problem.theta_r_min[i], problem.theta_r_max[i]);
  }
  return theta_r;
}

struct ProgramKind {
  const char* problem;
  Wrench wrench;
  FreePose free = {};
};

Problem load(const ProgramKind& kind) {
  const Problem problem = load_problem(kind.problem);
  return kind.free.count() > 0 ? with_free_pose(problem, kind.free) : problem;
}

class FacetRows : public testing::TestWithParam<ProgramKind> {};

INSTANTIATE_TEST_SUITE_P(
    All, FacetRows,
    testing::Values(
        ProgramKind{"planar/force", Wrench::kPure}, ProgramKind{"planar/two_arms", Wrench::kAny},
        ProgramKind{"uvms/valve", Wrench::kPure}, ProgramKind{"uvms/lift", Wrench::kAny},
        ProgramKind{"dual_arm/bar_wall", Wrench::kPure},
        ProgramKind{"dual_arm/two_arms", Wrench::kAny}, ProgramKind{"mobile/push", Wrench::kPure},
        ProgramKind{"fixed/push", Wrench::kAny},
        ProgramKind{"uvms/valve", Wrench::kAny, {{0, 4, 5}, true, true}},
        ProgramKind{"fixed/push", Wrench::kPure, {{2, 4}, false, true}},
        ProgramKind{"dual_arm/two_arms", Wrench::kAny, {{1, 3}, false, true}}),
    [](const auto& each) {
      std::string name = each.param.problem;
      if (each.param.free.count() > 0) name += "_free";
      for (char& c : name) c = std::isalnum(c) ? c : '_';
      return name + "_" + to_string(each.param.wrench);
    });

/// Of all rows by theta_r and w, at each IK solution; w is any.
TEST_P(FacetRows, DerivativesAreThoseOfDifferences) {
  const Problem problem = load(GetParam());
  FacetProgram program(problem, GetParam().wrench, linf_polytope(problem));
  Random random(1);
  constexpr double kStep = 1e-6;
  int seen = 0;
  for (int draw = 0; draw < 200 && seen < 20; ++draw) {
    const Eigen::VectorXd theta_r = draw_theta_r(problem, random);
    const int ik_solutions = program.ik_solutions(theta_r);
    for (int ik_solution = 0; ik_solution < ik_solutions; ++ik_solution) {
      Eigen::VectorXd w;
      program.set_out(theta_r, ik_solution, w);
      for (double& w_j : w) w_j = random.uniform(-10, 10);
      ASSERT_TRUE(program.evaluate(theta_r, w));
      program.linearize();
      const Eigen::MatrixXd by_theta_r = program.by_theta_r(), by_w = program.by_w();
      const auto along = [&](const Eigen::VectorXd& dtheta, const Eigen::VectorXd& dw,
                             Eigen::VectorXd& slope) {
        if (!program.evaluate(theta_r + kStep * dtheta, w + kStep * dw)) return false;
        slope = program.rows();
        if (!program.evaluate(theta_r - kStep * dtheta, w - kStep * dw)) return false;
        slope = (slope - program.rows()) / (2 * kStep);
        return true;
      };
      const Eigen::VectorXd dtheta =
          Eigen::VectorXd::NullaryExpr(theta_r.size(), [&] { return random.uniform(-1, 1); });
      const Eigen::VectorXd dw =
          Eigen::VectorXd::NullaryExpr(w.size(), [&] { return random.uniform(-1, 1); });
      Eigen::VectorXd slope;
      if (!along(dtheta, dw, slope)) continue;  // beside the edge of the postures
      ++seen;
      const Eigen::VectorXd off = by_theta_r * dtheta + by_w * dw - slope;
      const Eigen::VectorXd size = program.row_unit() + slope.cwiseAbs();
      EXPECT_LT(off.cwiseQuotient(size).cwiseAbs().maxCoeff(), 1e-6)
          << "draw " << draw << ", IK solution " << ik_solution;
    }
  }
  EXPECT_GE(seen, 10);
}

/// The lower level's answer satisfies the facet rows, and nothing along c beyond it does.
TEST_P(FacetRows, HoldTheLowerLevel) {
  const Problem problem = load(GetParam());
  FacetProgram program(problem, GetParam().wrench, linf_polytope(problem));
  const Eigen::Index pairs = problem.robot.actuation.facet_pairs();
  Random random(2);
  int seen = 0;
  const auto exceeded = [&] {
    return (program.rows() - program.row_max())
        .cwiseMax(program.row_min() - program.rows())
        .head(pairs)
        .maxCoeff();
  };
  for (int draw = 0; draw < 500 && seen < 20; ++draw) {
    const Eigen::VectorXd theta_r = draw_theta_r(problem, random);
    if (program.ik_solutions(theta_r) == 0) continue;
    Eigen::VectorXd w;
    program.set_out(theta_r, 0, w);
    if (w.isZero()) continue;  // the lower level has no answer
    ++seen;
    ASSERT_TRUE(program.evaluate(theta_r, w));
    EXPECT_LT(exceeded(), 1e-6);
    ASSERT_TRUE(program.evaluate(theta_r, w + 0.01 * program.c_w()));
    EXPECT_GT(exceeded(), 0);
  }
  EXPECT_GE(seen, 10);
}

/// Two arms: from each IK solution a step of 1e-4 moves the joints as little, though others are
/// there.
TEST(FacetProgram, StaysOnItsIkSolution) {
  const Problem problem = load_problem("dual_arm/two_arms");
  FacetProgram program(problem, Wrench::kPure, linf_polytope(problem));
  Random random(3);
  int seen = 0;
  for (int draw = 0; draw < 2000 && seen < 20; ++draw) {
    const Eigen::VectorXd theta_r = draw_theta_r(problem, random);
    const int ik_solutions = program.ik_solutions(theta_r);
    for (int ik_solution = 0; ik_solutions > 1 && ik_solution < ik_solutions; ++ik_solution) {
      Eigen::VectorXd w;
      program.set_out(theta_r, ik_solution, w);
      ASSERT_TRUE(program.evaluate(theta_r, w));
      program.linearize();
      const Eigen::VectorXd at = program.rows();
      const Eigen::VectorXd step = Eigen::VectorXd::Constant(theta_r.size(), 1e-4);
      if (!program.evaluate(theta_r + step, w)) continue;
      ++seen;
      const double moved = (program.rows() - at - program.by_theta_r() * step).norm();
      EXPECT_LT(moved, 0.01 * (1 + at.norm()));
    }
  }
  EXPECT_GE(seen, 10);
}

/// What collides has a row that says so, what does not has none.
TEST(FacetProgram, ClearancesAreThoseOfTheCheck) {
  const Problem problem = load_problem("uvms/valve");
  FacetProgram program(problem, Wrench::kPure, linf_polytope(problem));
  const Eigen::Index pairs = problem.robot.collision->pairs();
  PostureEvaluator model(problem);
  Random random(4);
  int collide = 0;
  for (int draw = 0; draw < 200; ++draw) {
    const Eigen::VectorXd theta_r = draw_theta_r(problem, random);
    ASSERT_TRUE(program.evaluate(theta_r, Eigen::VectorXd::Zero(1)));
    const bool apart = program.rows().tail(pairs).minCoeff() > 0;
    EXPECT_EQ(model.evaluate(theta_r).status == Status::kValid, apart);
    collide += !apart;
  }
  EXPECT_GT(collide, 10);
  EXPECT_LT(collide, 190);
}

}  // namespace
}  // namespace maxwrench
