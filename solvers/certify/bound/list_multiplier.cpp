#include "solvers/certify/bound/list_multiplier.h"

#include <algorithm>

namespace maxwrench {

ListMultiplier::Part& ListMultiplier::part_of(const ScenarioKey& key) {
  const auto part = std::find_if(parts_.begin(), parts_.end(),
                                 [&key](const Part& each) { return each.key == key; });
  if (part != parts_.end()) return *part;
  return parts_.emplace_back(Part{key, Eigen::VectorXd::Zero(model_.n())});
}

const Eigen::VectorXd& ListMultiplier::numbers() {
  numbers_.resize(static_cast<Eigen::Index>(parts_.size()) * width() + equations());
  Eigen::Index at = 0;
  for (const Part& part : parts_) {
    model_.write(part.key, numbers_.segment(at, model_.key_size()));
    numbers_.segment(at + model_.key_size(), model_.n()) = part.lambda;
    at += width();
  }
  numbers_.tail(equations()) = nu;
  return numbers_;
}

void ListMultiplier::read(const Eigen::VectorXd& numbers) {
  parts_.clear();
  nu.setZero(equations());
  if (numbers.size() < equations()) return;
  nu = numbers.tail(equations());
  for (Eigen::Index at = 0; at + width() + equations() <= numbers.size(); at += width()) {
    parts_.push_back({model_.read(numbers.segment(at, model_.key_size())),
                      numbers.segment(at + model_.key_size(), model_.n())});
  }
}

}  // namespace maxwrench
