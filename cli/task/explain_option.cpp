#include "cli/task/explain_option.h"

#include <fmt/format.h>

#include "cli/cli.h"
#include "maxwrench/explain.h"

namespace maxwrench {

void ExplainOption::add(CLI::App& app) {
  app.add_flag("--explain", explain, "say which limits bind, and what more of each would give");
  app.add_option("--share", share, "with --explain: the share of the wrench for the least efforts")
      ->check(CLI::Range(0.0, 1.0))
      ->needs("--explain");
}

int ExplainOption::report(const Answer& answer, bool json) const {
  if (!explain) return maxwrench::report(answer, json);
  const Explanation explanation = maxwrench::explain(answer, {share.value_or(1)});
  fmt::print("{}",
             json ? to_json(answer, explanation) + "\n" : summary(answer) + summary(explanation));
  return answer.answered() ? kAnswered : kOtherStatus;
}

}  // namespace maxwrench
