#include "solvers/certify/bound/loop_box.h"

#include "solvers/certify/bound/bounds.h"

namespace maxwrench {

void spread_out(Eigen::Index repeat, const Eigen::VectorXd& values, Eigen::VectorXd& all) {
  const Eigen::Index size = values.size();
  if (repeat == 1) {
    Eigen::Map<Eigen::MatrixXd>(all.data(), size, all.size() / size).colwise() += values;
    return;
  }
  double* at = all.data();
  for (Eigen::Index first = 0; first < all.size(); first += size * repeat) {
    for (Eigen::Index i = 0; i < size; ++i) {
      const double value = values[i];
      if (repeat == 3) {  // one coordinate: too short for vector code of any length
        at[0] += value;
        at[1] += value;
        at[2] += value;
      } else {
        for (Eigen::Index k = 0; k < repeat; ++k) at[k] += value;
      }
      at += repeat;
    }
  }
}

LoopBox::LoopBox(const LoopModel& model) : model_(model), points_(model.parts.size()) {
  for (const LoopPart& part : model.parts) corners_.emplace_back(part.f);
  tau_ = a_ = Eigen::VectorXd::Zero(model.n);
  f_ = Eigen::VectorXd::Zero(model.m);
  g_ = h_ = Eigen::VectorXd::Zero(model.size);
}

bool LoopBox::set(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  if (!(spread(model_.coordinates.chain, lower, upper) <= kMostSpread)) return false;
  for (std::size_t i = 0; i < points_.size(); ++i) points_[i] = &corners_[i].over(lower, upper);
  return true;
}

void LoopBox::weigh(const Eigen::VectorXd& lambda, const Eigen::VectorXd& slopes,
                    const Eigen::VectorXd& nu) {
  g_.setZero();
  h_.setZero();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const LoopPart& part = model_.parts[i];
    const Eigen::MatrixXd& P = *points_[i];
    const auto count = static_cast<Eigen::Index>(part.rows.size());
    const Eigen::VectorXd& all = part.kind == LoopPart::Kind::kEquations ? nu : lambda;
    own_.resize(count);
    for (Eigen::Index k = 0; k < count; ++k) own_[k] = all[part.rows[static_cast<std::size_t>(k)]];
    if (!own_.isZero(0)) {
      sum_.noalias() = P.topRows(count).transpose() * own_;
      spread_out(part.repeat, sum_, g_);
    }
    if (part.kind != LoopPart::Kind::kLoads) continue;
    for (Eigen::Index k = 0; k < count; ++k) {
      own_[k] = slopes[part.rows[static_cast<std::size_t>(k)]];
    }
    if (own_.isZero(0)) continue;
    sum_.noalias() = P.bottomRows(count).transpose() * own_;
    spread_out(part.repeat, sum_, h_);
  }
}

template <class Values>
void LoopBox::collect(const Values& values_of) {
  f_.setZero();
  tau_.setZero();
  a_.setZero();
  for (std::size_t i = 0; i < model_.parts.size(); ++i) {
    const LoopPart& part = model_.parts[i];
    const auto& values = values_of(i);
    const auto count = static_cast<Eigen::Index>(part.rows.size());
    Eigen::VectorXd& all = part.kind == LoopPart::Kind::kEquations ? f_ : tau_;
    for (Eigen::Index k = 0; k < count; ++k) {
      const int row = part.rows[static_cast<std::size_t>(k)];
      all[row] += values[k];
      if (part.kind == LoopPart::Kind::kLoads) a_[row] += values[count + k];
    }
  }
}

void LoopBox::evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& off_tau, Eigen::VectorXd& off_a) {
  evaluate(x);
  off_tau.setZero(model_.n);
  off_a.setZero(model_.n);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const LoopPart& part = model_.parts[i];
    if (part.kind == LoopPart::Kind::kEquations) continue;
    const Eigen::VectorXd at = part.f.evaluate(x);
    const auto off = [&](Eigen::Index k) {
      return (points_[i]->row(k).array() - at[k]).abs().maxCoeff();
    };
    const auto count = static_cast<Eigen::Index>(part.rows.size());
    for (Eigen::Index k = 0; k < count; ++k) {
      const int row = part.rows[static_cast<std::size_t>(k)];
      off_tau[row] += off(k);
      if (part.kind == LoopPart::Kind::kLoads) off_a[row] += off(count + k);
    }
  }
}

void LoopBox::read(Eigen::Index v) {
  collect([&](std::size_t i) {
    return points_[i]->col(v / model_.parts[i].repeat % model_.parts[i].f.size());
  });
}

void LoopBox::evaluate(const Eigen::VectorXd& x) {
  collect([&](std::size_t i) { return model_.parts[i].f.evaluate(x); });
}

}  // namespace maxwrench
