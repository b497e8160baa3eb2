#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>
#include <string>

#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "solvers/wrench/makers.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// What a random program is made to be awkward in.
enum class Kind {
  kPlain,
  kHeavy,           ///< tau_d scaled up: many are infeasible
  kEqualLimits,     ///< u_min = u_max for some actuators
  kAlongNormal,     ///< J'c along a facet normal
  kParallelAxis,    ///< a joint that the wrench does not load
  kThrusterIsDead,  ///< limits 0 .. 0
  kNearBoundary,    ///< tau_d just inside or outside the boundary
  kSymmetric,       ///< equal limits everywhere and small whole numbers: many ties
  kCount
};

/// A robot's actuation: `base` rows, thrusters, and one direct drive for each joint.
Zonotope random_actuation(Random& random, Kind kind) {
  const int base = random.uniform() < 0.5 ? 3 : 6;
  const int thrusters = base + 1 + static_cast<int>(random.uniform(0, 2));
  const int joints = static_cast<int>(random.uniform(0, 5));
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(base + joints, thrusters + joints);
  for (double& b : B.topLeftCorner(base, thrusters).reshaped()) {
    b = kind == Kind::kSymmetric ? std::round(random.uniform(-1.5, 1.5)) : random.normal();
  }
  B.bottomRightCorner(joints, joints).setIdentity();
  Eigen::VectorXd u_min(thrusters + joints);
  Eigen::VectorXd u_max(thrusters + joints);
  for (Eigen::Index j = 0; j < u_min.size(); ++j) {
    u_min[j] = kind == Kind::kSymmetric ? -2 : random.uniform(-4, -1);
    u_max[j] = kind == Kind::kSymmetric ? 2 : random.uniform(1, 4);
    if (kind == Kind::kEqualLimits && random.uniform() < 0.3) u_max[j] = u_min[j];
  }
  if (kind == Kind::kThrusterIsDead) u_min[0] = u_max[0] = 0;
  return make_zonotope(B, u_min, u_max);
}

/// One column (beta_2) or as many as there are base rows (beta_3), all free, along one of which c
/// points.
WrenchProgram random_program(Random& random, Kind kind, const Zonotope& set) {
  const int n = set.dimension();
  WrenchProgram program;
  program.actuation = &set;
  const int k = random.uniform() < 0.5 ? 1 : std::min(n, 6) - (random.uniform() < 0.5 ? 1 : 0);
  program.W = Matrix6Xd::Identity(6, k);
  program.c_w = Eigen::VectorXd::Unit(k, 0);
  program.w_min = Eigen::VectorXd::Constant(k, -kInfinity);
  program.w_max = Eigen::VectorXd::Constant(k, kInfinity);
  program.JtW.resize(n, k);
  program.tau_d.resize(n);
  for (double& j : program.JtW.reshaped()) {
    j = kind == Kind::kSymmetric ? std::round(random.uniform(-1.5, 1.5)) : random.normal();
  }
  for (double& t : program.tau_d) t = random.normal() * (kind == Kind::kHeavy ? 3 : 0.3);
  if (kind == Kind::kSymmetric) program.tau_d = program.tau_d.array().round();
  if (kind == Kind::kAlongNormal) {
    program.JtW.col(0) = set.N.col(static_cast<int>(random.uniform(0, set.facet_pairs())));
  }
  if (kind == Kind::kParallelAxis) program.JtW.row(n - 1).setZero();
  if (kind == Kind::kNearBoundary) {
    // On a facet, then off by 0 or 1e-12 .. 1e-2 to either side.
    const int j = static_cast<int>(random.uniform(0, set.facet_pairs()));
    const double off = random.uniform() < 0.2 ? 0 : std::pow(10, random.uniform(-12, -2));
    const double target = set.b_max[j] + (random.uniform() < 0.5 ? off : -off);
    program.tau_d += set.N.col(j) * (target - set.N.col(j).dot(program.tau_d));
    if (random.uniform() < 0.5) {
      program.JtW -= set.N.col(j) * (set.N.col(j).transpose() * program.JtW);
    }
  }
  return program;
}

/// How far the program is from changing its verdict: the largest t with b_min + t <= N'(tau_d +
/// J'W w) <= b_max - t for some w; negative when infeasible. A linear program in (w, t).
double margin(const WrenchProgram& program, LpSolver& solver) {
  const Zonotope& set = *program.actuation;
  const int f = set.facet_pairs();
  const int k = program.columns();
  LinearProgram p;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * f, k + 1 + 2 * f);
  const Eigen::MatrixXd G = set.N.transpose() * program.JtW;
  const Eigen::VectorXd offset = set.N.transpose() * program.tau_d;
  A.topLeftCorner(f, k) = G;
  A.block(f, 0, f, k) = -G;
  A.col(k).setOnes();
  A.rightCols(2 * f).setIdentity();
  p.A = A.sparseView();
  p.b.resize(2 * f);
  p.b << set.b_max - offset, offset - set.b_min;
  p.c = Eigen::VectorXd::Unit(A.cols(), k);
  p.l = Eigen::VectorXd::Zero(A.cols());
  p.l.head(k + 1).setConstant(-kInfinity);
  p.u = Eigen::VectorXd::Constant(A.cols(), kInfinity);
  LpSolution solution;
  solver.solve(p, solution);
  return solution.status == Status::kOptimal ? solution.objective : 0;
}

/// For one column, the slope n'J'c of the facet that stops the ray, which is 1/|lambda|.
bool steep(const Capability& capability) { return capability.lambda.norm() < 1e6; }

/// Whether some wrench loads the actuators, or some facet is loaded by the wrenches, less than
/// 1e-6: then a wrench of 1e6 N and more decides feasibility, and the solvers' tolerances decide
/// the verdict.
bool flat(const WrenchProgram& program) {
  const Eigen::MatrixXd G = program.actuation->N.transpose() * program.JtW;
  const auto slopes = G.rowwise().norm().array();
  Eigen::FullPivLU<Eigen::MatrixXd> lu(G);
  lu.setThreshold(1e-6);
  return (slopes > 0 && slopes < 1e-6).any() || lu.rank() < program.columns();
}

struct Tally {
  int compared = 0, infeasible = 0, unclear = 0, flat = 0;
};

class Agreement {
 public:
  Agreement() {
    for (const char* name : {"condensed", "simplex", "clp", "glpk"}) {
      solvers_.emplace_back(name, find_wrench_solver(name).make());
    }
  }

  void check(const WrenchProgram& program, int sample) {
    const bool pure = program.columns() == 1;
    Capability reference;
    (pure ? *facets_ : *solvers_[0].second).solve(program, false, reference);
    compare("simplex, cold", *make_assembled(find_lp_solver("simplex").make()), program, reference,
            sample);
    for (auto& [name, solver] : solvers_) compare(name, *solver, program, reference, sample);
    ++tally.compared;
    tally.infeasible += reference.status == Status::kInfeasible;
  }

  Tally tally;

 private:
  void compare(const std::string& name, WrenchSolver& solver, const WrenchProgram& program,
               const Capability& reference, int sample) {
    Capability capability;
    solver.solve(program, false, capability);
    if (capability.status != reference.status && flat(program)) {
      ++tally.flat;
      return;
    }
    if (capability.status != reference.status) {
      const double distance = margin(program, *margin_solver_);
      if (std::abs(distance) > 1e-6) {
        ADD_FAILURE() << "program " << sample << ": " << name << " says "
                      << to_string(capability.status) << " (" << capability.reason.c_str()
                      << "), not " << to_string(reference.status) << ", at a margin of "
                      << distance;
      }
      ++tally.unclear;
      return;
    }
    if (capability.status != Status::kOptimal) return;
    if (!steep(reference) || !steep(capability)) {
      ++tally.flat;
      return;
    }
    // Where rounding alone decides what is feasible, lambda says by how much beta may move.
    const double distance = std::abs(capability.beta - reference.beta);
    if (distance <= 1e-9 * (1 + std::abs(reference.beta))) return;
    if (std::abs(margin(program, *margin_solver_)) <= 1e-6) {
      ++tally.unclear;
      return;
    }
    ADD_FAILURE() << "program " << sample << ": " << name << " " << capability.beta
                  << " differs by " << distance;
  }

  std::unique_ptr<WrenchSolver> facets_ = find_wrench_solver("facets").make();
  std::unique_ptr<LpSolver> margin_solver_ = find_lp_solver("simplex").make();
  std::vector<std::pair<std::string, std::unique_ptr<WrenchSolver>>> solvers_;
};

TEST(Agreement, EverySolverGivesTheSameAnswerOnRandomWrenchPrograms) {
  // 2,000 robots with 50 programs each (fewer under sanitizers); a robot's solvers are warm from
  // one program to the next.
  Random random(1);
  int sample = 0;
  Tally total;
  for (int robot = 0; robot < samples(2000); ++robot) {
    const Kind kind = static_cast<Kind>(robot % static_cast<int>(Kind::kCount));
    const Zonotope set = random_actuation(random, kind);
    Agreement agreement;
    for (int i = 0; i < (kSanitized ? 10 : 50); ++i) {
      agreement.check(random_program(random, kind, set), sample++);
    }
    total.compared += agreement.tally.compared;
    total.infeasible += agreement.tally.infeasible;
    total.unclear += agreement.tally.unclear;
    total.flat += agreement.tally.flat;
  }
  fmt::print("{} programs, {} infeasible; left out: {} at the boundary, {} flat\n", total.compared,
             total.infeasible, total.unclear, total.flat);
  EXPECT_GT(total.infeasible, total.compared / 20);
  EXPECT_LT(total.unclear + total.flat, total.compared / 10);
}

TEST(Agreement, AnswersSatisfyTheirPrograms) {
  Random random(2);
  std::map<std::string, int> optimal;
  for (int robot = 0; robot < samples(200); ++robot) {
    const Kind kind = static_cast<Kind>(robot % static_cast<int>(Kind::kCount));
    const Zonotope set = random_actuation(random, kind);
    const WrenchProgram program = random_program(random, kind, set);
    for (const char* name : {"facets", "condensed", "simplex", "clp", "glpk"}) {
      if (program.columns() > 1 && find_wrench_solver(name).one_column_only) continue;
      Capability capability;
      find_wrench_solver(name).make()->solve(program, true, capability);
      if (capability.status != Status::kOptimal) continue;
      ++optimal[name];
      const Residual residual = recheck(program, capability.u, capability.w, capability.lambda);
      // A slope |n'J'c| of 1e-6 turns rounding of the limits into 1e6 of it in w.
      if (!steep(capability)) continue;
      EXPECT_TRUE(residual.within(1e-7 * (1 + std::abs(capability.beta))))
          << name << " " << robot << ": " << residual.balance << " " << residual.bounds << " "
          << residual.dual << " " << residual.gap;
    }
  }
  EXPECT_EQ(optimal["condensed"], optimal["simplex"]);
}

TEST(Agreement, InfeasibleIsProvedWithOrWithoutEfforts) {
  // Both kinds of loads that have no balance, far off and at the boundary; whoever says so proves
  // it by its multipliers, also in the loop of a search, which asks for no efforts.
  Random random(8);
  std::map<std::string, int> infeasible, undecided;
  for (int sample = 0; sample < samples(20000); ++sample) {
    const Kind kind = sample % 2 == 0 ? Kind::kHeavy : Kind::kNearBoundary;
    const Zonotope set = random_actuation(random, kind);
    const WrenchProgram program = random_program(random, kind, set);
    for (const char* name : {"facets", "condensed"}) {
      if (program.columns() > 1 && find_wrench_solver(name).one_column_only) continue;
      Capability capability;
      find_wrench_solver(name).make()->solve(program, false, capability);
      undecided[name] += capability.status == Status::kNumericalError;
      if (capability.status != Status::kInfeasible) continue;
      ++infeasible[name];
      EXPECT_TRUE(proves_infeasible(program, capability.lambda)) << name << " " << sample;
    }
  }
  for (const auto& [name, count] : infeasible) {
    fmt::print("{}: {} infeasible, {} undecided\n", name, count, undecided[name]);
    EXPECT_GT(count, samples(2000)) << name;
    EXPECT_LE(undecided[name], count / 200) << name;
  }
}

TEST(Box, OneSidedAndBoundedColumns) {
  // A push-only column w >= 0, and one between two limits, against the general simplex.
  Random random(3);
  int at_bound = 0;
  for (int sample = 0; sample < samples(2000); ++sample) {
    const Zonotope set = random_actuation(random, Kind::kPlain);
    WrenchProgram program = random_program(random, Kind::kPlain, set);
    const int k = program.columns();
    program.w_min[k - 1] = 0;
    program.w_max[0] = 0.5;
    Capability a;
    Capability b;
    find_wrench_solver("condensed").make()->solve(program, false, a);
    find_wrench_solver("simplex").make()->solve(program, false, b);
    ASSERT_EQ(a.status, b.status) << sample << " " << a.reason.c_str() << " " << b.reason.c_str();
    if (a.status != Status::kOptimal) continue;
    EXPECT_NEAR(a.beta, b.beta, 1e-9 * (1 + std::abs(b.beta))) << sample;
    at_bound += a.beta > 0.5 - 1e-12;
  }
  EXPECT_GT(at_bound, samples(10));
}

TEST(Box, WithoutFacetsAndWithoutLoad) {
  Random random(4);
  Zonotope set = random_actuation(random, Kind::kPlain);
  WrenchProgram program = random_program(random, Kind::kPlain, set);
  Capability with;
  Capability without;
  find_wrench_solver("condensed").make()->solve(program, true, with);
  set = make_zonotope(set.B, set.u_min, set.u_max, 0);
  ASSERT_FALSE(set.has_facets);
  find_wrench_solver("condensed").make()->solve(program, true, without);
  ASSERT_EQ(with.status, without.status);
  EXPECT_NEAR(with.beta, without.beta, 1e-9 * (1 + std::abs(with.beta)));
  program.JtW.setZero();
  program.tau_d.setZero();
  set = make_zonotope(set.B, set.u_min, set.u_max);
  find_wrench_solver("condensed").make()->solve(program, false, with);
  EXPECT_EQ(with.status, Status::kUnbounded);
}

TEST(Box, AnswersDoNotDependOnEarlierOnesAndAllocateNothing) {
  Random random(5);
  const Zonotope set = random_actuation(random, Kind::kPlain);
  std::vector<WrenchProgram> programs;
  while (programs.size() < 50) {
    WrenchProgram program = random_program(random, Kind::kPlain, set);
    if (program.columns() > 1 && (programs.empty() || program.columns() == programs[0].columns())) {
      programs.push_back(program);
    }
  }
  const auto warm = find_wrench_solver("condensed").make();
  Capability capability;
  warm->solve(programs[0], false, capability);
  for (const WrenchProgram& program : programs) {
    const long before = allocation_count();
    warm->solve(program, false, capability);
    EXPECT_EQ(allocation_count(), before);
    Capability fresh;
    find_wrench_solver("condensed").make()->solve(program, false, fresh);
    EXPECT_EQ(capability.beta, fresh.beta);
    EXPECT_EQ(capability.lambda, fresh.lambda);
  }
}

}  // namespace
}  // namespace maxwrench
