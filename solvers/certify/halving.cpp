#include "solvers/certify/halving.h"

#include <algorithm>
#include <cmath>

#include "maxwrench/batch.h"
#include "maxwrench/robot.h"

namespace maxwrench {
namespace {

std::unique_ptr<CertifiedBox> half(const CertifiedBox& parent, bool second) {
  auto child = std::make_unique<CertifiedBox>();
  child->lower = parent.lower;
  child->upper = parent.upper;
  const int axis = parent.cut_axis;
  const double middle = (parent.lower[axis] + parent.upper[axis]) / 2;
  (second ? child->lower : child->upper)[axis] = middle;
  child->high = parent.proof.high;
  child->proof.multiplier = parent.proof.multiplier;
  child->proof.basis = parent.proof.basis;
  child->depth = parent.depth + 1;
  child->parent = parent.id;
  return child;
}

}  // namespace

Halving::Halving(const Objective& objective, const Bound& bound, const HalvingOptions& options)
    : objective_(objective), bound_(bound), options_(options) {}

std::unique_ptr<CertifiedBox> Halving::root(double low, double high) {
  auto root = std::make_unique<CertifiedBox>();
  root->lower = objective_.lower().array() - kLimitTolerance;
  root->upper = objective_.upper().array() + kLimitTolerance;
  bound_.extend(root->lower, root->upper);
  root->high = high;
  bound_one(*root, low);
  return root;
}

CertifiedBoxes Halving::halves(const CertifiedBoxes& parents, double low,
                               const std::function<bool()>& ended) {
  CertifiedBoxes children(2 * parents.size());
  parallel_for(options_.threads, static_cast<long>(parents.size()), [&](long i) {
    const auto at = static_cast<std::size_t>(i);
    for (const bool second : {false, true}) {
      const std::size_t place = 2 * at + (second ? 1 : 0);
      auto& child = children[place];
      child = half(*parents[at], second);
      child->id = last_id_ + 1 + static_cast<long>(place);
      if (ended()) {
        child->low = parents[at]->low;
        child->proof.forget(child->high);
      } else {
        bound_one(*child, low);
      }
    }
  });
  last_id_ += static_cast<long>(children.size());
  return children;
}

void Halving::bound_one(CertifiedBox& box, double low) {
  std::unique_ptr<Bound> bound;
  {
    const std::lock_guard<std::mutex> guard(mutex_);
    if (!free_.empty()) {
      bound = std::move(free_.back());
      free_.pop_back();
    }
  }
  if (!bound) bound = bound_.clone();
  // Without a value so far, uses a number that no value is below: a ceiling bounds both signs.
  box.low = std::isfinite(low) ? low : -bound_.ceiling();
  const Eigen::Index r = options_.cells ? objective_.dimension() : 0;
  const Eigen::VectorXd lower = box.lower.head(r), upper = box.upper.head(r);
  if (bound->shrink(box.lower, box.upper, options_.records ? &box.cuts : nullptr)) {
    bound->evaluate(box.lower, box.upper, box.low, box.high, box.proof);
    if (options_.records && box.proof.kind == BoxProof::Kind::kNoPosture) {
      box.cuts.push_back({.multiplier = box.proof.nu});
    }
  } else {
    box.proof.exclude({});
  }
  box.lower.head(r) = lower;
  box.upper.head(r) = upper;
  const std::lock_guard<std::mutex> guard(mutex_);
  free_.push_back(std::move(bound));
}

int axis_to_cut(const CertifiedBox& box, double narrowest, int left_out) {
  int axis = -1;
  double most = narrowest;
  const int hint = box.proof.axis;
  if (hint >= 0 && box.upper[hint] - box.lower[hint] > narrowest) return hint;
  for (Eigen::Index i = 0; i < box.lower.size(); ++i) {
    const double width = box.upper[i] - box.lower[i];
    if (width <= most || i == left_out) continue;
    most = width;
    axis = static_cast<int>(i);
  }
  return axis;
}

}  // namespace maxwrench
