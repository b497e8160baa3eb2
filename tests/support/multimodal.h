#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "maxwrench/bound.h"
#include "maxwrench/objective.h"

// A function with exact bounds over boxes.

namespace maxwrench {

/// The value is top minus the distance to the nearest peak, in the maximum norm. Where `turns`, the
/// distance may also go around the limits.
struct Multimodal {
  Eigen::VectorXd lower, upper;
  std::vector<Eigen::VectorXd> peaks;
  double top = 1;
  std::vector<char> turns = {};

  /// The distance to the nearest point of the box [from, to].
  double distance(const Eigen::VectorXd& peak, const Eigen::VectorXd& from,
                  const Eigen::VectorXd& to) const {
    double most = 0;
    for (Eigen::Index i = 0; i < peak.size(); ++i) {
      const bool around = !turns.empty() && turns[static_cast<std::size_t>(i)] != 0;
      const double turn = upper[i] - lower[i];
      double least = kInfinity;
      for (const double by : {0.0, turn, -turn}) {
        if (by != 0 && !around) continue;
        least = std::min(least, std::max({0.0, from[i] - peak[i] - by, peak[i] + by - to[i]}));
      }
      most = std::max(most, least);
    }
    return most;
  }
  double highest(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const {
    double least = kInfinity;
    for (const auto& peak : peaks) least = std::min(least, distance(peak, from, to));
    return top - least;
  }
};

class MultimodalObjective final : public Objective {
 public:
  explicit MultimodalObjective(const Multimodal& multimodal) : multimodal_(multimodal) {
    verdict_.conclude(Status::kOptimal);
  }
  const Eigen::VectorXd& lower() const override { return multimodal_.lower; }
  const Eigen::VectorXd& upper() const override { return multimodal_.upper; }
  double evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* /*gradient*/) override {
    return multimodal_.highest(x, x);
  }
  const Verdict& verdict() const override { return verdict_; }
  std::unique_ptr<Objective> clone() const override {
    return std::make_unique<MultimodalObjective>(multimodal_);
  }

 private:
  const Multimodal& multimodal_;
  Verdict verdict_;
};

class MultimodalBound final : public Bound {
 public:
  explicit MultimodalBound(const Multimodal& multimodal) : multimodal_(multimodal) {}
  double ceiling() const override { return std::abs(multimodal_.top) + 4; }
  void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double /*low*/,
                double high, BoxProof& proof) override {
    proof.kind = BoxProof::Kind::kMultiplier;
    proof.high = std::min(high, multimodal_.highest(lower, upper));
  }
  std::unique_ptr<Bound> clone() const override {
    return std::make_unique<MultimodalBound>(multimodal_);
  }

 private:
  const Multimodal& multimodal_;
};

}  // namespace maxwrench
