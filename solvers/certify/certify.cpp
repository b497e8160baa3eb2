#include "solvers/certify/certify.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "maxwrench/batch.h"
#include "maxwrench/robot.h"

namespace maxwrench {
namespace {

/// Boxes narrower than this [rad or m] are not cut.
constexpr double kNarrowest = 1e-6;
/// Boxes that are bounded beside each other: they see the same incumbent, at
/// any thread count.
constexpr std::size_t kRound = 256;
/// The first rounds have fewer: at most this part of the boxes that wait.
constexpr std::size_t kShare = 2;

/// How many boxes there are for one whose centre is evaluated, unless they are
/// as small as this.
constexpr std::size_t kSeldom = 32;
constexpr double kSmallBox = 1e-3;
/// Evaluations of a climb, about.
constexpr int kClimbEvaluations = 500;

using CertifiedBoxes = std::vector<std::unique_ptr<CertifiedBox>>;

/// A bound for each thread that asks.
class BoundPool {
 public:
  explicit BoundPool(const Bound &bound) : bound_(bound) {}
  std::unique_ptr<Bound> take() {
    const std::lock_guard<std::mutex> guard(mutex_);
    if (free_.empty()) return bound_.clone();
    std::unique_ptr<Bound> one = std::move(free_.back());
    free_.pop_back();
    return one;
  }
  void give(std::unique_ptr<Bound> one) {
    const std::lock_guard<std::mutex> guard(mutex_);
    free_.push_back(std::move(one));
  }

 private:
  const Bound &bound_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Bound>> free_;
};

class BranchAndBound {
 public:
  BranchAndBound(Objective &objective, const Bound &bound, const Candidate &incumbent,
                 const CertifyOptions &options)
      : objective_(objective),
        options_(options),
        pool_(bound),
        start_(std::chrono::steady_clock::now()) {
    result_.best = incumbent;
    auto root = std::make_unique<CertifiedBox>();
    root->lower = objective.lower().array() - kLimitTolerance;
    root->upper = objective.upper().array() + kLimitTolerance;
    bound.extend(root->lower, root->upper);
    root->high = bound.ceiling();
    bound_one(*root, target());
    keep(std::move(root));
  }

  CertifyResult run() {
    while (!ended()) {
      take_parents();
      cut_parents();
    }
    result_.bound = std::max(top(), target());
    result_.seconds = seconds();
    for (const auto &box : waiting_) report(*box);
    return std::move(result_);
  }

 private:
  static bool comes_later(const std::unique_ptr<CertifiedBox> &a,
                          const std::unique_ptr<CertifiedBox> &b) {
    return a->proof.high < b->proof.high;
  }

  /// What does not exceed this needs no proof.
  double target() const {
    const double best = result_.best.value;
    return std::isfinite(best) ? best + options_.gap * std::abs(best) : best;
  }
  double top() const { return waiting_.empty() ? -kInfinity : waiting_.front()->proof.high; }
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  bool ended() {
    if (top() <= target()) {
      result_.conclude(Status::kProven);
    } else if (options_.interrupted && options_.interrupted()) {
      result_.conclude(Status::kBracket, "interrupted");
    } else if (seconds() > options_.seconds) {
      result_.conclude(Status::kBracket, "the time ran out");
    } else if (result_.boxes >= options_.boxes) {
      result_.conclude(Status::kBracket, "the boxes ran out");
    } else if (too_narrow_) {
      result_.conclude(Status::kBracket, "a box is too narrow to be cut");
    } else {
      if (options_.progress) options_.progress(top(), result_.best.value);
      return false;
    }
    return true;
  }

  /// The boxes with the largest bounds.
  void take_parents() {
    parents_.clear();
    const std::size_t most = std::clamp(waiting_.size() / kShare, std::size_t{1}, kRound);
    while (parents_.size() < most && top() > target()) {
      std::pop_heap(waiting_.begin(), waiting_.end(), comes_later);
      parents_.push_back(std::move(waiting_.back()));
      waiting_.pop_back();
    }
  }

  /// Where a box is cut: the coordinate that its bound names, else the widest;
  /// -1 if it is too narrow.
  int axis_of(const CertifiedBox &box) const {
    int axis = -1;
    double most = kNarrowest;
    const int hint = box.proof.axis;
    if (hint >= 0 && box.upper[hint] - box.lower[hint] > kNarrowest) return hint;
    for (Eigen::Index i = 0; i < box.lower.size(); ++i) {
      const double width = box.upper[i] - box.lower[i];
      if (width <= most) continue;
      most = width;
      axis = static_cast<int>(i);
    }
    return axis;
  }

  static std::unique_ptr<CertifiedBox> half(const CertifiedBox &parent, int axis, bool second) {
    auto child = std::make_unique<CertifiedBox>();
    child->lower = parent.lower;
    child->upper = parent.upper;
    const double middle = (parent.lower[axis] + parent.upper[axis]) / 2;
    (second ? child->lower : child->upper)[axis] = middle;
    child->high = parent.proof.high;
    child->proof.multiplier = parent.proof.multiplier;
    child->proof.basis = parent.proof.basis;
    child->depth = parent.depth + 1;
    child->parent = parent.id;
    return child;
  }

  /// All halves with the same aim, whatever the threads.
  void cut_parents() {
    improve();
    for (auto &parent : parents_) {
      parent->cut_axis = axis_of(*parent);
      if (parent->cut_axis >= 0) continue;
      too_narrow_ = true;
      push(std::move(parent));
    }
    std::erase(parents_, nullptr);
    children_.resize(2 * parents_.size());
    const double low = target();
    parallel_for(options_.threads, static_cast<long>(parents_.size()), [&](long i) {
      const auto at = static_cast<std::size_t>(i);
      const CertifiedBox &parent = *parents_[at];
      for (const bool second : {false, true}) {
        const std::size_t place = 2 * at + (second ? 1 : 0);
        auto &child = children_[place];
        child = half(parent, parent.cut_axis, second);
        child->id = last_id_ + 1 + static_cast<long>(place);
        bound_one(*child, low);
      }
    });
    last_id_ += static_cast<long>(children_.size());
    for (const auto &parent : parents_) report(*parent);
    for (auto &child : children_) keep(std::move(child));
  }

  /// A box that was bounded waits, or is proven.
  void keep(std::unique_ptr<CertifiedBox> box) {
    ++result_.boxes;
    if (box->proof.kind == BoxProof::Kind::kCollision) ++result_.colliding;
    if (box->proof.high > box->low) {
      push(std::move(box));
    } else {
      report(*box);
    }
  }

  void bound_one(CertifiedBox &box, double low) {
    std::unique_ptr<Bound> bound = pool_.take();
    box.low = std::max(low, -box.high);
    if (bound->shrink(box.lower, box.upper)) {
      bound->evaluate(box.lower, box.upper, box.low, box.high, box.proof);
    } else {
      box.proof.kind = BoxProof::Kind::kNoPosture;
      box.proof.high = -kInfinity;
    }
    pool_.give(std::move(bound));
  }

  /// Centres of boxes, of one in so many and of all small ones, may be better
  /// than the best.
  void improve() {
    for (std::size_t i = 0; i < parents_.size(); ++i) {
      const CertifiedBox &box = *parents_[i];
      const double width = (box.upper - box.lower).maxCoeff();
      if (i % kSeldom == 0 || width < kSmallBox)
        climb((box.lower + box.upper).head(objective_.dimension()) / 2, width / 4);
    }
  }

  /// Takes a point over if it is better, and then what is better still, one
  /// coordinate at a time.
  void climb(Eigen::VectorXd x, double step) {
    if (!take_over(x)) return;
    int evaluations = 0;
    while (step > kNarrowest && evaluations < kClimbEvaluations) {
      bool moved = false;
      for (Eigen::Index i = 0; i < x.size(); ++i) {
        for (const double by : {step, -step}) {
          x = result_.best.theta_r;
          x[i] = std::clamp(x[i] + by, objective_.lower()[i], objective_.upper()[i]);
          moved |= take_over(x);
          ++evaluations;
        }
      }
      if (!moved) step /= 2;
    }
  }

  bool take_over(const Eigen::VectorXd &x) {
    const double value = evaluate_one(objective_, x);
    if (!(value > result_.best.value)) return false;
    result_.best = {x, value};
    return true;
  }

  void report(const CertifiedBox &box) const {
    if (options_.sink) options_.sink(box);
  }

  void push(std::unique_ptr<CertifiedBox> box) {
    waiting_.push_back(std::move(box));
    std::push_heap(waiting_.begin(), waiting_.end(), comes_later);
  }

  Objective &objective_;
  const CertifyOptions &options_;
  BoundPool pool_;
  std::chrono::steady_clock::time_point start_;
  CertifiedBoxes waiting_;  ///< a heap
  CertifiedBoxes parents_, children_;
  bool too_narrow_ = false;
  long last_id_ = 0;  ///< the root's
  CertifyResult result_;
};

}  // namespace

CertifyResult certify(Objective &objective, const Bound &bound, const Candidate &incumbent,
                      const CertifyOptions &options) {
  if (!(options.gap >= kLeastGap)) {
    throw std::invalid_argument("gap: expected at least 1e-8");
  }
  const Box refuses_infinite_limits(objective);
  return BranchAndBound(objective, bound, incumbent, options).run();
}

}  // namespace maxwrench
