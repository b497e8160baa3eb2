#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <string>
#include <vector>

#include "solvers/search/makers.h"
#include "solvers/search/path_plan.h"
#include "solvers/search/projected_flow.h"

namespace maxwrench {
namespace {

constexpr int kDrawnPostures = 64;  // for the best start

/// The local resolution of the redundancy along a path: at each instant theta_r moves along the
/// gradient of the instant's capability, projected onto the null space of J, no faster than the
/// joints can. Nothing is optimised over the motion as a whole.
class GradientProjection final : public Search {
 public:
  SearchResult maximize(Objective& given, const SearchOptions& options) override {
    return search_path(given, options, "gradient_projection", [](const PathContext& path) {
      ProjectedFlow flow(path.source, path.problem, path.count);
      return follow(flow, path);
    });
  }

 private:
  /// Follows the flows from the given posture, from the maximum near it at t = 0, and from the
  /// maximum near the best of drawn postures. Returns what they gave.
  static std::string follow(ProjectedFlow& flow, const PathContext& path) {
    std::vector<std::string> values;
    const auto run = [&](const char* from, const Eigen::VectorXd& theta_r) {
      const Eigen::MatrixXd P = flow.flow(theta_r);
      if (flow.stopped() || path.probe.left() < 1) return;
      const double value = path.probe.evaluate(stacked(knots_of_spline(P)));
      values.push_back(value > -kInfinity ? fmt::format("{:.6g} {}", value, from)
                                          : fmt::format("none {}", from));
    };
    run("from the start", path.start);
    if (!flow.stopped()) run("from the maximum near it", flow.climb(path.start));
    if (const auto best = best_drawn(flow, path)) {
      run("from the best of drawn postures", flow.climb(*best));
    }
    if (values.empty()) return kBudgetSpent;
    return fmt::format("flows: {}", fmt::join(values, ", "));
  }

  /// The best drawn posture at t = 0; none if none has a value.
  static std::optional<Eigen::VectorXd> best_drawn(ProjectedFlow& flow, const PathContext& path) {
    std::optional<Eigen::VectorXd> best;
    double most = -kInfinity;
    for (int i = 0; i < kDrawnPostures && !flow.stopped(); ++i) {
      const Eigen::VectorXd theta_r = drawn_posture(path, i);
      const double value = flow.value(0, theta_r);
      if (!(value > most)) continue;
      best = theta_r;
      most = value;
    }
    return best;
  }
};

}  // namespace

std::unique_ptr<Search> make_gradient_projection() {
  return std::make_unique<GradientProjection>();
}

}  // namespace maxwrench
