#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "maxwrench/problem.h"
#include "solvers/search/makers.h"
#include "solvers/search/mpc_window.h"

namespace maxwrench {
namespace {

constexpr int kMpcDrawn = 64;  // postures, of which each is held throughout the first horizon
constexpr std::size_t kMpcTried = 4;  // plans of the first horizon that are improved
constexpr int kMpcSteps = 30;         // linear programs of a horizon, at most

/// Receding horizon: at each knot the plan of the next H intervals is improved from the present
/// state, and its first interval is carried out.
class Mpc final : public Search {
 public:
  SearchResult maximize(Objective& given, const SearchOptions& options) override {
    return search_path(given, options, "mpc", &recede);
  }

 private:
  /// One motion for each H = 2, 4, 8, ... that is shorter than the path. Returns what they gave.
  static std::string recede(const PathContext& path) {
    const int last = path.problem.motion->k - 1;
    std::vector<std::string> values;
    for (int H = std::min(2, last); H < last || values.empty(); H *= 2) {
      const Eigen::MatrixXd P = motion(path, H);
      if (P.size() == 0 || path.probe.left() < 1) break;
      const double value = path.probe.evaluate(stacked(knots_of_spline(P)));
      values.push_back(value > -kInfinity ? fmt::format("{:.6g} with {}", value, H)
                                          : fmt::format("none with {}", H));
    }
    if (values.empty()) return kBudgetSpent;
    return fmt::format("horizons: {} intervals", fmt::join(values, ", "));
  }

  /// The control points (K×r) that were carried out; none if evaluations ran out.
  static Eigen::MatrixXd motion(const PathContext& path, int H) {
    const int last = path.problem.motion->k - 1;
    Eigen::MatrixXd P = first_plan(path, std::min(H, last));
    for (int knot = 1; knot + 1 < last && P.size() > 0; ++knot) {
      const int end = std::min(knot + H, last);
      MpcWindow window(path.source, path.problem, knot, end, path.count);
      // The plan so far, and the same with a stop at its end.
      const Eigen::Index planned = P.rows();
      P.conservativeResize(end + 1, Eigen::NoChange);
      for (Eigen::Index i = planned; i <= end; ++i) P.row(i) = P.row(i - 2);
      window.set(P.bottomRows(end + 2 - knot));
      for (Eigen::Index i = planned; i <= end; ++i) P.row(i) = P.row(i - 1);
      if (planned <= end) window.offer(P.bottomRows(end + 2 - knot));
      window.optimise(kMpcSteps);
      P.bottomRows(end + 2 - knot) = window.points();
      if (window.stopped()) P.resize(0, P.cols());
    }
    return P;
  }

  /// The plan of the first H intervals. The task leaves the start open, so it is part of the plan:
  /// the best plan from the best postures that can be held, of the given one and drawn ones.
  static Eigen::MatrixXd first_plan(const PathContext& path, int H) {
    MpcWindow window(path.source, path.problem, 0, H, path.count);
    std::vector<Candidate> held;
    for (int i = 0; i <= kMpcDrawn; ++i) {
      const Eigen::VectorXd theta_r = i == 0 ? path.start : drawn_posture(path, i);
      window.set(theta_r.transpose().replicate(H + 1, 1));
      held.push_back({theta_r, window.value()});
    }
    std::stable_sort(held.begin(), held.end(),
                     [](const Candidate& a, const Candidate& b) { return a.value > b.value; });
    Eigen::MatrixXd best;
    double value = -kInfinity;
    for (const Candidate& posture : std::span(held).first(kMpcTried)) {
      window.set(posture.theta_r.transpose().replicate(H + 1, 1));
      window.optimise(kMpcSteps);
      if (window.stopped()) return {};
      if (best.size() > 0 && !(window.value() > value)) continue;
      best = window.points();
      value = window.value();
    }
    return best;
  }
};

}  // namespace

std::unique_ptr<Search> make_mpc() { return std::make_unique<Mpc>(); }

}  // namespace maxwrench
