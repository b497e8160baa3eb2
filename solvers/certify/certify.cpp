#include "solvers/certify/certify.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "lib/math/require.h"
#include "maxwrench/batch.h"
#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/halving.h"

namespace maxwrench {
namespace {

/// The first rounds cut fewer boxes than kRound: at most the waiting boxes divided by this.
constexpr std::size_t kShare = 2;

/// One box in this many has its centre evaluated, and every box that is smaller than kSmallBox.
constexpr std::size_t kSeldom = 32;
constexpr double kSmallBox = 1e-3;
constexpr int kMostInVain = 1000;
/// The approximate number of evaluations of a local search.
constexpr int kLocalSearchEvaluations = 500;

class BranchAndBound {
 public:
  BranchAndBound(Objective& objective, const Bound& bound, const Candidate& incumbent,
                 const CertifyOptions& options)
      : objective_(objective),
        options_(options),
        halving_(objective, bound,
                 {.threads = options.threads, .records = options.sink != nullptr}),
        left_out_(bound.left_out()),
        start_(std::chrono::steady_clock::now()) {
    result_.best = incumbent;
    keep(halving_.root(target(), bound.ceiling()));
  }

  CertifyResult run() {
    while (!ended()) {
      take_parents();
      cut_parents();
    }
    result_.bound = std::max({top(), narrow_top(), target()});
    result_.seconds = seconds();
    for (const auto* boxes : {&waiting_, &narrow_}) {
      for (const auto& box : *boxes) report(*box);
    }
    return std::move(result_);
  }

 private:
  static bool comes_later(const std::unique_ptr<CertifiedBox>& a,
                          const std::unique_ptr<CertifiedBox>& b) {
    return a->proof.high < b->proof.high;
  }

  /// Boxes whose values do not exceed this need no further proof.
  double target() const {
    const double best = result_.best.value;
    return std::isfinite(best) ? best + options_.gap * std::abs(best) : best;
  }
  double top() const { return waiting_.empty() ? -kInfinity : waiting_.front()->proof.high; }
  double narrow_top() const {
    double top = -kInfinity;
    for (const auto& box : narrow_) top = std::max(top, box->proof.high);
    return top;
  }
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  bool is_late() const {
    return seconds() > options_.seconds || (options_.interrupted && options_.interrupted());
  }

  bool ended() {
    if (std::max(top(), narrow_top()) <= target()) {
      result_.conclude(Status::kProven);
    } else if (options_.interrupted && options_.interrupted()) {
      result_.conclude(Status::kBracket, "interrupted");
    } else if (seconds() > options_.seconds) {
      result_.conclude(Status::kBracket, "the time ran out");
    } else if (result_.boxes >= options_.boxes) {
      result_.conclude(Status::kBracket, "the boxes ran out");
    } else if (top() <= std::max(narrow_top(), target())) {
      result_.conclude(Status::kBracket, "a box is too narrow to be cut");
    } else {
      if (options_.progress) options_.progress(top(), result_.best.value);
      return false;
    }
    return true;
  }

  /// Takes the boxes with the largest bounds.
  void take_parents() {
    parents_.clear();
    const std::size_t most = std::clamp(waiting_.size() / kShare, std::size_t{1}, kRound);
    while (parents_.size() < most && top() > target()) {
      std::pop_heap(waiting_.begin(), waiting_.end(), comes_later);
      parents_.push_back(std::move(waiting_.back()));
      waiting_.pop_back();
    }
  }

  void cut_parents() {
    for (auto& parent : parents_) {
      parent->cut_axis = axis_to_cut(*parent, kNarrowestBox, left_out_);
      if (parent->cut_axis < 0) narrow_.push_back(std::move(parent));
    }
    std::erase(parents_, nullptr);
    improve();
    CertifiedBoxes children = halving_.halves(parents_, target(), [this] { return is_late(); });
    for (const auto& parent : parents_) report(*parent);
    for (auto& child : children) keep(std::move(child));
  }

  /// Queues a bounded box, or reports it if it is proven.
  void keep(std::unique_ptr<CertifiedBox> box) {
    ++result_.boxes;
    if (box->proof.kind == BoxProof::Kind::kCollision) ++result_.colliding;
    if (box->proof.high > box->low) {
      push(std::move(box));
    } else {
      report(*box);
    }
  }

  /// Looks for better values at the centres of one box in kSeldom and of all small boxes, until
  /// kMostInVain centres in a row have brought nothing.
  void improve() {
    for (std::size_t i = 0; i < parents_.size(); ++i) {
      const CertifiedBox& box = *parents_[i];
      const double width = widest(box.lower, box.upper, left_out_);
      if (i % kSeldom != 0 && (width >= kSmallBox || in_vain_ >= kMostInVain)) continue;
      const double before = result_.best.value;
      local_search((box.lower + box.upper).head(objective_.dimension()) / 2, width / 4);
      in_vain_ = result_.best.value > before ? 0 : in_vain_ + 1;
    }
  }

  /// If x is better than the incumbent, takes it over and continues from it, one coordinate at a
  /// time.
  void local_search(Eigen::VectorXd x, double step) {
    if (!take_over(x)) return;
    int evaluations = 0;
    while (step > kNarrowestBox && evaluations < kLocalSearchEvaluations) {
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

  bool take_over(const Eigen::VectorXd& x) {
    const double value = evaluate_one(objective_, x);
    if (!(value > result_.best.value)) return false;
    result_.best = {x, value};
    return true;
  }

  void report(const CertifiedBox& box) const {
    if (options_.sink) options_.sink(box);
  }

  void push(std::unique_ptr<CertifiedBox> box) {
    waiting_.push_back(std::move(box));
    std::push_heap(waiting_.begin(), waiting_.end(), comes_later);
  }

  Objective& objective_;
  const CertifyOptions& options_;
  Halving halving_;
  const int left_out_;
  int in_vain_ = 0;  ///< centres in a row without a better value
  std::chrono::steady_clock::time_point start_;
  CertifiedBoxes waiting_;  ///< a heap
  CertifiedBoxes parents_;
  CertifiedBoxes narrow_;  ///< those that cannot be cut
  CertifyResult result_;
};

}  // namespace

void require_valid(const CertifyOptions& options) {
  require(options.gap >= kLeastGap && std::isfinite(options.gap), "gap", options.gap,
          "a finite number of at least 1e-8");
  require(options.seconds >= 0, "seconds", options.seconds, "at least 0");
  require(options.boxes >= 1, "boxes", static_cast<double>(options.boxes), "at least 1");
  require_threads(options.threads);
}

CertifyResult certify(Objective& objective, const Bound& bound, const Candidate& incumbent,
                      const CertifyOptions& options) {
  require_valid(options);
  require(!std::isnan(incumbent.value), "incumbent", incumbent.value, "a value, or -infinity");
  const Box rejects_infinite_limits(objective);
  return BranchAndBound(objective, bound, incumbent, options).run();
}

}  // namespace maxwrench
