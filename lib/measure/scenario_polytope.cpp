#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "lib/scenario/ball_across.h"
#include "lib/scenario/scenario_facets.h"
#include "lib/scenario/scenario_program.h"
#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/wrench_solver.h"

namespace maxwrench {
namespace {

/// The largest difference, likewise, at which facets and solver count as equal.
constexpr double kAgreement = 1e-7;

double allowed(double tolerance, double end) { return tolerance * (1 + std::abs(end)); }

class ScenarioPolytope : public Measure {
 public:
  ScenarioPolytope(const Problem& problem, Wrench wrench, std::unique_ptr<WrenchSolver> solver,
                   bool facets)
      : list_(problem.scenarios),
        solver_(std::move(solver)),
        at_(problem),
        program_(problem, wrench) {
    const bool one_column = wrench == Wrench::kPure || list_.F.cols() == 0;
    if (facets && one_column && ScenarioFacets::supports(problem)) facets_.emplace(problem);
    if (list_.ball && !facets_) {
      if (!BallAcross::supports(list_)) {
        throw std::invalid_argument(
            "wrench: got a ball, expected solver facets and pure wrenches, or a ball of one or two "
            "axes alone, or a set in its place");
      }
      ball_.emplace(problem, wrench);
    }
    each_.cases.resize(list_.loads.size());
  }

  void evaluate_well_formed(const Posture& posture, const WrenchProgram& /*program*/, bool efforts,
                            Capability& capability) override {
    at_.set(posture);
    iterations_ = 0;
    const Verdict verdict = facets_ ? by_facets(efforts, capability)
                            : ball_ ? by_edges(efforts, capability)
                                    : one_by_one(efforts, capability);
    if (verdict.status != Status::kOptimal) capability.clear();
    capability.iterations = iterations_;
    capability.conclude(verdict.status, verdict.reason.c_str());
  }
  bool solves_program() const override { return true; }

 private:
  /// Solves a scenario for its upper end (1) or its lower end (-1). Its `beta` is then the end.
  Status solve(const ScenarioChoice& choice, double sign, double most, bool efforts,
               Capability& result) {
    program_.write(at_, choice);
    solver_->solve(program_.aim(sign, most), efforts, result);
    iterations_ += result.iterations;
    result.beta *= sign;
    return result.status;
  }

  // By facets.

  Verdict by_facets(bool efforts, Capability& capability) {
    ScenarioFacets& facets = *facets_;
    facets.scan(at_);
    if (facets.missed || facets.low > facets.high + allowed(kEndTolerance, facets.high)) {
      return efforts ? confirmed_conflict() : conflict();
    }
    if (!facets.high_scenario(at_, capability.decides) || !std::isfinite(facets.high)) {
      Verdict verdict;
      verdict.conclude(Status::kUnbounded, "the wrench does not load any actuator");
      return verdict;
    }
    if (efforts) {
      solve(capability.decides, 1, kInfinity, true, capability);
      const bool agrees =
          capability.status == Status::kOptimal &&
          std::abs(capability.beta - facets.high) <= allowed(kAgreement, facets.high);
      if (!agrees) return unlike("the scenario that decides has another value by the solver");
    }
    capability.beta = facets.high;
    capability.w.setConstant(1, facets.high);
    facets.fill_slope(capability.lambda);
    return finish(efforts, efforts, capability);
  }

  static Verdict conflict() {
    Verdict verdict;
    verdict.conclude(Status::kInfeasible, "no factor suits all scenarios");
    return verdict;
  }
  static Verdict unlike(const char* why) {
    Verdict verdict;
    verdict.conclude(Status::kNumericalError, why);
    return verdict;
  }

  /// Solves the one or two scenarios that leave no factor, and names them.
  Verdict confirmed_conflict() {
    Verdict verdict;
    ScenarioChoice last;
    const bool has_low = facets_->low_scenario(at_, last);
    if (facets_->missed) {
      if (solve(last, 1, kInfinity, true, trial_) != Status::kInfeasible) {
        return unlike("a scenario is infeasible by facets, but not by the solver");
      }
      verdict.conclude(Status::kInfeasible,
                       "no actuator efforts balance the posture: " + describe(list_, last));
      return verdict;
    }
    ScenarioChoice first;
    facets_->high_scenario(at_, first);
    const std::string name = describe(list_, first);
    const Status at_most = solve(first, 1, kInfinity, true, trial_);
    const double high = trial_.beta;
    double low = 0;  // of a list that requires beta >= 0
    if (at_most == Status::kOptimal && has_low) {
      if (solve(last, -1, kInfinity, true, trial_) == Status::kOptimal) low = trial_.beta;
    }
    if (at_most != Status::kInfeasible && trial_.status != Status::kInfeasible &&
        !(low > high && trial_.status == Status::kOptimal)) {
      return unlike("two scenarios leave no factor by facets, but some by the solver");
    }
    const std::string other = has_low ? describe(list_, last) : "";
    if (!has_low) {
      verdict.conclude(Status::kInfeasible,
                       fmt::format("no factor >= 0: at most {:.6g} ({})", facets_->high, name));
    } else if (name == other) {
      verdict.conclude(Status::kInfeasible, "no actuator efforts balance the posture: " + name);
    } else {
      verdict.conclude(Status::kInfeasible,
                       fmt::format("no factor suits all: at most {:.6g} ({}), at least {:.6g} ({})",
                                   facets_->high, name, facets_->low, other));
    }
    return verdict;
  }

  // One by one.

  /// Goes through the list with beta at most the least upper end so far. Scenarios before the last
  /// one that lowered it may start above it, so these are tried again.
  Verdict one_by_one(bool efforts, Capability& capability) {
    double high = kInfinity;
    long decider = -1, number = 0;
    const auto for_each = [&](const auto& visit) {
      each_.wrench = each_.limits = 0;
      std::fill(each_.cases.begin(), each_.cases.end(), 0);
      number = 0;
      do {
        each_.c = at_.wrench(each_.wrench);
        if (!visit()) return false;
        ++number;
      } while (next(list_, each_));
      return true;
    };
    Verdict ended;
    const auto within = [&](double most) {
      const Status status = solve(each_, 1, most, efforts, trial_);
      if (status == Status::kOptimal || status == Status::kUnbounded) return true;
      ended.conclude(status, status == Status::kInfeasible ? why_infeasible(most, efforts)
                                                           : trial_.reason.str());
      return false;
    };
    const bool all = for_each([&] {
      if (!within(high)) return false;
      if (trial_.status != Status::kOptimal || !(trial_.beta < high)) return true;
      // An interior point solver ends just below the end so far, too.
      const bool near = high < kInfinity && trial_.beta > high - allowed(kAgreement, high);
      if (near) {
        if (!within(kInfinity)) return false;
        if (trial_.status != Status::kOptimal || !(trial_.beta < high)) return true;
      }
      high = trial_.beta;
      decider = number;
      capability.decides = each_;
      return true;
    });
    if (!all) return ended;
    if (decider < 0) {
      ended.conclude(Status::kUnbounded, "the wrench does not load any actuator");
      return ended;
    }
    if (list_.non_negative && high < -allowed(kEndTolerance, high)) {
      ended.conclude(Status::kInfeasible, "no factor >= 0");
      return ended;
    }
    const double limit = high + allowed(kEndTolerance, high);
    const long last = decider;
    if (!for_each([&] { return number >= last || within(limit); })) return ended;
    if (solve(capability.decides, 1, kInfinity, efforts, capability) != Status::kOptimal) {
      return unlike("the scenario that decides has no value when it is solved again");
    }
    if (!(std::abs(capability.beta - high) <= allowed(kAgreement, high))) {
      return unlike("the scenario that decides has another value when it is solved again");
    }
    return finish(true, efforts, capability);
  }

  // A ball by the edges of the polygon in its plane.

  /// A scenario after the other. Those with `hold` are part of the others, which contain zero.
  Verdict by_edges(bool efforts, Capability& capability) {
    Verdict ended;
    double high = kInfinity;
    each_.wrench = each_.limits = 0;
    std::fill(each_.cases.begin(), each_.cases.end(), 0);
    do {
      if (list_.wrenches[static_cast<std::size_t>(each_.wrench)].hold) continue;
      const Status status = ball_->find(at_, each_, high, *solver_);
      iterations_ += ball_->iterations;
      if (status == Status::kUnbounded) continue;
      if (status == Status::kInfeasible) {
        ended.conclude(status, why_infeasible(kInfinity, efforts));
        return ended;
      }
      if (status != Status::kOptimal) {
        ended.conclude(status, ball_->result.reason.str());
        return ended;
      }
      if (ball_->high < -allowed(kEndTolerance, ball_->high)) return leaves_out_zero(efforts);
      if (!(ball_->high < high)) continue;
      high = ball_->high;
      capability.decides = each_;
    } while (next(list_, each_));
    if (high == kInfinity) {
      ended.conclude(Status::kUnbounded, "the wrench does not load any actuator");
      return ended;
    }
    if (solve(capability.decides, 1, kInfinity, efforts, capability) != Status::kOptimal) {
      return unlike("the wrench that decides has no value when it is solved again");
    }
    if (!(std::abs(capability.beta - high) <= allowed(kAgreement, high))) {
      return unlike("the wrench that decides has another value when it is solved again");
    }
    return finish(true, efforts, capability);
  }

  /// Confirms that the wrench zero of the ball balances nothing.
  Verdict leaves_out_zero(bool efforts) {
    const std::string name = describe(list_, each_);
    each_.c.setZero();
    if (solve(each_, 1, kInfinity, efforts, trial_) != Status::kInfeasible) {
      return unlike("a ball leaves out zero, but some efforts balance it");
    }
    Verdict verdict;
    verdict.conclude(
        Status::kInfeasible,
        "no actuator efforts balance the posture without a wrench of the ball: " + name);
    return verdict;
  }

  std::string why_infeasible(double most, bool efforts) const {
    if (most == kInfinity) {
      return "no actuator efforts balance the posture" +
             (efforts ? ": " + describe(list_, each_) : "");
    }
    return "no factor suits all scenarios" +
           (efforts ? fmt::format(": at most {:.6g}, but not {}", most, describe(list_, each_))
                    : "");
  }

  /// Fills what follows from beta, w and lambda. If `solved`, `program_` is that of the scenario
  /// that decides, and efforts may have been computed.
  Verdict finish(bool solved, bool efforts, Capability& capability) {
    if (solved) {
      fill_wrenches(at_.posture(), program_.aim(1), capability);
    } else {
      capability.h = capability.beta * capability.decides.c;
      capability.beta_J.noalias() = capability.h * capability.lambda.transpose();
    }
    if (efforts) {
      capability.residual = recheck(program_.aim(1), capability.u, capability.w, capability.lambda);
    } else {
      capability.u.setZero();
      capability.residual = {};
    }
    Verdict verdict;
    verdict.conclude(Status::kOptimal);
    return verdict;
  }

  const ScenarioList& list_;
  std::unique_ptr<WrenchSolver> solver_;
  ScenarioPosture at_;
  ScenarioProgram program_;
  std::optional<ScenarioFacets> facets_;
  std::optional<BallAcross> ball_;
  Capability trial_;
  ScenarioChoice each_;
  int iterations_ = 0;
};

}  // namespace

std::unique_ptr<Measure> make_scenario_polytope(const Problem& problem, Wrench wrench,
                                                std::unique_ptr<WrenchSolver> solver, bool facets) {
  return std::make_unique<ScenarioPolytope>(problem, wrench, std::move(solver), facets);
}

}  // namespace maxwrench
