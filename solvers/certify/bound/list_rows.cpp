#include "solvers/certify/bound/list_rows.h"

#include <algorithm>

namespace maxwrench {

ListForces::ListForces(const ListModel& model)
    : model_(model),
      T_(model.n(), model.loads()),
      A_(model.n(), model.axes()),
      tau_d_(model.n()),
      loads_(model.loads()) {}

void ListForces::set(const Eigen::VectorXd& blocks) {
  T_.reshaped() = blocks.head(T_.size());
  A_.reshaped() = blocks.tail(A_.size());
  tau_d_ = T_.col(0);
}

void ListForces::add_load(const LoadCase& load, Eigen::VectorXd& tau) {
  loads_.setZero();
  model_.weigh(load, loads_);
  tau.noalias() += T_ * loads_;
}

void ListForces::exert(const Vector6d& c, Eigen::VectorXd& tau) const {
  tau.noalias() = A_ * model_.along_axes(c);
}

Vector6d ListForces::wrench(int i) const {
  return model_.kept().scenarios.wrenches[static_cast<std::size_t>(i)].c;
}

Vector6d ListForces::ball_axis(Eigen::Index i) const {
  const WrenchBall& ball = *model_.kept().scenarios.ball;
  return ball.radius * ball.E.col(i);
}

ListRows::ListRows(const ListModel& model)
    : model_(model),
      set_(model.kept().robot.actuation),
      facets_(model.kept()),
      forces_(model),
      coefficients_(model.n() * (model.loads() + model.axes()), kMost) {}

bool ListRows::add(int pair, const ScenarioKey& key) {
  const Zonotope& limits = model_.limits(key);
  Row row{pair, key, limits.b_min[pair], limits.b_max[pair]};
  if (count() == kMost || std::find(rows_.begin(), rows_.end(), row) != rows_.end()) return false;
  model_.weigh(key, loads_, axes_);
  auto all = coefficients_.col(count());
  const Eigen::Index n = model_.n();
  for (Eigen::Index b = 0; b < model_.loads(); ++b) all.segment(b * n, n) = loads_[b] * normal(row);
  for (Eigen::Index k = 0; k < model_.axes(); ++k) {
    all.segment((model_.loads() + k) * n, n) = axes_[k] * normal(row);
  }
  rows_.push_back(std::move(row));
  return true;
}

bool ListRows::add_violated(const Eigen::VectorXd& blocks) {
  constexpr double kLeast = 1e-9;  // as a share of beta
  forces_.set(blocks);
  facets_.scan(forces_);
  bool added = false;
  if (!facets_.missed && facets_.high < 1 - kLeast && facets_.high_scenario(forces_, choice_)) {
    added = add(facets_.high_pair(), model_.key_of(choice_));
  }
  if ((facets_.missed || facets_.low > 1 + kLeast) && facets_.low_scenario(forces_, choice_)) {
    added |= add(facets_.low_pair(), model_.key_of(choice_));
  }
  return added;
}

}  // namespace maxwrench
