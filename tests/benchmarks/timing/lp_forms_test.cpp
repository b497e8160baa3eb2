#include "benchmarks/timing/lp_forms.h"

#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

TEST(Forms, HaveTheSameOptimumAndVerdict) {
  for (const char* name : {"planar/force", "uvms/valve"}) {
    const Problem problem = load_problem(name);
    PostureEvaluator model(problem, false);
    for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
      WrenchProgram program = make_wrench_program(problem, wrench);
      Random random(1);
      const auto simplex = find_lp_solver("simplex").make();
      for (int sample = 0; sample < samples(100); ++sample) {
        set_posture(model.evaluate(random_theta_r(problem, random)), program);
        for (double& t : program.tau_d) t += (sample % 2 == 0 ? 0.1 : 100) * random.normal();
        Capability expected;
        find_wrench_solver("condensed").make()->solve(program, false, expected);
        for (const ProgramForm form :
             {ProgramForm::kPaper, ProgramForm::kSubstituted, ProgramForm::kReduced}) {
          LpSolution solution;
          simplex->solve(make_form(program, form), solution);
          ASSERT_STREQ(to_string(solution.status), to_string(expected.status))
              << name << " " << to_string(form);
          if (expected.status != Status::kOptimal) continue;
          const double offset = form == ProgramForm::kReduced ? reduce(program).offset : 0;
          EXPECT_NEAR(solution.objective + offset, expected.beta,
                      1e-8 * (1 + std::abs(expected.beta)))
              << name << " " << to_string(form);
        }
      }
    }
  }
}

}  // namespace
}  // namespace maxwrench
