#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "lib/math/random.h"
#include "maxwrench/problem.h"
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
      return follow(flow, path.problem, path.seed, path.start, path.probe);
    });
  }

 private:
  /// Follows the flows from the given posture, from the maximum near it at t = 0, and from the
  /// maximum near the best of drawn postures. Returns what they gave.
  static std::string follow(ProjectedFlow& flow, const Problem& problem, std::uint64_t seed,
                            const Eigen::VectorXd& given, Probe& probe) {
    std::vector<std::string> values;
    const auto run = [&](const char* from, const Eigen::VectorXd& theta_r) {
      const Eigen::MatrixXd P = flow.flow(theta_r);
      if (flow.stopped() || probe.left() < 1) return;
      const double value = probe.evaluate(stacked(knots_of_spline(P)));
      values.push_back(value > -kInfinity ? fmt::format("{:.6g} {}", value, from)
                                          : fmt::format("none {}", from));
    };
    run("from the start", given);
    if (!flow.stopped()) run("from the maximum near it", flow.climb(given));
    if (!flow.stopped())
      run("from the best of drawn postures", flow.climb(drawn(flow, problem, seed, given)));
    if (values.empty()) return kBudgetSpent;
    return fmt::format("flows: {}", fmt::join(values, ", "));
  }

  static Eigen::VectorXd drawn(ProjectedFlow& flow, const Problem& problem, std::uint64_t seed,
                               const Eigen::VectorXd& given) {
    Eigen::VectorXd best = given;
    double value = -kInfinity;
    for (int i = 0; i < kDrawnPostures && !flow.stopped(); ++i) {
      Random random(seed, RandomUse::kSample, static_cast<std::uint64_t>(i));
      Eigen::VectorXd theta_r(given.size());
      for (Eigen::Index j = 0; j < theta_r.size(); ++j) {
        theta_r[j] = random.uniform(problem.theta_r_min[j], problem.theta_r_max[j]);
      }
      const double at = flow.value(0, theta_r);
      if (at > value) {
        best = theta_r;
        value = at;
      }
    }
    return best;
  }
};

}  // namespace

std::unique_ptr<Search> make_gradient_projection() {
  return std::make_unique<GradientProjection>();
}

}  // namespace maxwrench
