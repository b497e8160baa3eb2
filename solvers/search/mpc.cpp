#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "lib/math/random.h"
#include "lib/trajectory/task_of.h"
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
    check(options, given);
    const InstantSource& source = require_path(given, "mpc");
    auto& objective = dynamic_cast<TrajectoryObjective&>(given);
    const Problem& problem = task_of(objective);
    const Box box(objective);
    SearchRun run(options);
    Probe probe(objective, options.budget, run, options.starts_wanted > 0 ? &box : nullptr);
    const Eigen::VectorXd start = box.start(options.start);
    probe.evaluate(start);
    std::string stopped = kBudgetSpent;
    if (objective.dimension() == 0) {
      stopped = "there is nothing to choose";
    } else if (probe.left() > 1) {
      const MotionTask& task = *problem.motion;
      InstantCount count(probe, task.instants_per_interval * (task.k - 1) + 1, 1);
      const Horizons horizons{source, problem, options.seed, unstacked(start, task.k).row(0),
                              count};
      stopped = recede(horizons, probe);
    }
    SearchResult result = make_result(probe.take(), box, options, run);
    result.stopped = stopped;
    return result;
  }

 private:
  struct Horizons {
    const InstantSource& source;
    const Problem& problem;
    std::uint64_t seed;
    Eigen::VectorXd start;
    InstantCount& count;
  };

  /// One motion for each H = 2, 4, 8, ... that is shorter than the path. Returns what they gave.
  static std::string recede(const Horizons& horizons, Probe& probe) {
    const int last = horizons.problem.motion->k - 1;
    std::vector<std::string> values;
    for (int H = std::min(2, last); H < last || values.empty(); H *= 2) {
      const Eigen::MatrixXd P = motion(horizons, H);
      if (P.size() == 0 || probe.left() < 1) break;
      const double value = probe.evaluate(stacked(knots_of_spline(P)));
      values.push_back(value > -kInfinity ? fmt::format("{:.6g} with {}", value, H)
                                          : fmt::format("none with {}", H));
    }
    if (values.empty()) return kBudgetSpent;
    return fmt::format("horizons: {} intervals", fmt::join(values, ", "));
  }

  /// The control points (K×r) that were carried out; none if evaluations ran out.
  static Eigen::MatrixXd motion(const Horizons& horizons, int H) {
    const int last = horizons.problem.motion->k - 1;
    Eigen::MatrixXd P = first_plan(horizons, std::min(H, last));
    for (int knot = 1; knot + 1 < last && P.size() > 0; ++knot) {
      const int end = std::min(knot + H, last);
      MpcWindow window(horizons.source, horizons.problem, knot, end, horizons.count);
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
  static Eigen::MatrixXd first_plan(const Horizons& horizons, int H) {
    const Problem& problem = horizons.problem;
    MpcWindow window(horizons.source, problem, 0, H, horizons.count);
    std::vector<Candidate> held;
    for (int i = 0; i <= kMpcDrawn; ++i) {
      Random random(horizons.seed, RandomUse::kSample, static_cast<std::uint64_t>(i));
      Eigen::VectorXd theta_r = horizons.start;
      for (Eigen::Index j = 0; i > 0 && j < theta_r.size(); ++j) {
        theta_r[j] = random.uniform(problem.theta_r_min[j], problem.theta_r_max[j]);
      }
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
