#include "solvers/certify/clusters.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <set>

#include "lib/math/random.h"
#include "lib/search/forwarding.h"
#include "maxwrench/batch.h"
#include "solvers/certify/box_tree.h"
#include "solvers/search/makers.h"

namespace maxwrench {
namespace {

/// Points of a cluster at which postures are evaluated: the centres of its boxes, and random points
/// if these have no value.
constexpr long kPoints = 1000;
/// Evaluations of the CMA-ES that follows.
constexpr long kSearchBudget = 2000;
/// [rad or m] The dependent coordinates of a posture are not more exact than this.
constexpr double kPostureError = 1e-8;

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

/// All postures at theta_r with their values, for the use of one thread.
PosturesAt make_postures(const Objective& objective, const GoodOptions& options) {
  if (options.make_postures) return options.make_postures();
  const std::shared_ptr<Objective> own = objective.clone();
  return [own](const Eigen::VectorXd& theta_r, std::vector<PosturePoint>& postures) {
    postures = {{theta_r, evaluate_one(*own, theta_r)}};
  };
}

using Inside = std::function<bool(const Eigen::VectorXd& x)>;

/// The best of the postures that `inside` accepts; -infinity: none of them has a value.
PosturePoint best_inside(const std::vector<PosturePoint>& postures, const Inside& inside) {
  PosturePoint best;
  for (const PosturePoint& posture : postures) {
    if (posture.value > best.value && inside(posture.x)) best = posture;
  }
  return best;
}

/// The value of the best posture at theta_r that `inside` accepts, as an objective.
class PartOf final : public ForwardingObjective {
 public:
  PartOf(std::unique_ptr<Objective> objective, const GoodOptions& options, Eigen::VectorXd lower,
         Eigen::VectorXd upper, Inside inside)
      : ForwardingObjective(std::move(objective)),
        options_(options),
        postures_at_(make_postures(*objective_, options)),
        lower_(std::move(lower)),
        upper_(std::move(upper)),
        inside_(std::move(inside)) {}

  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  double evaluate(const Eigen::VectorXd& theta_r, Eigen::VectorXd* /*gradient*/) override {
    postures_at_(theta_r, postures_);
    return best_inside(postures_, inside_).value;
  }
  std::unique_ptr<Objective> clone() const override {
    return std::make_unique<PartOf>(objective_->clone(), options_, lower_, upper_, inside_);
  }

 private:
  const GoodOptions& options_;
  PosturesAt postures_at_;
  std::vector<PosturePoint> postures_;
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
        r_(objective.dimension()),
        margin_(result.lower.size() > r_ ? kPostureError : 0),
        tree_(result.boxes, result.lower, result.upper, options.turns) {}

  void run() {
    number(tree_.connect());
    measure();
    std::vector<PosturePoint> postures;
    make_postures(objective_, options_)(best_.theta_r, postures);
    best_known_ = best_inside(postures, [](const Eigen::VectorXd&) { return true; });
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
      }
      cluster.share = share_of(members);
      for (std::size_t axis = 0; axis < options_.turns.size(); ++axis) {
        if (options_.turns[axis] != 0) turn(cluster, members, static_cast<Eigen::Index>(axis));
      }
    }
  }

  /// Several boxes can have the same theta_r, which counts once.
  double share_of(const std::vector<int>& members) {
    const Eigen::ArrayXd size = (result_.upper - result_.lower).head(r_);
    std::set<std::vector<double>> cells;
    double share = 0;
    for (const int i : members) {
      const Eigen::VectorXd lower = box(i).lower.head(r_), upper = box(i).upper.head(r_);
      std::vector<double> cell(lower.begin(), lower.end());
      cell.insert(cell.end(), upper.begin(), upper.end());
      if (!cells.insert(std::move(cell)).second) continue;
      // A coordinate that cannot move does not count.
      share += (size > 0).select((upper - lower).array() / size, 1).prod();
    }
    return std::min(share, 1.0);
  }

  void turn(Cluster& cluster, const std::vector<int>& members, Eigen::Index axis) {
    const double lower = result_.lower[axis], upper = result_.upper[axis];
    if (cluster.lower[axis] > lower || cluster.upper[axis] < upper) return;
    std::vector<std::pair<double, double>> arcs;
    for (const int i : members) arcs.emplace_back(box(i).lower[axis], box(i).upper[axis]);
    std::tie(cluster.lower[axis], cluster.upper[axis]) = around(std::move(arcs), lower, upper);
  }

  int cluster_at(const Eigen::VectorXd& x) const {
    int found = tree_.find(x);
    if (found < 0 && margin_ > 0) found = tree_.find(x, margin_);
    return found < 0 ? -1 : result_.boxes[static_cast<std::size_t>(found)].cluster;
  }

  /// Sets the cluster's best: the best known posture, the best one at these points, or what a
  /// search from there finds.
  void represent(Cluster& cluster, std::vector<int>& members) {
    const int number = box(members.front()).cluster;
    const Inside inside = [this, number](const auto& x) { return cluster_at(x) == number; };
    if (best_known_.value > -kInfinity && inside(best_known_.x)) {
      cluster.best = {best_known_.x.head(r_), best_.value};
      cluster.x = best_known_.x;
    }
    if (options_.interrupted && options_.interrupted()) return;
    const PosturesAt postures_at = make_postures(objective_, options_);
    const auto more = std::min(kPoints, static_cast<long>(members.size()));
    std::partial_sort(members.begin(), members.begin() + more, members.end(), [this](int a, int b) {
      return box(a).high > box(b).high || (box(a).high == box(b).high && a < b);
    });
    const double known = cluster.best.value;
    Random random(static_cast<std::uint64_t>(number));
    Eigen::ArrayXd part = Eigen::ArrayXd::Constant(r_, 0.5);
    for (long i = 0; i < kPoints; ++i) {
      if (i >= more && cluster.best.value > -kInfinity) break;
      const GoodBox& at = box(members[static_cast<std::size_t>(i % more)]);
      if (i >= more) {
        for (double& each : part) each = random.uniform(0, 1);
      }
      const Eigen::VectorXd lower = at.lower.head(r_), upper = at.upper.head(r_);
      take(lower.array() + part * (upper - lower).array(), postures_at, inside, cluster);
    }
    if (cluster.best.value > known) improve(cluster, postures_at, inside);
  }

  /// Takes over the best posture at theta_r in the cluster, if it is better.
  static void take(const Eigen::VectorXd& theta_r, const PosturesAt& postures_at,
                   const Inside& inside, Cluster& cluster) {
    std::vector<PosturePoint> postures;
    postures_at(theta_r, postures);
    const PosturePoint found = best_inside(postures, inside);
    if (!(found.value > cluster.best.value)) return;
    cluster.best = {found.x.head(theta_r.size()), found.value};
    cluster.x = found.x;
  }

  void improve(Cluster& cluster, const PosturesAt& postures_at, const Inside& inside) const {
    const Eigen::VectorXd lower = result_.lower.head(r_), upper = result_.upper.head(r_);
    const bool around = (cluster.upper.head(r_).array() > upper.array()).any();
    PartOf part(objective_.clone(), options_, around ? lower : cluster.lower.head(r_).eval(),
                around ? upper : cluster.upper.head(r_).eval(), inside);
    SearchOptions search;
    search.budget = kSearchBudget;
    search.starts = {cluster.best};
    search.interrupted = options_.interrupted;
    const SearchResult found = make_cmaes()->maximize(part, search);
    if (found.value > cluster.best.value) take(found.theta_r, postures_at, inside, cluster);
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
  const Eigen::Index r_;
  const double margin_;
  BoxTree tree_;
  PosturePoint best_known_;
  std::vector<std::vector<int>> members_;  ///< the boxes of each cluster
};

}  // namespace

void find_clusters(Objective& objective, const Candidate& best, const GoodOptions& options,
                   GoodPostures& result) {
  Clusters(objective, best, options, result).run();
}

}  // namespace maxwrench
