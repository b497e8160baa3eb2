// A search of your own: compass search. From a start, it tries a step to both sides of each
// coordinate, moves to a better point, and halves the step if there is none.
#include <algorithm>
#include <cstdio>

#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"

using namespace maxwrench;

class Compass : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    SearchResult best;
    const Eigen::VectorXd start = 0.5 * (objective.lower() + objective.upper());
    const auto attempt = [&](const Eigen::VectorXd& theta_r) {
      const bool ended = options.interrupted && options.interrupted();
      if (ended || best.evaluations == options.budget) return false;
      ++best.evaluations;
      const double value = objective.evaluate(theta_r);
      if (!(value > best.value)) return false;
      best.conclude(Status::kBestFound);
      best.theta_r = theta_r;
      best.value = value;
      best.history.push_back({best.evaluations, value});
      return true;
    };
    if (!attempt(options.start.size() > 0 ? options.start : start)) return best;
    for (double step = 0.25; step > 1e-7 && best.evaluations < options.budget;) {
      bool better = false;
      for (int i = 0; i < 2 * start.size(); ++i) {
        const int k = i / 2;
        const double range = objective.upper()[k] - objective.lower()[k];
        Eigen::VectorXd theta_r = best.theta_r;
        theta_r[k] = std::clamp(theta_r[k] + (i % 2 == 0 ? step : -step) * range,
                                objective.lower()[k], objective.upper()[k]);
        better = attempt(theta_r) || better;
      }
      if (!better) step /= 2;
    }
    return best;
  }
};

int main() {
  const Problem problem = load_problem("planar/force");
  const auto objective = make_capability_objective(
      problem, Wrench::kPure, [&problem] { return make_ellipsoid(problem.robot); });
  SearchOptions options;
  options.start = problem.theta_r_default;
  Compass compass;
  const SearchResult best = compass.maximize(*objective, options);
  std::printf("compass  %.6f %s after %ld evaluations\n", best.value, problem.unit(),
              best.evaluations);
  const SearchResult other = find_search(general_search()).make()->maximize(*objective, options);
  std::printf("default  %.6f %s after %ld evaluations\n", other.value, problem.unit(),
              other.evaluations);
}
