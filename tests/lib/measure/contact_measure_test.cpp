#include <gtest/gtest.h>

#include <cmath>

#include "benchmarks/suite/product.h"
#include "lib/posture/redundancy.h"
#include "maxwrench/load.h"
#include "maxwrench/measure.h"
#include "maxwrench/objective.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/method.h"
#include "tests/support/contacts.h"

namespace maxwrench {
namespace {

/// Every measure with every solver of `solvers` that supports the problem.
std::vector<Case> cases_of(const Problem& problem, const std::vector<std::string>& solvers) {
  std::vector<Case> cases = product(problem, 1, 1);
  std::erase_if(cases, [&](const Case& c) {
    return c.search != general_search() ||
           (c.solver != kNoSolver &&
            std::find(solvers.begin(), solvers.end(), c.solver) == solvers.end());
  });
  return cases;
}

/// The largest of a concave function of x in [0, high]; -infinity outside of its domain, which
/// holds zero.
template <class F>
double largest(F&& f, double high) {
  double low = 0;
  for (int step = 0; step < 70; ++step) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    if (f(a) >= f(b)) {
      high = b;
    } else {
      low = a;
    }
  }
  return f((low + high) / 2);
}

/// beta for given pushes (x, y) of two one-sided columns, by the definition of each closed form:
/// the largest w_1 with |a w_1 + b| <= 1, or minus the effort at w_1 = reference.
class Definition {
 public:
  Definition(const std::string& measure, const Problem& problem, const WrenchProgram& program)
      : effort_(measure == "least_effort"), reference_(problem.reference) {
    const Zonotope& set = *program.actuation;
    Eigen::MatrixXd K = set.B.transpose() * (set.B * set.B.transpose()).inverse();
    const Eigen::VectorXd limit = set.u_max.cwiseMin(-set.u_min);
    if (measure == "ellipsoid" || measure == "weighted_transmission_ratio") {
      K = limit.cwiseInverse().asDiagonal() * K;
    } else if (measure == "transmission_ratio") {
      K = Eigen::MatrixXd::Identity(set.dimension(), set.dimension());
    }
    const bool loaded = effort_ || measure == "ellipsoid";
    G_.resize(K.rows(), 4);
    G_ << K * program.JtW, K * program.tau_d * (loaded ? 1 : 0);
    // All that a value needs are the scalar products of the columns.
    products_ = G_.transpose() * G_;
  }

  double operator()(double x, double y) const {
    const Eigen::Vector4d rest(0, x, y, 1);
    const double aa = products_(0, 0), ab = products_.row(0).dot(rest),
                 bb = rest.dot(products_ * rest);
    if (effort_) return -(aa * reference_ * reference_ + 2 * ab * reference_ + bb);
    const double half = ab / aa, square = half * half - (bb - 1) / aa;
    return square < 0 ? -kInfinity : -half + std::sqrt(square);
  }

 private:
  bool effort_;
  double reference_;
  Eigen::MatrixXd G_;
  Eigen::Matrix4d products_;
};

TEST(OneSided, ClosedFormsEqualAScanOverThePushes) {
  Random random(31);
  for (const char* measure :
       {"ellipsoid", "weighted_transmission_ratio", "transmission_ratio", "least_effort"}) {
    Problem problem = load_problem("dual_arm/bar_wall");
    Contact& contact = *problem.contact;
    contact.C = Matrix6Xd::Zero(6, 2);
    contact.C.row(2).setOnes();
    contact.C.row(0) << 0.5, -0.5;
    contact.w_min = Eigen::Vector2d::Zero();
    contact.w_max.setConstant(2, kInfinity);
    PostureEvaluator model(problem, false);
    const auto own = resolve(problem, {problem.name, measure}).make_measure();
    WrenchProgram program = make_wrench_program(problem, Wrench::kPure);
    Capability capability;
    int compared = 0, rests = 0;
    for (int sample = 0; sample < 200 && compared < 8; ++sample) {
      const Posture& posture = model.evaluate(random_theta_r(problem, random));
      if (posture.status != Status::kValid) continue;
      set_posture(posture, program);
      own->evaluate(posture, program, true, capability);
      ASSERT_EQ(capability.status, Status::kOptimal) << capability.reason.c_str();
      EXPECT_TRUE(capability.residual.within(1e-9 * (1 + std::abs(capability.beta)))) << measure;
      EXPECT_GE(capability.w.tail(2).minCoeff(), 0) << measure;
      const Definition value(measure, problem, program);
      const double high = 1000;
      const double scan = largest(
          [&](double x) { return largest([&](double y) { return value(x, y); }, high); }, high);
      EXPECT_NEAR(capability.beta, scan, 1e-7 * (1 + std::abs(scan))) << measure;
      rests += capability.w.tail(2).minCoeff() == 0;
      ++compared;
    }
    EXPECT_EQ(compared, 8) << measure;
    EXPECT_GT(rests, 0) << measure;
  }
}

/// A friction pyramid of eight edges beside all six wrenches: more columns than closed forms hold.
TEST(OneSided, TooManyColumnsAreAStatus) {
  for (const double low : {0.0, -kInfinity}) {
    Problem problem = load_problem("dual_arm/bar_wall");
    Contact& contact = *problem.contact;
    contact.C = Matrix6Xd::Zero(6, 8);
    contact.C.row(2).setOnes();
    contact.w_min.setConstant(8, low);
    contact.w_max.setConstant(8, kInfinity);
    PostureEvaluator model(problem, false);
    WrenchProgram program = make_wrench_program(problem, Wrench::kAny);
    set_posture(model.evaluate(problem.theta_r_default), program);
    Capability capability;
    resolve(problem, {problem.name, "ellipsoid", Wrench::kAny})
        .make_measure()
        ->evaluate(model.evaluate(problem.theta_r_default), program, true, capability);
    EXPECT_EQ(capability.status, Status::kNumericalError);
    EXPECT_STRNE(capability.reason.c_str(), "");
  }
}

/// Columns that may do nothing are as good as none, for every measure and both own solvers.
TEST(ContactMeasure, RestingColumnsChangeNothing) {
  Random random(32);
  for (const char* name : kContactProblems) {
    const Problem problem = load_problem(name);
    Problem resting = problem;
    resting.contact->w_min.setZero();
    resting.contact->w_max.setZero();
    Problem alone = problem;
    alone.contact.reset();
    for (const Case& c : cases_of(problem, {"condensed", "simplex"})) {
      PostureEvaluator model(problem, false);
      const auto measure = resolve(problem, c).make_measure();
      int compared = 0;
      for (int sample = 0; sample < 10; ++sample) {
        const Posture& posture = model.evaluate(near_default(problem, random));
        if (posture.status != Status::kValid) continue;
        double beta[2];
        int i = 0;
        for (const Problem* p : {&resting, &alone}) {
          WrenchProgram program = make_wrench_program(*p, c.wrench);
          set_posture(posture, program);
          Capability capability;
          measure->evaluate(posture, program, true, capability);
          beta[i++] = capability.status == Status::kOptimal ? capability.beta : -kInfinity;
          if (p == &resting && capability.status == Status::kOptimal) {
            EXPECT_TRUE(capability.h_2.isZero()) << name << " " << c.measure;
          }
        }
        if (beta[0] == -kInfinity && beta[1] == -kInfinity) continue;
        EXPECT_NEAR(beta[0], beta[1], 1e-9 * (1 + std::abs(beta[1]))) << name << " " << c.measure;
        ++compared;
      }
      EXPECT_GT(compared, 0) << name << " " << c.measure;
    }
  }
}

/// The wall is pushed, never pulled, whichever way the bar turns; and the forces balance.
TEST(ContactMeasure, PushOnlyContactNeverPulls) {
  Random random(33);
  int pushed = 0, would_pull = 0;
  for (const double sign : {1.0, -1.0}) {
    Problem problem = load_problem("dual_arm/bar_wall");
    problem.c *= sign;
    Problem glued = problem;
    glued.contact->w_min.setConstant(-kInfinity);
    for (int sample = 0; sample < 100; ++sample) {
      const Eigen::VectorXd theta_r = random_theta_r(problem, random);
      const Case c{problem.name, "linf_polytope"};
      PostureEvaluator model(problem, false);
      const Posture& posture = model.evaluate(theta_r);
      if (posture.status != Status::kValid) continue;
      const auto solve = [&](const Problem& p) {
        WrenchProgram program = make_wrench_program(p, Wrench::kPure);
        set_posture(posture, program);
        Capability capability;
        resolve(p, c).make_measure()->evaluate(posture, program, true, capability);
        EXPECT_EQ(capability.status, Status::kOptimal);
        return capability;
      };
      const Capability push = solve(problem), glue = solve(glued);
      const double into_wall = posture.contact.R.col(2).dot(push.h_2.head<3>());
      EXPECT_GE(into_wall, 0);
      EXPECT_EQ(into_wall, push.h_2.head<3>().norm());
      EXPECT_LE(push.beta, glue.beta + 1e-9);
      pushed += into_wall > 1e-3;
      would_pull += posture.contact.R.col(2).dot(glue.h_2.head<3>()) < -1e-3;
      // tau_d + J'h + J_2'h_2 = B u
      const Eigen::VectorXd missed = posture.tau_d + posture.J.transpose() * push.h +
                                     posture.J_2.transpose() * push.h_2 -
                                     problem.robot.actuation.B * push.u;
      EXPECT_LT(missed.norm(), 1e-9);
    }
  }
  EXPECT_GT(pushed, 10);
  EXPECT_GT(would_pull, 10);
}

/// Of the whole way from theta_r to beta, on the best IK solution. At a kink, where the active
/// limits or the best IK solution change, the one-sided differences disagree: those are left out.
TEST(ContactMeasure, GradientEqualsDifferences) {
  Random random(34);
  constexpr double kStep = 1e-6;
  for (const char* name : kContactProblems) {
    for (const Problem& problem : {load_problem(name), with_pipe(load_problem(name))}) {
      for (const Case& c : cases_of(problem, {"condensed"})) {
        const auto f =
            make_capability_objective(problem, c.wrench, resolve(problem, c).make_measure, false);
        int compared = 0, kinks = 0;
        for (int sample = 0; sample < samples(40); ++sample) {
          const Eigen::VectorXd theta_r = near_default(problem, random);
          Eigen::VectorXd gradient;
          const double value = f->evaluate(theta_r, &gradient);
          if (!std::isfinite(value)) continue;
          for (int k = 0; k < problem.redundancy(); ++k) {
            const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(theta_r.size(), k);
            const double after = f->evaluate(theta_r + step), before = f->evaluate(theta_r - step);
            const double jump = (after - value) - (value - before);
            const double difference = (after - before) / (2 * kStep);
            if (!(std::abs(jump) < 1e-3 * kStep * (1 + std::abs(difference)))) {
              ++kinks;
              continue;
            }
            EXPECT_NEAR(gradient[k], difference, 1e-5 * (1 + std::abs(difference)))
                << name << " " << c.measure << " " << to_string(c.wrench) << " " << k;
            ++compared;
          }
        }
        EXPECT_GE(compared, kinks) << name << " " << c.measure;
        EXPECT_GT(compared, 0) << name << " " << c.measure;
      }
    }
  }
}

TEST(ContactMeasure, ValueAndGradientAllocateNothingAfterTheFirstCall) {
  for (const char* name : kContactProblems) {
    const Problem problem = load_problem(name);
    for (const Case& c : cases_of(problem, {"condensed", "simplex"})) {
      const auto f = make_capability_objective(problem, c.wrench, resolve(problem, c).make_measure);
      Random random(35);
      std::vector<Eigen::VectorXd> postures;
      for (int i = 0; i < 200; ++i) postures.push_back(near_default(problem, random));
      Eigen::VectorXd gradient;
      f->evaluate(problem.theta_r_default, &gradient);
      const long before = allocation_count();
      int values = 0;
      for (const Eigen::VectorXd& theta_r : postures) {
        values += std::isfinite(f->evaluate(theta_r, &gradient));
      }
      EXPECT_EQ(allocation_count(), before) << name << " " << c.measure << " " << c.solver;
      EXPECT_GT(values, 0) << name << " " << c.measure << " " << c.solver;
    }
  }
}

/// J A_r = 0; the contact point moves with its regrasp coordinate alone; the joints as they really
/// do.
TEST(ContactMeasure, NullMotionFollowsTheContact) {
  Random random(36);
  constexpr double kStep = 1e-6;
  for (const char* name : kContactProblems) {
    for (const Problem& problem : {load_problem(name), with_pipe(load_problem(name))}) {
      PostureEvaluator model(problem, false);
      const int n = problem.robot.velocities();
      const auto joints = static_cast<Eigen::Index>(problem.robot.joints.size());
      const auto own = static_cast<Eigen::Index>(problem.redundant.size());
      int compared = 0;
      for (int sample = 0; sample < 20; ++sample) {
        const Eigen::VectorXd theta_r = near_default(problem, random);
        const Posture posture = model.evaluate(theta_r);
        if (posture.status != Status::kValid) continue;
        const int ik_solutions = model.ik_solutions();
        Eigen::MatrixXd A_r;
        null_motion(problem, posture, A_r);
        ASSERT_EQ(A_r.rows(), n);
        EXPECT_LT((posture.J * A_r).norm(), 1e-10) << name;
        Matrix6Xd twists = posture.J_2 * A_r;
        for (Eigen::Index k = own; k < A_r.cols(); ++k) {
          twists.col(k) -=
              contact_twist(*problem.contact, theta_r.data() + own, static_cast<int>(k - own));
        }
        EXPECT_LT(twists.topRows<3>().norm(), 1e-10) << name;
        for (Eigen::Index k = 0; k < A_r.cols(); ++k) {
          const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(A_r.cols(), k);
          const Eigen::VectorXd after = model.evaluate(theta_r + step).q;
          bool same = model.ik_solutions() == ik_solutions;
          const Eigen::VectorXd before = model.evaluate(theta_r - step).q;
          same &= model.ik_solutions() == ik_solutions;
          if (!same) continue;
          EXPECT_LT(((after - before) / (2 * kStep) - A_r.col(k).tail(joints)).norm(),
                    1e-6 * (1 + A_r.col(k).norm()))
              << name;
          ++compared;
        }
      }
      EXPECT_GT(compared, 5) << name;
    }
  }
}

}  // namespace
}  // namespace maxwrench
