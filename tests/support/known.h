#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <limits>
#include <memory>

#include "maxwrench/objective.h"

namespace maxwrench {

/// A function with a known maximum. Counts evaluations over all clones and checks the bounds.
/// Gradients are central differences, which are not counted.
class Known : public Objective {
 public:
  using Function = std::function<double(const Eigen::VectorXd&)>;

  Known(Function f, Eigen::VectorXd lower, Eigen::VectorXd upper)
      : f_(std::move(f)),
        lower_(std::move(lower)),
        upper_(std::move(upper)),
        count_(std::make_shared<std::atomic<long>>(0)),
        gradients_(std::make_shared<std::atomic<long>>(0)) {}
  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  double evaluate(const Eigen::VectorXd& theta_r, Eigen::VectorXd* gradient) override {
    ++*count_;
    EXPECT_TRUE((theta_r.array() >= lower_.array()).all());
    EXPECT_TRUE((theta_r.array() <= upper_.array()).all());
    const double value = f_(theta_r);
    verdict_.conclude(value == -kInfinity ? Status::kInfeasible : Status::kOptimal);
    if (gradient) differences(theta_r, value, *gradient);
    return value;
  }
  const Verdict& verdict() const override { return verdict_; }
  std::unique_ptr<Objective> clone() const override { return std::make_unique<Known>(*this); }
  long count() const { return *count_; }
  /// The number of evaluations with a gradient.
  long gradients() const { return *gradients_; }

 private:
  void differences(const Eigen::VectorXd& x, double value, Eigen::VectorXd& gradient) {
    ++*gradients_;
    gradient.setConstant(x.size(), std::numeric_limits<double>::quiet_NaN());
    if (value == -kInfinity) return;
    constexpr double kStep = 1e-6;
    for (int i = 0; i < x.size(); ++i) {
      const Eigen::VectorXd e = kStep * Eigen::VectorXd::Unit(x.size(), i);
      const double above = f_(x + e), below = f_(x - e);
      // At the edge of the region with values, a one-sided difference.
      gradient[i] = above == -kInfinity   ? (value - below) / kStep
                    : below == -kInfinity ? (above - value) / kStep
                                          : (above - below) / (2 * kStep);
    }
  }

  Function f_;
  Eigen::VectorXd lower_, upper_;
  std::shared_ptr<std::atomic<long>> count_, gradients_;
  Verdict verdict_;
};

}  // namespace maxwrench
