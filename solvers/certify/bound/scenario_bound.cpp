#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "lib/scenario/current_load.h"
#include "lib/scenario/scenario_list.h"
#include "solvers/certify/bound/bounds.h"

namespace maxwrench {
namespace {

/// The most scenarios that a bound goes through in each box.
constexpr long kMostBounded = 100;

/// An ordinary task with the value of one scenario, times the length of its wrench.
Problem task_of(const Problem& problem, const ScenarioChoice& choice) {
  const ScenarioList& list = problem.scenarios;
  Problem one = problem;
  one.scenarios = {};
  one.c = list.wrenches[static_cast<std::size_t>(choice.wrench)].c.normalized();
  one.robot.actuation = list.limits[static_cast<std::size_t>(choice.limits)].actuation;
  for (std::size_t group = 0; group < choice.cases.size(); ++group) {
    const LoadCase& load = list.loads[group][static_cast<std::size_t>(choice.cases[group])];
    for (const LinkLoad& change : load.loads) {
      Link& link = one.robot.links[static_cast<std::size_t>(change.link)];
      const Eigen::Vector3d moment = link.mass * link.com + change.moment;
      link.mass += change.mass;
      if (link.mass != 0) link.com = moment / link.mass;
    }
  }
  for (const Link& link : one.robot.links) {
    if (link.mass >= 0 && link.com.allFinite()) continue;
    throw std::invalid_argument("certify: got " + link.name +
                                " without mass, expected a mass >= 0 in each scenario");
  }
  return one;
}

/// Whether a bound of this scenario alone can be computed. Leaving a scenario out keeps a bound.
bool counts(const Problem& problem, const ScenarioChoice& choice) {
  const ScenarioList& list = problem.scenarios;
  const Zonotope& limits = list.limits[static_cast<std::size_t>(choice.limits)].actuation;
  return !list.wrenches[static_cast<std::size_t>(choice.wrench)].hold && limits.u_min.allFinite() &&
         limits.u_max.allFinite();
}

void require_bounded(const Problem& problem, Wrench wrench) {
  const ScenarioList& list = problem.scenarios;
  const auto reject = [&](const std::string& got, const std::string& expected) {
    throw std::invalid_argument("certify: got " + got + ", expected " + expected + " (" +
                                problem.name + ")");
  };
  if (wrench == Wrench::kAny) reject("wrench any", "pure for a list of scenarios");
  if (list.ball) reject("a ball", "a set of wrenches");
  if (has_current(list)) reject("currents", "loads without currents");
  if (list.payload && problem.free.count() > 0) {
    reject("a payload at a pose that is partly free", "a fixed pose");
  }
  if (list.count() > kMostBounded) {
    reject(std::to_string(list.count()) + " scenarios", "at most " + std::to_string(kMostBounded));
  }
}

class ScenarioBound final : public Bound {
 public:
  explicit ScenarioBound(const Problem& problem)
      : tasks_(std::make_shared<std::vector<std::unique_ptr<const Problem>>>()) {
    ScenarioChoice choice;
    choice.cases.resize(problem.scenarios.loads.size());
    do {
      if (!counts(problem, choice)) continue;
      tasks_->push_back(std::make_unique<const Problem>(task_of(problem, choice)));
      const ScenarioWrench& wrench =
          problem.scenarios.wrenches[static_cast<std::size_t>(choice.wrench)];
      parts_.push_back({make_pure_bound(*tasks_->back(), "linf_polytope"), wrench.c.norm()});
    } while (next(problem.scenarios, choice));
    if (parts_.empty()) {
      throw std::invalid_argument("certify: got no scenario with a wrench and finite limits");
    }
    // The scenarios with the least ceilings cut most.
    std::stable_sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) {
      return a.bound->ceiling() / a.length < b.bound->ceiling() / b.length;
    });
  }

  double ceiling() const override {
    double least = kInfinity;
    for (const Part& part : parts_) least = std::min(least, part.bound->ceiling() / part.length);
    return least;
  }

  void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low, double high,
                BoxProof& proof) override {
    const BoxProof given = proof;
    proof.forget(high);
    for (const Part& part : parts_) {
      BoxProof own = given;
      part.bound->evaluate(lower, upper, low * part.length, proof.high * part.length, own);
      if (own.high / part.length <= proof.high) {
        own.high /= part.length;
        proof = own;
      }
      if (proof.high <= low || proof.kind == BoxProof::Kind::kNoPosture) return;
    }
  }

  // All scenarios have the same postures.
  void extend(Eigen::VectorXd& lower, Eigen::VectorXd& upper) const override {
    parts_.front().bound->extend(lower, upper);
  }
  bool shrink(Eigen::VectorXd& lower, Eigen::VectorXd& upper, std::vector<BoxCut>* cuts) override {
    return parts_.front().bound->shrink(lower, upper, cuts);
  }

  std::unique_ptr<Bound> clone() const override {
    auto copy = std::unique_ptr<ScenarioBound>(new ScenarioBound);
    copy->tasks_ = tasks_;
    for (const Part& part : parts_) copy->parts_.push_back({part.bound->clone(), part.length});
    return copy;
  }

 private:
  struct Part {
    std::unique_ptr<Bound> bound;
    double length;  ///< of the wrench of the scenario
  };
  ScenarioBound() = default;

  std::shared_ptr<std::vector<std::unique_ptr<const Problem>>> tasks_;
  std::vector<Part> parts_;
};

}  // namespace

std::unique_ptr<Bound> make_scenario_bound(const Problem& problem, Wrench wrench) {
  require_bounded(problem, wrench);
  return std::make_unique<ScenarioBound>(problem);
}

}  // namespace maxwrench
