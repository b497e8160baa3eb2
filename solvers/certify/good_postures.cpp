#include "solvers/certify/good_postures.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>

#include "lib/math/require.h"
#include "lib/search/forwarding.h"
#include "maxwrench/batch.h"
#include "solvers/certify/box_tree.h"
#include "solvers/certify/halving.h"
#include "solvers/search/makers.h"

namespace maxwrench {
namespace {

/// A side that exceeds the resolution only by rounding is short enough.
constexpr double kSideRounding = 1 + 1e-9;
/// The most boxes of a cluster whose centres are evaluated.
constexpr std::size_t kCentres = 1000;
/// Evaluations of the CMA-ES that follows.
constexpr long kSearchBudget = 2000;

/// The branching. Boxes are cut in the order in which they were made, so that their sizes are
/// similar if it ends early.
class GoodBoxes {
 public:
  GoodBoxes(const Objective& objective, const Bound& bound, double high, const GoodOptions& options,
            GoodPostures& result)
      : objective_(objective),
        options_(options),
        result_(result),
        halving_(objective, bound, options.threads, false),
        low_(std::nextafter(result.least, -kInfinity)),
        start_(std::chrono::steady_clock::now()) {
    keep(halving_.root(low_, high));
  }

  void run() {
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
    result_.boxes.push_back({box.lower.cwiseMax(objective_.lower()),
                             box.upper.cwiseMin(objective_.upper()), box.proof.high, 0});
  }

  const Objective& objective_;
  const GoodOptions& options_;
  GoodPostures& result_;
  Halving halving_;
  double low_;  ///< just below the least good value
  std::chrono::steady_clock::time_point start_;
  std::deque<std::unique_ptr<CertifiedBox>> waiting_;
};

/// For arcs [a, b] within [lower, upper], whose ends are the same place, the shortest arc that
/// contains them all: the complement of the longest gap.
std::pair<double, double> around(std::vector<std::pair<double, double>> arcs, double lower,
                                 double upper) {
  std::sort(arcs.begin(), arcs.end());
  double end = arcs.front().second, gap = 0;
  std::pair<double, double> found;
  for (const auto& [a, b] : arcs) {
    if (a - end > gap) {
      gap = a - end;
      found = {a, end + (upper - lower)};
    }
    end = std::max(end, b);
  }
  const double outer = arcs.front().first - lower + upper - end;
  return gap > outer ? found : std::pair(arcs.front().first, end);
}

/// The objective restricted to the points that `inside` accepts.
class PartOf final : public ForwardingObjective {
 public:
  using Inside = std::function<bool(const Eigen::VectorXd&)>;
  PartOf(std::unique_ptr<Objective> objective, Eigen::VectorXd lower, Eigen::VectorXd upper,
         Inside inside)
      : ForwardingObjective(std::move(objective)),
        lower_(std::move(lower)),
        upper_(std::move(upper)),
        inside_(std::move(inside)) {}

  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  double evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* /*gradient*/) override {
    return inside_(x) ? evaluate_one(*objective_, x) : -kInfinity;
  }
  std::unique_ptr<Objective> clone() const override {
    return std::make_unique<PartOf>(objective_->clone(), lower_, upper_, inside_);
  }

 private:
  Eigen::VectorXd lower_, upper_;
  Inside inside_;
};

/// Groups the boxes into clusters and finds the best posture of each.
class Clusters {
 public:
  Clusters(const Objective& objective, const Candidate& best, const GoodOptions& options,
           GoodPostures& result)
      : objective_(objective),
        best_(best),
        options_(options),
        result_(result),
        tree_(result.boxes, objective.lower(), objective.upper(), options.turns) {}

  void run() {
    number(tree_.connect());
    measure();
    const auto count = static_cast<long>(result_.clusters.size());
    parallel_for(options_.threads, count, [this](long i) {
      represent(result_.clusters[static_cast<std::size_t>(i)],
                members_[static_cast<std::size_t>(i)]);
    });
    sort();
  }

 private:
  GoodBox& box(int i) { return result_.boxes[static_cast<std::size_t>(i)]; }

  void number(const std::vector<int>& clusters) {
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      const auto cluster = static_cast<std::size_t>(clusters[i]);
      result_.boxes[i].cluster = clusters[i];
      if (cluster >= members_.size()) members_.emplace_back();
      members_[cluster].push_back(static_cast<int>(i));
    }
  }

  void measure() {
    const Eigen::VectorXd& lower = objective_.lower();
    const Eigen::VectorXd size = objective_.upper() - lower;
    for (const std::vector<int>& members : members_) {
      Cluster& cluster = result_.clusters.emplace_back();
      cluster.boxes = static_cast<long>(members.size());
      cluster.lower = box(members.front()).lower;
      cluster.upper = box(members.front()).upper;
      cluster.high = -kInfinity;
      for (const int i : members) {
        cluster.lower = cluster.lower.cwiseMin(box(i).lower);
        cluster.upper = cluster.upper.cwiseMax(box(i).upper);
        cluster.high = std::max(cluster.high, box(i).high);
        // A coordinate that cannot move does not count.
        cluster.share += (size.array() > 0)
                             .select((box(i).upper - box(i).lower).array() / size.array(), 1)
                             .prod();
      }
      for (std::size_t axis = 0; axis < options_.turns.size(); ++axis) {
        if (options_.turns[axis] != 0) turn(cluster, members, static_cast<Eigen::Index>(axis));
      }
    }
  }

  void turn(Cluster& cluster, const std::vector<int>& members, Eigen::Index axis) {
    const double lower = objective_.lower()[axis], upper = objective_.upper()[axis];
    if (cluster.lower[axis] > lower || cluster.upper[axis] < upper) return;
    std::vector<std::pair<double, double>> arcs;
    for (const int i : members) arcs.emplace_back(box(i).lower[axis], box(i).upper[axis]);
    std::tie(cluster.lower[axis], cluster.upper[axis]) = around(std::move(arcs), lower, upper);
  }

  int cluster_at(const Eigen::VectorXd& x) const {
    const int found = tree_.find(x);
    return found < 0 ? -1 : result_.boxes[static_cast<std::size_t>(found)].cluster;
  }

  /// Sets the cluster's best: the best known posture, the best centre, or what a search from that
  /// centre finds.
  void represent(Cluster& cluster, std::vector<int>& members) {
    const int number = box(members.front()).cluster;
    if (cluster_at(best_.theta_r) == number) cluster.best = best_;
    if (options_.interrupted && options_.interrupted()) return;
    const auto objective = objective_.clone();
    const auto more = static_cast<long>(std::min(kCentres, members.size()));
    std::partial_sort(members.begin(), members.begin() + more, members.end(), [this](int a, int b) {
      return box(a).high > box(b).high || (box(a).high == box(b).high && a < b);
    });
    const double known = cluster.best.value;
    for (long i = 0; i < more; ++i) {
      const GoodBox& at = box(members[static_cast<std::size_t>(i)]);
      const Eigen::VectorXd centre = (at.lower + at.upper) / 2;
      const double value = evaluate_one(*objective, centre);
      if (value > cluster.best.value) cluster.best = {centre, value};
    }
    if (cluster.best.value > known) improve(cluster, number);
  }

  void improve(Cluster& cluster, int number) const {
    const Eigen::VectorXd& upper = objective_.upper();
    const bool around = (cluster.upper.array() > upper.array()).any();
    PartOf part(objective_.clone(), around ? objective_.lower() : cluster.lower,
                around ? upper : cluster.upper,
                [this, number](const Eigen::VectorXd& x) { return cluster_at(x) == number; });
    SearchOptions search;
    search.budget = kSearchBudget;
    search.starts = {cluster.best};
    search.interrupted = options_.interrupted;
    const SearchResult found = make_cmaes()->maximize(part, search);
    if (found.value > cluster.best.value) cluster.best = {found.theta_r, found.value};
  }

  void sort() {
    std::vector<int> order(result_.clusters.size()), place(order.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [this](int i, int j) {
      const Cluster& a = result_.clusters[static_cast<std::size_t>(i)];
      const Cluster& b = result_.clusters[static_cast<std::size_t>(j)];
      return std::tuple(-a.best.value, -a.high, i) < std::tuple(-b.best.value, -b.high, j);
    });
    std::vector<Cluster> sorted;
    for (const int i : order) {
      place[static_cast<std::size_t>(i)] = static_cast<int>(sorted.size());
      sorted.push_back(std::move(result_.clusters[static_cast<std::size_t>(i)]));
    }
    result_.clusters = std::move(sorted);
    for (GoodBox& each : result_.boxes)
      each.cluster = place[static_cast<std::size_t>(each.cluster)];
  }

  const Objective& objective_;
  const Candidate& best_;
  const GoodOptions& options_;
  GoodPostures& result_;
  BoxTree tree_;
  std::vector<std::vector<int>> members_;  ///< the boxes of each cluster
};

}  // namespace

double good_from(double best, double within) { return best - within * std::abs(best); }

GoodPostures find_good_postures(Objective& objective, const Bound& bound, const Candidate& best,
                                double high, const GoodOptions& options) {
  require(options.within > 0 && options.within <= 1, "within", options.within,
          "above 0, at most 1");
  require(options.resolution >= kLeastResolution && std::isfinite(options.resolution), "resolution",
          options.resolution, "a finite number of at least 1e-6");
  require(options.seconds >= 0, "seconds", options.seconds, "at least 0");
  require(options.boxes >= 1, "boxes", static_cast<double>(options.boxes), "at least 1");
  require_threads(options.threads);
  const std::size_t turns = options.turns.size();
  require(turns == 0 || turns == static_cast<std::size_t>(objective.dimension()), "turns",
          static_cast<double>(turns), "one for each coordinate, or none");
  require(std::isfinite(best.value), "best", best.value, "a posture with a value");
  require(!std::isnan(high), "high", high, "a bound of all values");
  const Box rejects_infinite_limits(objective);
  GoodPostures result;
  result.least = good_from(best.value, options.within);
  result.sure = good_from(high, options.within);
  GoodBoxes(objective, bound, high, options, result).run();
  Clusters(objective, best, options, result).run();
  return result;
}

}  // namespace maxwrench
