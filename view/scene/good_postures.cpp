#include "solvers/certify/good_postures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "solvers/solve/format.h"
#include "view/base64.h"
#include "view/scene/parts.h"
#include "view/scene/scene.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMostBoxes = 20'000;  ///< of a page: about half a megabyte
/// Clusters that a page lists; the others are one, whose number this is.
constexpr int kMostClusters = 50;

double widest_side(const std::vector<GoodBox>& boxes) {
  double most = 0;
  for (const GoodBox& box : boxes) most = std::max(most, (box.upper - box.lower).maxCoeff());
  return most;
}

/// The boxes whose centres are in the same cell of a grid, and in the same cluster, as the box
/// around them. No good posture is outside these either.
std::vector<GoodBox> joined(const std::vector<GoodBox>& boxes, double side) {
  std::map<std::pair<int, std::vector<long>>, GoodBox> cells;
  for (const GoodBox& box : boxes) {
    std::vector<long> cell;
    for (const double x : (box.lower + box.upper) / 2) cell.push_back(std::lround(x / side));
    const auto [at, first] = cells.try_emplace({box.cluster, std::move(cell)}, box);
    if (first) continue;
    GoodBox& all = at->second;
    all.lower = all.lower.cwiseMin(box.lower);
    all.upper = all.upper.cwiseMax(box.upper);
    all.high = std::max(all.high, box.high);
  }
  std::vector<GoodBox> list;
  for (auto& [cell, box] : cells) list.push_back(std::move(box));
  return list;
}

/// No more boxes than a page holds, those with the largest bounds first.
std::vector<GoodBox> drawn_boxes(std::vector<GoodBox> boxes) {
  for (GoodBox& box : boxes) box.cluster = std::min(box.cluster, kMostClusters);
  for (double side = widest_side(boxes); boxes.size() > kMostBoxes; side *= 1.5) {
    boxes = joined(boxes, side);
  }
  std::stable_sort(boxes.begin(), boxes.end(),
                   [](const GoodBox& a, const GoodBox& b) { return a.high > b.high; });
  return boxes;
}

/// Ends of boxes as 16-bit shares of the limits, rounded outward.
class Shares {
 public:
  explicit Shares(const Problem& problem)
      : low_(problem.theta_r_min),
        extent_((problem.theta_r_max - problem.theta_r_min).cwiseMax(1e-9)) {}

  void add(const GoodBox& box) {
    constexpr double kMost = 65535;
    for (Eigen::Index i = 0; i < low_.size(); ++i) {
      const auto share = [&](double x) { return kMost * (x - low_[i]) / extent_[i]; };
      append_bytes(static_cast<std::uint16_t>(
                       std::clamp(std::floor(share(box.lower[i]) + 1e-6), 0.0, kMost)),
                   lower_);
      append_bytes(
          static_cast<std::uint16_t>(std::clamp(std::ceil(share(box.upper[i]) - 1e-6), 0.0, kMost)),
          upper_);
    }
  }

  void put(ordered_json& object) const {
    object["low"] = array(low_);
    object["extent"] = array(extent_);
    object["lower"] = base64(lower_);
    object["upper"] = base64(upper_);
  }

 private:
  Eigen::VectorXd low_, extent_;
  std::string lower_, upper_;
};

ordered_json clusters_json(const GoodPostures& good) {
  ordered_json list = ordered_json::array();
  const auto most = static_cast<std::size_t>(kMostClusters);
  for (std::size_t i = 0; i < std::min(good.clusters.size(), most); ++i) {
    const Cluster& cluster = good.clusters[i];
    const bool found = cluster.best.value > -kInfinity;
    list.push_back({{"holds", good.holds(cluster)},
                    {"boxes", cluster.boxes},
                    {"beta", known(found, cluster.best.value)},
                    {"theta_r", known(found, array(cluster.best.theta_r))}});
  }
  return list;
}

}  // namespace

ordered_json within_json(const Problem& problem, const GoodPostures& good, double share) {
  const std::vector<GoodBox> boxes = drawn_boxes(good.boxes);
  long holding = 0;
  for (const Cluster& cluster : good.clusters) holding += good.holds(cluster) ? 1 : 0;
  ordered_json object = {{"share", share},
                         {"least", good.least},
                         {"status", to_string(good.status)},
                         {"reason", known(!good.reason.empty(), good.reason.str())},
                         {"boxes", good.boxes.size()},
                         {"drawn", boxes.size()},
                         {"widest", widest_side(boxes)},
                         {"clusters_all", good.clusters.size()},
                         {"holding", holding},
                         {"clusters", clusters_json(good)}};
  Shares shares(problem);
  std::string cluster;
  for (const GoodBox& box : boxes) {
    shares.add(box);
    append_bytes(static_cast<std::uint8_t>(box.cluster), cluster);
  }
  shares.put(object);
  object["cluster"] = base64(cluster);
  return object;
}

}  // namespace maxwrench
