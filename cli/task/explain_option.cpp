#include "cli/task/explain_option.h"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

#include "cli/cli.h"
#include "maxwrench/explain.h"

namespace maxwrench {

void ExplainOption::add(CLI::App& app) {
  app.add_flag("--explain", explain, "say which limits bind, and what more of each would give");
  app.add_option("--share", share, "with --explain: the share of the wrench for the least efforts")
      ->check(CLI::Range(0.0, 1.0))
      ->needs("--explain");
}

void ExplainOption::take_share(std::optional<std::string>& at) {
  if (!explain || !at || at->find_first_of(" /,") != std::string::npos) return;
  const auto reject = [&at](const char* expected) {
    throw std::invalid_argument(fmt::format("--at: got '{}', expected {}", *at, expected));
  };
  if (share) reject("no such option beside --share");
  double number = 0;
  const auto [end, error] = std::from_chars(at->data(), at->data() + at->size(), number);
  if (error != std::errc() || end != at->data() + at->size() || !(number >= 0 && number <= 1)) {
    reject("a share from 0 to 1, with --explain");
  }
  share = number;
  at.reset();
}

int ExplainOption::report(const Answer& answer, bool json) const {
  if (!explain) return maxwrench::report(answer, json);
  const Explanation explanation = maxwrench::explain(answer, {share.value_or(1)});
  fmt::print("{}",
             json ? to_json(answer, explanation) + "\n" : summary(answer) + summary(explanation));
  return answer.answered() ? kAnswered : kOtherStatus;
}

}  // namespace maxwrench
