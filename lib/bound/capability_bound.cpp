#include <stdexcept>

#include "lib/bound/bounds.h"
#include "lib/bound/exact_posture.h"

namespace maxwrench {
namespace {

/// Either bound; where all of a box collides there is no value.
class CapabilityBound final : public Bound {
 public:
  CapabilityBound(std::unique_ptr<Bound> measure, std::unique_ptr<Bound> collision)
      : measure_(std::move(measure)), collision_(std::move(collision)) {}

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
  bool shrink(Eigen::VectorXd& lower, Eigen::VectorXd& upper) override {
    return measure_->shrink(lower, upper);
  }

  std::unique_ptr<Bound> clone() const override {
    return std::make_unique<CapabilityBound>(measure_->clone(),
                                             collision_ ? collision_->clone() : nullptr);
  }

 private:
  std::unique_ptr<Bound> measure_, collision_;
};

std::unique_ptr<Bound> measure_bound(const Problem& problem, const std::string& measure,
                                     Wrench wrench) {
  const bool any = wrench == Wrench::kAny;
  const bool follows = !problem.dependent.empty();
  if (measure == "linf_polytope") {
    if (follows && !any) return make_loop_bound(problem, false);
    return any ? make_any_wrench_bound(problem) : make_polytope_bound(problem, false);
  }
  if (measure != "l2_polytope" && measure != "ellipsoid") {
    throw std::invalid_argument("measure: got '" + measure +
                                "', expected linf_polytope, l2_polytope or ellipsoid for a proof");
  }
  if (any) {
    throw std::invalid_argument("wrench: got 'any', expected pure for a proof of measure " +
                                measure);
  }
  if (follows && measure == "l2_polytope") return make_loop_bound(problem, true);
  return measure == "ellipsoid" ? make_ellipsoid_bound(problem)
                                : make_polytope_bound(problem, true);
}

}  // namespace

std::unique_ptr<Bound> make_capability_bound(const Problem& problem, const std::string& measure,
                                             Wrench wrench) {
  require_closed_form(problem);
  return std::make_unique<CapabilityBound>(measure_bound(problem, measure, wrench),
                                           make_collision_bound(problem));
}

}  // namespace maxwrench
