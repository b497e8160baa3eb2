#pragma once

#include <vector>

#include "solvers/certify/bound/list_model.h"

namespace maxwrench {

/// lambda_s of some scenarios, and nu of the equations.
class ListMultiplier {
 public:
  struct Part {
    ScenarioKey key;
    Eigen::VectorXd lambda;
  };

  explicit ListMultiplier(const ListModel& model) : model_(model) {}

  const std::vector<Part>& parts() const { return parts_; }
  Eigen::VectorXd nu;

  /// Sets all lambda_s to zero.
  void clear() { parts_.clear(); }
  /// Adds a multiple of a normal to the lambda_s of a scenario.
  template <class Normal>
  void add(const ScenarioKey& key, double weight, const Normal& normal) {
    part_of(key).lambda += weight * normal;
  }
  /// The numbers as they are in a `BoxProof`: [numbers of s; lambda_s] of each scenario, and nu.
  const Eigen::VectorXd& numbers();
  /// Sets the multiplier to such numbers; to zero if there are none.
  void read(const Eigen::VectorXd& numbers);

 private:
  Eigen::Index width() const { return model_.key_size() + model_.n(); }
  Eigen::Index equations() const { return model_.block(0).m; }
  Part& part_of(const ScenarioKey& key);

  const ListModel& model_;
  std::vector<Part> parts_;
  Eigen::VectorXd numbers_;
};

}  // namespace maxwrench
