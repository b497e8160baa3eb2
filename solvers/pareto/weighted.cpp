#include "solvers/pareto/weighted.h"

#include <cmath>
#include <limits>
#include <utility>

namespace maxwrench {
namespace {

struct WeightedPart {
  std::unique_ptr<Objective> f;
  double weight;
};

class WeightedObjective final : public Objective {
 public:
  explicit WeightedObjective(std::vector<WeightedPart> parts) : parts_(std::move(parts)) {}

  const Eigen::VectorXd& lower() const override { return parts_.front().f->lower(); }
  const Eigen::VectorXd& upper() const override { return parts_.front().f->upper(); }
  const Verdict& verdict() const override { return parts_[least_].f->verdict(); }

  double evaluate(const Eigen::VectorXd& theta_r, Eigen::VectorXd* gradient) override {
    double value = kInfinity;
    least_ = 0;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const double f = parts_[k].f->evaluate(theta_r, gradient ? &slope_ : nullptr);
      const double share = std::isnan(f) ? -kInfinity : f / parts_[k].weight;
      if (share >= value) continue;
      value = share;
      least_ = k;
      if (gradient) *gradient = slope_ / parts_[k].weight;
      if (value == -kInfinity) break;
    }
    if (gradient && value == -kInfinity) {
      gradient->setConstant(theta_r.size(), std::numeric_limits<double>::quiet_NaN());
    }
    return value;
  }

  void metric(const Eigen::VectorXd& theta_r, Eigen::MatrixXd& M) override {
    parts_.front().f->metric(theta_r, M);
  }

  std::unique_ptr<Objective> clone() const override {
    std::vector<WeightedPart> parts;
    for (const WeightedPart& part : parts_) parts.push_back({part.f->clone(), part.weight});
    return std::make_unique<WeightedObjective>(std::move(parts));
  }

 private:
  std::vector<WeightedPart> parts_;
  std::size_t least_ = 0;
  Eigen::VectorXd slope_;
};

}  // namespace

std::unique_ptr<Objective> make_weighted_objective(
    const std::vector<std::unique_ptr<Objective>>& objectives, const Eigen::VectorXd& weights) {
  std::vector<WeightedPart> parts;
  for (std::size_t k = 0; k < objectives.size(); ++k) {
    const double weight = weights[static_cast<Eigen::Index>(k)];
    if (weight > 0) parts.push_back({objectives[k]->clone(), weight});
  }
  return std::make_unique<WeightedObjective>(std::move(parts));
}

}  // namespace maxwrench
