#include "cli/proof/plan_bounds.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/cli.h"
#include "cli/ctrl_c.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "maxwrench/version.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

void print_bound_object(const PlanBound& bound, const Problem& problem) {
  const Answer& answer = bound.answer;
  const bool found = answer.has_value();
  print_json({{"problem", problem.name},
              {"scheme", to_string(problem.motion->scheme)},
              {"status", to_string(bound.status)},
              {"reason", bound.reason.str()},
              {"value", known(found, answer.beta())},
              {"bound", known(std::isfinite(bound.bound), bound.bound)},
              {"unit", answer.unit},
              {"gap", known(std::isfinite(bound.gap()), bound.gap())},
              {"t", known(std::isfinite(bound.t), bound.t)},
              {"allowed", known(std::isfinite(bound.allowed), bound.allowed)},
              {"collision", problem.robot.collision != nullptr},
              {"certificate", false},
              {"boxes", bound.boxes},
              {"search", answer.choice.search},
              {"search_s", bound.search_s},
              {"wall_s", bound.seconds},
              {"version", version()}});
}

void print_bound_text(const PlanBound& bound, const Problem& problem, bool given) {
  const Answer& answer = bound.answer;
  fmt::print("{}  scheme {}{}\n{}{}{}\n", problem.name, to_string(problem.motion->scheme),
             problem.robot.collision ? "" : "  collisions ignored", to_string(bound.status),
             bound.reason.empty() ? "" : ": ", bound.reason.c_str());
  if (answer.has_value()) {
    fmt::print("value     {:>9.5f} {}: {}\n", answer.beta(), answer.unit,
               given ? "of the given trajectory" : "of the best trajectory found");
  }
  if (std::isfinite(bound.bound)) {
    fmt::print("bound     {:>9.5f} {}: no trajectory has more, by the instant t = {:.5g} s\n",
               bound.bound, answer.unit, bound.t);
  } else if (bound.status == Status::kInfeasible) {
    fmt::print("bound     no trajectory has a value, by the instant t = {:.5g} s\n", bound.t);
  } else {
    fmt::print("bound     none proven\n");
  }
  if (answer.has_value()) {
    fmt::print("gap       {}\n", std::isfinite(bound.gap()) ? percent(bound.gap()) : "unknown");
  }
  fmt::print("boxes     {} in {:.3g} s{}\n", bound.boxes, bound.seconds,
             given ? "" : fmt::format(", after a search of {:.3g} s", bound.search_s));
  fmt::print("no certificate: rounding is counted, but nothing else checks this bound\n");
}

}  // namespace

int bound_trajectories(const Problem& problem, Options options, ProofOptions how,
                       const Eigen::MatrixXd& knots, bool json) {
  CtrlC ctrl_c;
  options.interrupted = ctrl_c.asked();
  const bool given = knots.size() > 0;
  std::optional<Progress> search;
  if (!given) {
    search.emplace("search", kUsualBudget);
    options.progress = search->counter();
  }
  std::optional<ProgressLine> line;
  how.progress = [&](double most, double value) {
    if (search) search->finish();
    if (!line) line.emplace();
    line->show(fmt::format("bound {:.5g}, value {:.5g}", most, value));
  };
  const PlanBound bound = bound_trajectories(problem, options, how, knots);
  line.reset();
  if (json) {
    print_bound_object(bound, problem);
  } else {
    print_bound_text(bound, problem, given);
  }
  return bound.status == Status::kProven ? kAnswered : kOtherStatus;
}

}  // namespace maxwrench
