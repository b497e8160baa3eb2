#include "solvers/certify/good_postures.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <limits>

#include "lib/math/require.h"
#include "maxwrench/batch.h"
#include "maxwrench/robot.h"
#include "solvers/certify/clusters.h"
#include "solvers/certify/halving.h"

namespace maxwrench {
namespace {

/// A side that exceeds the resolution only by rounding is short enough.
constexpr double kSideRounding = 1 + 1e-9;

/// The branching. Boxes are cut in the order in which they were made, so that their sizes are
/// similar if it ends early.
class GoodBoxes {
 public:
  GoodBoxes(const Objective& objective, const Bound& bound, const GoodOptions& options,
            GoodPostures& result)
      : objective_(objective),
        options_(options),
        result_(result),
        halving_(objective, bound, {.threads = options.threads, .cells = true}),
        low_(std::nextafter(result.least, -kInfinity)),
        start_(std::chrono::steady_clock::now()) {
    // Those of the root before parts without a posture are cut off it: where both limits of an
    // angle are the same place, they are a turn apart.
    result.lower = objective.lower().array() - kLimitTolerance;
    result.upper = objective.upper().array() + kLimitTolerance;
    bound.extend(result.lower, result.upper);
    keep_within_limits(result.lower, result.upper);
  }

  void run(double high) {
    keep(halving_.root(low_, high));
    while (!ended()) cut_some();
    for (const auto& box : waiting_) list(*box);
    result_.seconds = seconds();
  }

 private:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  bool is_late() const {
    return seconds() > options_.seconds || (options_.interrupted && options_.interrupted());
  }

  bool ended() {
    if (waiting_.empty()) {
      result_.conclude(Status::kProven);
    } else if (options_.interrupted && options_.interrupted()) {
      result_.conclude(Status::kBracket, "interrupted");
    } else if (seconds() > options_.seconds) {
      result_.conclude(Status::kBracket, "the time ran out");
    } else if (result_.bounded >= options_.boxes) {
      result_.conclude(Status::kBracket, "the boxes ran out");
    } else {
      if (options_.progress) options_.progress(waiting_.size(), result_.boxes.size());
      return false;
    }
    return true;
  }

  void cut_some() {
    CertifiedBoxes parents;
    while (parents.size() < kRound && !waiting_.empty()) {
      parents.push_back(std::move(waiting_.front()));
      waiting_.pop_front();
    }
    CertifiedBoxes children = halving_.halves(parents, low_, [this] { return is_late(); });
    for (auto& child : children) keep(std::move(child));
  }

  void keep(std::unique_ptr<CertifiedBox> box) {
    ++result_.bounded;
    if (box->proof.high <= low_) return;
    box->cut_axis = axis_to_cut(*box, options_.resolution * kSideRounding);
    if (box->cut_axis < 0) {
      list(*box);
    } else {
      waiting_.push_back(std::move(box));
    }
  }

  void list(const CertifiedBox& box) {
    result_.boxes.push_back({box.lower, box.upper, box.proof.high, 0});
    keep_within_limits(result_.boxes.back().lower, result_.boxes.back().upper);
  }

  void keep_within_limits(Eigen::VectorXd& lower, Eigen::VectorXd& upper) const {
    const Eigen::Index r = objective_.dimension();
    lower.head(r) = lower.head(r).cwiseMax(objective_.lower());
    upper.head(r) = upper.head(r).cwiseMin(objective_.upper());
  }

  const Objective& objective_;
  const GoodOptions& options_;
  GoodPostures& result_;
  Halving halving_;
  double low_;  ///< just below the least good value
  std::chrono::steady_clock::time_point start_;
  std::deque<std::unique_ptr<CertifiedBox>> waiting_;
};

}  // namespace

double good_from(double best, double within) {
  return std::isfinite(best) ? best - within * std::abs(best) : best;
}

GoodPostures find_good_postures(Objective& objective, const Bound& bound, const Candidate& best,
                                double high, const GoodOptions& options) {
  require(options.within > 0 && options.within <= 1, "within", options.within,
          "above 0, at most 1");
  require(options.resolution >= kLeastResolution && std::isfinite(options.resolution), "resolution",
          options.resolution, "a finite number of at least 1e-6");
  require(options.seconds >= 0, "seconds", options.seconds, "at least 0");
  require(options.boxes >= 1, "boxes", static_cast<double>(options.boxes), "at least 1");
  require_threads(options.threads);
  require(std::isfinite(best.value), "best", best.value, "a posture with a value");
  require(!std::isnan(high), "high", high, "a bound of all values");
  const Box rejects_infinite_limits(objective);
  GoodPostures result;
  result.least = good_from(best.value, options.within);
  result.sure = good_from(high, options.within);
  GoodBoxes boxes(objective, bound, options, result);
  const std::size_t turns = options.turns.size();
  require(turns == 0 || turns == static_cast<std::size_t>(result.lower.size()), "turns",
          static_cast<double>(turns), "one for each coordinate, or none");
  boxes.run(high);
  find_clusters(objective, best, options, result);
  return result;
}

}  // namespace maxwrench
