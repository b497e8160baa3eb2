#include <glpk.h>
#include <gtest/gtest.h>

#include <memory>
#include <thread>

#include "lib/math/random.h"
#include "maxwrench/strategies.h"
#include "tests/support/programs.h"
#include "tests/support/support.h"

#if defined(MAXWRENCH_SANITIZED)
#include <sanitizer/lsan_interface.h>
#endif

namespace maxwrench {
namespace {

/// GLPK's environment of a thread is its host's to free; tests that play the host leave it, and
/// what failed calls leave in it, to the end of the process.
#if defined(MAXWRENCH_SANITIZED)
using LeaksForgiven = __lsan::ScopedDisabler;
#else
struct LeaksForgiven {
  LeaksForgiven() {}
};
#endif

/// A problem of a program that uses GLPK itself: max x, x <= 5.
class HostProblem {
 public:
  HostProblem() : problem_(glp_create_prob()) {
    glp_set_obj_dir(problem_, GLP_MAX);
    glp_add_cols(problem_, 1);
    glp_set_col_bnds(problem_, 1, GLP_UP, 0, 5);
    glp_set_obj_coef(problem_, 1, 1);
  }
  ~HostProblem() {
    optimum = solve();
    glp_delete_prob(problem_);
  }
  HostProblem(const HostProblem&) = delete;
  HostProblem& operator=(const HostProblem&) = delete;
  double solve() {
    glp_smcp options;
    glp_init_smcp(&options);
    options.msg_lev = GLP_MSG_OFF;
    glp_simplex(problem_, &options);
    return glp_get_obj_val(problem_);
  }
  static double optimum;  ///< found by the last one before it went

 private:
  glp_prob* problem_;
};
double HostProblem::optimum = 0;

TEST(Glpk, LeavesTheProblemsOfItsHostAlone) {
  // The host's problem outlives all that is ours, whoever opened GLPK first in the thread.
  for (const bool host_first : {true, false}) {
    HostProblem::optimum = 0;
    std::thread([&] {
      const LeaksForgiven forgiven;
      thread_local std::unique_ptr<HostProblem> host;  // made first, so it goes last
      host.reset();
      LpSolution solution;
      const auto solver = find_lp_solver("glpk").make();
      if (!host_first) solver->solve(small_program(), solution);
      host = std::make_unique<HostProblem>();
      glp_term_out(GLP_ON);
      solver->solve(small_program(), solution);
      EXPECT_EQ(solution.status, Status::kOptimal);
      EXPECT_EQ(host->solve(), 5);
      EXPECT_EQ(glp_term_out(GLP_OFF), GLP_ON);  // as the host had it
    }).join();
    EXPECT_EQ(HostProblem::optimum, 5) << host_first;
  }
}

TEST(Glpk, FailedCallsLeaveTheHostAlone) {
  // From bases drawn at random GLPK now and then ends in a failed assertion. What such a call
  // leaves behind shows that there was one: memory that only the end of all would free.
  std::thread([] {
    const LeaksForgiven forgiven;
    HostProblem host;
    const auto blocks = [] {
      int count = 0;
      glp_mem_usage(&count, nullptr, nullptr, nullptr);
      return count;
    };
    EXPECT_EQ(host.solve(), 5);
    const int before = blocks();
    Random random(4);
    testing::internal::CaptureStdout();
    for (int sample = 0; sample < 500; ++sample) {
      const LinearProgram program = random_program(random, 4, 7, true);
      LpSolution solution;
      for (int i = 0; i < 11; ++i) {
        solution.basis.push_back(static_cast<VariableState>(random.next() % 4));
      }
      find_lp_solver("glpk").make()->solve(program, solution);
      if (solution.status != Status::kNumericalError) expect_verified(program, solution);
    }
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_GT(blocks(), before);
    EXPECT_EQ(host.solve(), 5);
  }).join();
}

}  // namespace
}  // namespace maxwrench
