#include "maxwrench/batch.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "lib/math/require.h"
#include "maxwrench/interruption.h"

namespace maxwrench {

Box::Box(const Objective& objective) : lower_(objective.lower()), upper_(objective.upper()) {
  if (lower_.size() != upper_.size())
    throw std::invalid_argument("search bounds: lower and upper differ in size");
  for (int i = 0; i < lower_.size(); ++i) {
    if (!std::isfinite(lower_[i]) || !std::isfinite(upper_[i]) || lower_[i] > upper_[i])
      throw std::invalid_argument("search bounds of theta_r[" + std::to_string(i) +
                                  "]: expected finite lower <= upper");
    if (lower_[i] < upper_[i]) free_.push_back(i);
  }
}

Eigen::VectorXd Box::theta_r(const Eigen::VectorXd& x) const {
  Eigen::VectorXd result = lower_;
  for (int j = 0; j < free(); ++j) {
    const int i = free_[j];
    // Both ends are reached exactly.
    result[i] = x[j] >= 1 ? upper_[i] : lower_[i] + std::max(x[j], 0.0) * (upper_[i] - lower_[i]);
  }
  return result;
}

Eigen::VectorXd Box::unit(const Eigen::VectorXd& theta_r) const {
  Eigen::VectorXd x(free());
  for (int j = 0; j < free(); ++j) {
    const int i = free_[j];
    x[j] = (theta_r[i] - lower_[i]) / (upper_[i] - lower_[i]);
  }
  return x;
}

double Box::distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
  double distance = 0;
  for (const int i : free_)
    distance = std::max(distance, std::abs(a[i] - b[i]) / (upper_[i] - lower_[i]));
  return distance;
}

Eigen::VectorXd Box::slope(const Eigen::VectorXd& gradient) const {
  Eigen::VectorXd slope(free());
  for (int j = 0; j < free(); ++j) {
    const int i = free_[j];
    slope[j] = gradient[i] * (upper_[i] - lower_[i]);
  }
  return slope;
}

Eigen::VectorXd Box::start(const Eigen::VectorXd& start) const {
  if (start.size() == 0) return lower_ + (upper_ - lower_) / 2;
  return start.cwiseMax(lower_).cwiseMin(upper_);
}

void parallel_for(int threads, long count, const std::function<void(long)>& body) {
  if (threads == 1 || count == 1) {
    for (long i = 0; i < count; ++i) {
      end_if_interrupted();
      body(i);
    }
    return;
  }
  // More workers than cores are of no use, and TBB warns of those it does not have.
  tbb::task_arena arena(std::min(threads, tbb::info::default_concurrency()));
  // Every body sees what the caller wrote before, and the caller sees what the bodies wrote. TBB
  // guarantees this, but a thread sanitizer does not know it; so these atomics state it again.
  const std::atomic<bool>* const flag = Interruption::flag();
  std::atomic<long> begun{0}, ended{0};
  begun.store(1, std::memory_order_release);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<long>(0, count, 1),
        [&](const tbb::blocked_range<long>& range) {
          begun.load(std::memory_order_acquire);
          const Interruption interruption(flag);
          for (long i = range.begin(); i < range.end(); ++i) {
            end_if_interrupted();
            body(i);
          }
          ended.fetch_add(1, std::memory_order_release);
        },
        tbb::simple_partitioner());
  });
  ended.load(std::memory_order_acquire);
}

std::vector<double> evaluate_all(const Objective& objective, long count,
                                 const std::function<Eigen::VectorXd(long)>& point, int threads,
                                 SearchRun& run, bool guides) {
  // Large enough to justify a clone, small enough to distribute the work evenly.
  const long chunk = std::clamp(count / 64, 64L, 4096L);
  std::vector<double> values(count, std::numeric_limits<double>::quiet_NaN());
  parallel_for(threads, (count + chunk - 1) / chunk, [&](long c) {
    const std::unique_ptr<Objective> local = objective.clone();
    const long first = c * chunk;
    const long last = std::min(count, first + chunk);
    long i = first;
    for (; i < last && !run.ended(); ++i) {
      values[i] = evaluate_one(*local, point(i));
      run.show(guides ? -kInfinity : values[i]);
    }
    if (i > first) run.add(i - first);
  });
  return values;
}

double evaluate_one(Objective& objective, const Eigen::VectorXd& theta_r,
                    Eigen::VectorXd* gradient) {
  const double value = objective.evaluate(theta_r, gradient);
  return std::isnan(value) ? -kInfinity : value;
}

double SearchRun::evaluate(Objective& objective, const Eigen::VectorXd& theta_r,
                           Eigen::VectorXd* gradient) {
  const double value = evaluate_one(objective, theta_r, gradient);
  show(value);
  return value;
}

void require_threads(int threads) {
  require(threads >= 1 && threads <= kMostThreads, "threads", threads, "1 to 1024");
}

namespace {

void require_point(const char* key, const Eigen::VectorXd& point, int dimension) {
  if (point.size() != dimension) {
    throw std::invalid_argument(std::string(key) + ": got " + std::to_string(point.size()) +
                                " numbers, expected " + std::to_string(dimension));
  }
  for (const double number : point) {
    require(std::isfinite(number), key, number, "finite numbers");
  }
}

}  // namespace

void check(const SearchOptions& options, const Objective& objective) {
  require(options.budget >= 1, "budget", static_cast<double>(options.budget),
          "at least 1 evaluation");
  require_threads(options.threads);
  require(options.starts_wanted >= 0, "starts_wanted", static_cast<double>(options.starts_wanted),
          "at least 0");
  if (options.start.size() > 0) {
    require_point("search start", options.start, objective.dimension());
  }
  for (const Candidate& start : options.starts) {
    require_point("search starts", start.theta_r, objective.dimension());
    require(std::isfinite(start.value), "search starts", start.value, "finite values");
  }
}

}  // namespace maxwrench
