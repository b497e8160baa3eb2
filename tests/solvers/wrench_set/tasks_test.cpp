#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/measure/closed_form.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/solve.h"
#include "solvers/wrench_set/directions.h"
#include "tests/support/support.h"
#include "tests/support/wrench_sets.h"

namespace maxwrench {
namespace {

/// The shipped static tasks.
std::vector<std::string> static_tasks() {
  std::vector<std::string> names;
  for (const std::string& name : shipped_problems()) {
    if (!load_problem(name).motion) names.push_back(name);
  }
  return names;
}

/// c first, then the axes of W_any, orthogonalised: up to three orthonormal columns that do work.
Matrix6Xd directions(const Problem& problem, const Vector6d& c, const Eigen::Matrix3d& turn) {
  Matrix6Xd E = c;
  for (Eigen::Index j = 0; j < problem.W_any.cols() && E.cols() < 3; ++j) {
    Vector6d e;
    e << turn * problem.W_any.col(j).head<3>(), turn * problem.W_any.col(j).tail<3>();
    e -= E * (E.transpose() * e);
    if (e.norm() < 0.5) continue;
    E.conservativeResize(Eigen::NoChange, E.cols() + 1);
    E.rightCols(1) = e.normalized();
  }
  return E;
}

class WrenchSetsOfTasks : public testing::TestWithParam<std::string> {
 protected:
  /// Calls check(answer, E) at the default and at random postures.
  template <class Check>
  void at_postures(const Case& choice, const Check& check) {
    Random random(3);
    Options options;
    static_cast<Case&>(options) = choice;
    options.check_collision = false;
    for (int i = 0; i <= samples(20); ++i) {
      const Eigen::VectorXd theta_r =
          i == 0 ? problem_.theta_r_default : random_theta_r(problem_, random);
      const Answer answer = evaluate(problem_, theta_r, options);
      if (answer.posture.status != Status::kValid) continue;
      SCOPED_TRACE(problem_.name + ", posture " + std::to_string(i));
      check(answer, directions(problem_, answer.trajectory.instants[0].c, answer.posture.turn));
      ++checked_;
    }
    EXPECT_GT(checked_, 0);
  }
  double tolerance(double beta) const { return 1e-6 * (1 + std::abs(beta)); }

  Problem problem_ = load_problem(GetParam());
  int checked_ = 0;
};

/// A wrench that no effort limits: forces of the columns that are free beside E, and of the second
/// contact as far as they may grow without end, balance it with all efforts at rest. Some subset of
/// these columns does so with the signs that their limits allow.
void expect_no_load(const WrenchProgram& program, Eigen::Index k, const Eigen::VectorXd& ray) {
  const Eigen::VectorXd load = program.JtW.leftCols(k) * ray;
  std::vector<Eigen::VectorXd> columns;
  std::vector<bool> may_be_negative;
  for (Eigen::Index j = k; j < program.JtW.cols(); ++j) {
    const bool up = std::isinf(program.w_max[j]), down = std::isinf(program.w_min[j]);
    if (!up && !down) continue;
    columns.emplace_back(program.JtW.col(j) * (up ? 1 : -1));
    may_be_negative.push_back(up && down);
  }
  ASSERT_LT(columns.size(), 16U);
  double least = load.norm();
  for (unsigned subset = 1; subset < 1U << columns.size(); ++subset) {
    Eigen::MatrixXd A(load.size(), 0);
    std::vector<bool> free;
    for (std::size_t j = 0; j < columns.size(); ++j) {
      if ((subset >> j & 1U) == 0) continue;
      A.conservativeResize(Eigen::NoChange, A.cols() + 1);
      A.rightCols(1) = columns[j];
      free.push_back(may_be_negative[j]);
    }
    const Eigen::VectorXd w = A.completeOrthogonalDecomposition().solve(-load);
    bool allowed = true;
    for (std::size_t j = 0; j < free.size(); ++j) {
      allowed = allowed && (free[j] || w[static_cast<Eigen::Index>(j)] >= -1e-9);
    }
    if (allowed) least = std::min(least, (load + A * w).norm());
  }
  EXPECT_NEAR(least, 0, 1e-6);
}

TEST_P(WrenchSetsOfTasks, PolytopesHaveTheCapabilityAlongC) {
  for (const char* measure : {"linf_polytope", "l2_polytope"}) {
    for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
      if (measure == std::string("l2_polytope") && !problem_.robot.actuation.full_row_rank()) {
        continue;
      }
      SCOPED_TRACE(std::string(measure) + ", " + to_string(wrench));
      Case choice;
      choice.measure = measure;
      choice.wrench = wrench;
      int undecided = 0;
      at_postures(choice, [&](const Answer& answer, const Matrix6Xd& E) {
        WrenchSetOptions options;
        options.E = E;
        options.wrench = wrench;
        options.measure = measure;
        const WrenchSet set = force_polytope(problem_, answer.posture, options);
        if (set.status == Status::kNumericalError) return void(++undecided);
        if (set.status == Status::kUnbounded) {
          return expect_no_load(wrench_set_program(problem_, answer.posture, E, wrench), E.cols(),
                                set.ray);
        }
        if (answer.status == Status::kInfeasible) {
          // No multiple of c balances the posture: the line misses the set, or there is none.
          if (set.status == Status::kInfeasible) return;
          expect_polytope(set);
          const Stretch none = along(set, Eigen::VectorXd::Unit(E.cols(), 0));
          EXPECT_GT(none.min, none.max);
          return;
        }
        ASSERT_EQ(answer.status, Status::kOptimal);
        expect_polytope(set);
        if (set.status != Status::kOptimal) return;
        const Eigen::VectorXd c = Eigen::VectorXd::Unit(E.cols(), 0);
        const double found = wrench == Wrench::kPure ? along(set, c).max : support_of(set, c);
        EXPECT_NEAR(found, answer.beta(), tolerance(answer.beta()));
        EXPECT_TRUE(set.residual.within(1e-6 * (1 + set.vertices.norm())));
      });
      EXPECT_EQ(undecided, 0);
    }
  }
}

TEST_P(WrenchSetsOfTasks, EllipsoidsHaveTheCapabilityAlongC) {
  const Zonotope& actuation = problem_.robot.actuation;
  const bool supported = actuation.full_row_rank() && (actuation.u_min.array() < 0).all() &&
                         (actuation.u_max.array() > 0).all();
  if (!supported || problem_.contact_columns() > 0) return;
  const Eigen::MatrixXd K = weighted_inverse(problem_.robot, "test");
  for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
    Case choice;
    choice.measure = "ellipsoid";
    choice.wrench = wrench;
    at_postures(choice, [&](const Answer& answer, const Matrix6Xd& E) {
      const WrenchEllipsoid set = force_ellipsoid(problem_, answer.posture, E, wrench);
      if (set.status == Status::kUnbounded) {
        return expect_no_load(wrench_set_program(problem_, answer.posture, E, wrench), E.cols(),
                              set.ray);
      }
      if (answer.status == Status::kInfeasible) return;  // it may still contain other wrenches
      ASSERT_EQ(answer.status, Status::kOptimal);
      ASSERT_EQ(set.status, Status::kOptimal) << set.reason.c_str();
      const Eigen::VectorXd c = Eigen::VectorXd::Unit(E.cols(), 0);
      if (wrench == Wrench::kAny) {
        EXPECT_NEAR(set.centre[0] + std::sqrt(c.dot(set.shape() * c)), answer.beta(),
                    tolerance(answer.beta()));
        return;
      }
      // (beta c - centre)'S^-1 (beta c - centre) = 1, and each end of an axis is on the ellipsoid.
      const Eigen::VectorXd y = set.axes.transpose() * (answer.beta() * c - set.centre);
      EXPECT_NEAR(y.cwiseQuotient(set.radii).norm(), 1, 1e-6);
      for (Eigen::Index i = 0; i < E.cols(); ++i) {
        const Eigen::VectorXd f = set.centre + set.radii[i] * set.axes.col(i);
        const Eigen::VectorXd tau = answer.posture.tau_d + answer.posture.J.transpose() * (E * f);
        EXPECT_NEAR((K * tau).norm(), 1, 1e-6);
      }
    });
  }
}

std::string task_name(const testing::TestParamInfo<std::string>& of) {
  std::string name = of.param;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(All, WrenchSetsOfTasks, testing::ValuesIn(static_tasks()), task_name);

/// The volume of the force polytope of uvms/valve by sampling: a force is in it if the facets of
/// the robot's zonotope hold.
TEST(ForcePolytopeOfValve, VolumeByCounting) {
  const Problem problem = load_problem("uvms/valve");
  PostureEvaluator model(problem);
  const Posture& posture = model.evaluate(problem.theta_r_default);
  const WrenchSet set = force_polytope(problem, posture);
  expect_polytope(set);
  ASSERT_EQ(set.dimension, 3);
  const Zonotope& zonotope = problem.robot.actuation;
  const Eigen::MatrixXd A = zonotope.N.transpose() * posture.J.transpose().leftCols<3>();
  const Eigen::VectorXd offset = zonotope.N.transpose() * posture.tau_d;
  const Eigen::Vector3d low = set.vertices.rowwise().minCoeff(),
                        sides = set.vertices.rowwise().maxCoeff() - low;
  Random random(5);
  const int all = samples(200000);
  int inside = 0;
  for (int i = 0; i < all; ++i) {
    const Eigen::Vector3d share(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    const Eigen::Vector3d f = low + sides.cwiseProduct(share);
    const Eigen::VectorXd y = A * f + offset;
    const bool allowed =
        (y.array() >= zonotope.b_min.array()).all() && (y.array() <= zonotope.b_max.array()).all();
    const bool in_set = (set.normals.transpose() * f - set.offsets).maxCoeff() <= 0;
    const double closest = (set.normals.transpose() * f - set.offsets).cwiseAbs().minCoeff();
    if (closest > 1e-6) {
      ASSERT_EQ(allowed, in_set);
    }
    inside += allowed ? 1 : 0;
  }
  const double p = static_cast<double>(inside) / all, box = sides.prod();
  EXPECT_NEAR(set.volume, p * box, 5 * box * std::sqrt(p * (1 - p) / all));
}

}  // namespace
}  // namespace maxwrench
