// A search of your own, by its name: compass search. From a start, it tries a step to both sides of
// each coordinate, moves to a better point, and halves the step if there is none. Where the start
// has no value, it starts at a random point.
#include <algorithm>
#include <cstdio>
#include <random>

#include "maxwrench/batch.h"
#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"

using namespace maxwrench;

class Compass : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    SearchRun run(options);
    SearchResult best;
    const auto attempt = [&](const Eigen::VectorXd& theta_r) {
      if (best.evaluations == options.budget || run.ended()) return false;
      run.add(1);
      ++best.evaluations;
      const double value = run.evaluate(objective, theta_r);
      if (!(value > best.value)) return false;
      best.conclude(Status::kBestFound);
      best.theta_r = theta_r;
      best.value = value;
      best.history.push_back({best.evaluations, value});
      return true;
    };
    const Box box(objective);
    const Eigen::VectorXd &lower = objective.lower(), &upper = objective.upper();
    std::mt19937_64 random(options.seed);
    std::uniform_real_distribution<double> unit;
    Eigen::VectorXd start =
        options.starts.empty() ? box.start(options.start) : options.starts[0].theta_r;
    while (!attempt(start)) {  // no value there, such as in a collision: somewhere else
      if (best.evaluations == options.budget || run.ended()) return best;
      start = box.theta_r(Eigen::VectorXd::NullaryExpr(box.free(), [&] { return unit(random); }));
    }
    for (double step = 0.25; step > 1e-7 && best.evaluations < options.budget && !run.ended();) {
      bool better = false;
      for (int k = 0; k < objective.dimension(); ++k) {
        for (const double by : {step, -step}) {
          Eigen::VectorXd theta_r = best.theta_r;
          theta_r[k] = std::clamp(theta_r[k] + by * (upper[k] - lower[k]), lower[k], upper[k]);
          better = attempt(theta_r) || better;
        }
      }
      if (!better) step /= 2;
    }
    return best;
  }
};

int main() {
  const bool local = true, accepts_starts = true;  // so it can be a later stage
  add_search({"compass", "compass search", local, [] { return std::make_unique<Compass>(); },
              accepts_starts});
  Options options;
  options.measure = "ellipsoid";
  options.budget = 2000;
  for (const char* name : {"compass", "sample+compass"}) {
    options.search = name;
    const Answer best = solve(load_problem("planar/force"), options);
    std::printf("%-15s %.6f %s after %ld evaluations\n", name, best.beta(), best.unit.c_str(),
                best.evaluations);
  }
}
