#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "lib/math/random.h"
#include "maxwrench/batch.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"

// Measures and searches of a user.

namespace maxwrench {

/// -|tau_d|^2 by its value and, unless `silent`, its derivatives.
class OwnEase : public Measure {
 public:
  explicit OwnEase(double factor = 1, bool silent = false) : factor_(factor), silent_(silent) {}
  void evaluate_well_formed(const Posture& posture, const WrenchProgram& /*program*/,
                            bool /*efforts*/, Capability& capability) override {
    capability.conclude(Status::kOptimal);
    capability.beta = -factor_ * posture.tau_d.squaredNorm();
    if (silent_) return;
    capability.lambda = -2 * factor_ * posture.tau_d;
    capability.beta_J.setZero(6, posture.J.cols());
  }

 private:
  double factor_;
  bool silent_;
};

inline MeasureEntry ease_entry(const char* name, double factor = 1) {
  return {name,  "minus the squared load",
          false, false,
          "N^2", [factor](const Problem&, auto) { return std::make_unique<OwnEase>(factor); }};
}

/// Tries the start, or the best earlier point, and then random points in parallel.
class OwnRandom : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    SearchRun run(options);
    const Box box(objective);
    SearchResult result;
    const auto point = [&](long i) -> Eigen::VectorXd {
      if (i == 0) return options.starts.empty() ? options.start : options.starts[0].theta_r;
      Random random(options.seed + static_cast<std::uint64_t>(i));
      return box.theta_r(
          Eigen::VectorXd::NullaryExpr(box.free(), [&] { return random.uniform(); }));
    };
    const auto values = evaluate_all(objective, options.budget, point, options.threads, run);
    for (long i = 0; i < options.budget; ++i) {
      const double value = values[static_cast<std::size_t>(i)];
      if (std::isnan(value)) break;
      result.evaluations = i + 1;
      if (!(value > result.value)) continue;
      result.conclude(Status::kBestFound);
      result.theta_r = point(i);
      result.value = value;
      result.history.push_back({i + 1, value});
    }
    return result;
  }
};

inline SearchEntry random_entry(const char* name, bool accepts_starts = true) {
  return {name, "random points", false, [] { return std::make_unique<OwnRandom>(); },
          accepts_starts};
}

/// A search that returns what a function makes of the options.
class OwnResult : public Search {
 public:
  explicit OwnResult(std::function<SearchResult(const SearchOptions&)> make)
      : make_(std::move(make)) {}
  SearchResult maximize(Objective& /*objective*/, const SearchOptions& options) override {
    return make_(options);
  }

 private:
  std::function<SearchResult(const SearchOptions&)> make_;
};

inline Options of_measure(const std::string& measure, const std::string& search = "",
                          long budget = 0) {
  Options options;
  options.measure = measure;
  options.search = search;
  options.budget = budget;
  return options;
}

}  // namespace maxwrench
