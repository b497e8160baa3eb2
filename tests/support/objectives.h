#pragma once

#include <atomic>
#include <memory>
#include <utility>

#include "maxwrench/batch.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {

/// A run of a search without callbacks.
inline SearchRun& quiet_run() {
  static const SearchOptions options;
  static SearchRun run(options);
  return run;
}

/// Interrupts a search after a number of evaluations.
class Interruption {
 public:
  Interruption(long evaluations, SearchOptions& options) : left_(evaluations) {
    options.interrupted = [this] { return left_ <= 0; };
    options.evaluated = [this](double) { --left_; };
  }
  /// If negative, the search made that many more.
  long left() const { return left_; }

 private:
  std::atomic<long> left_;
};

/// The objective of trajectories with other bounds.
class OtherBounds final : public TrajectoryObjective {
 public:
  OtherBounds(std::unique_ptr<TrajectoryObjective> objective, Eigen::VectorXd lower,
              Eigen::VectorXd upper)
      : objective_(std::move(objective)), lower_(std::move(lower)), upper_(std::move(upper)) {}

  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  const Verdict& verdict() const override { return objective_->verdict(); }
  const KnotRows* rows() const override { return objective_->rows(); }
  TrajectoryEvaluator& trajectories() override { return objective_->trajectories(); }
  TrajectoryValue counts() const override { return objective_->counts(); }
  double evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* gradient) override {
    return objective_->evaluate(x, gradient);
  }
  double evaluate_throughout(const Eigen::VectorXd& x, double at_instants) override {
    return objective_->evaluate_throughout(x, at_instants);
  }
  std::unique_ptr<TrajectoryObjective> copy(TrajectoryValue counts) const override {
    return std::make_unique<OtherBounds>(objective_->copy(counts), lower_, upper_);
  }

 private:
  std::unique_ptr<TrajectoryObjective> objective_;
  Eigen::VectorXd lower_, upper_;
};

}  // namespace maxwrench
