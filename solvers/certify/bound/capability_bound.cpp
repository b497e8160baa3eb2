#include <stdexcept>

#include "lib/robot/gears.h"
#include "maxwrench/problem.h"
#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/bound/loop_posture.h"

namespace maxwrench {
namespace {

/// The collision bound and another one: a box that collides throughout has no value.
class CapabilityBound final : public Bound {
 public:
  CapabilityBound(std::unique_ptr<Bound> measure, std::unique_ptr<Bound> collision)
      : measure_(std::move(measure)), collision_(std::move(collision)) {}

  int left_out() const override { return measure_->left_out(); }
  double ceiling() const override { return measure_->ceiling(); }

  void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low, double high,
                BoxProof& proof) override {
    if (collision_) {
      collision_->evaluate(lower, upper, low, high, proof);
      if (proof.kind == BoxProof::Kind::kCollision) return;
    }
    measure_->evaluate(lower, upper, low, high, proof);
  }

  void extend(Eigen::VectorXd& lower, Eigen::VectorXd& upper) const override {
    measure_->extend(lower, upper);
  }
  bool shrink(Eigen::VectorXd& lower, Eigen::VectorXd& upper, std::vector<BoxCut>* cuts) override {
    return measure_->shrink(lower, upper, cuts);
  }

  std::unique_ptr<Bound> clone() const override {
    return std::make_unique<CapabilityBound>(measure_->clone(),
                                             collision_ ? collision_->clone() : nullptr);
  }

 private:
  std::unique_ptr<Bound> measure_, collision_;
};

std::unique_ptr<Bound> measure_bound(const Problem& problem, const std::string& measure,
                                     Wrench wrench, std::optional<int> left_out) {
  if (!problem.scenarios.empty() && measure != "linf_polytope") {
    throw std::invalid_argument("measure: got '" + measure +
                                "', expected linf_polytope for a list of scenarios");
  }
  const bool any = wrench == Wrench::kAny;
  if (measure != "linf_polytope" && measure != "l2_polytope" && measure != "ellipsoid") {
    throw std::invalid_argument("measure: got '" + measure +
                                "', expected linf_polytope, l2_polytope or ellipsoid for a proof");
  }
  if (any && measure != "linf_polytope") {
    throw std::invalid_argument("wrench: got 'any', expected pure for a proof of measure " +
                                measure);
  }
  if (any && problem.contact) {
    throw std::invalid_argument(
        problem.name + ": wrench: got 'any', expected pure for a proof with a second contact");
  }
  if (any && !problem.dependent.empty() && !problem.scenarios.empty()) {
    throw std::invalid_argument(
        problem.name +
        ": wrench: got 'any', expected pure for a proof of a list with dependent joints");
  }
  if (measure == "ellipsoid" && problem.contact_columns() > 0) {
    throw std::invalid_argument(
        problem.name +
        ": measure: got 'ellipsoid', expected linf_polytope or l2_polytope for a proof "
        "with forces of a second contact");
  }
  if (!problem.scenarios.empty()) return make_list_bound(problem, wrench);
  if (!any || (problem.W_any.cols() == 1 && !problem.dependent.empty())) {
    return make_pure_bound(problem, measure, left_out);
  }
  return problem.dependent.empty() ? make_any_wrench_bound(problem) : make_free_bound(problem);
}

std::unique_ptr<Bound> make_bound(const Problem& problem, const std::string& measure, Wrench wrench,
                                  std::optional<int> left_out) {
  if (problem.motion) {
    throw std::invalid_argument(problem.name + ": got a task in time (" + problem.type() +
                                "), expected a static task for a proof");
  }
  if (const auto gears = gears_at(problem.robot, problem.end_effector); !gears.empty()) {
    const Joint& joint = problem.robot.joints[static_cast<std::size_t>(gears.front())];
    throw std::invalid_argument(problem.name + ": got a chain that moves '" + joint.name +
                                "' by a gear, expected none for a proof");
  }
  return std::make_unique<CapabilityBound>(measure_bound(problem, measure, wrench, left_out),
                                           make_collision_bound(problem, left_out));
}

}  // namespace

std::unique_ptr<Bound> make_capability_bound(const Problem& problem, const std::string& measure,
                                             Wrench wrench) {
  return make_bound(problem, measure, wrench, left_out_coordinate(problem, measure, wrench));
}

std::unique_ptr<Bound> make_bound_of_all_coordinates(const Problem& problem,
                                                     const std::string& measure, Wrench wrench) {
  return make_bound(problem, measure, wrench, std::nullopt);
}

std::optional<int> left_out_coordinate(const Problem& problem, const std::string& measure,
                                       Wrench wrench) {
  if (measure != "linf_polytope" || wrench == Wrench::kAny || !problem.scenarios.empty()) {
    return std::nullopt;
  }
  return coordinate_about_yaw(problem);
}

}  // namespace maxwrench
