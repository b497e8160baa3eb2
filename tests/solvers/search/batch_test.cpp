#include "maxwrench/batch.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cmath>
#include <functional>

#include "tests/support/known.h"
#include "tests/support/refusals.h"

namespace maxwrench {
namespace {

using Eigen::VectorXd;

std::size_t allowed_threads() {
  return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
}

/// How many threads the process may use is the caller's business, during a call and after.
TEST(ParallelFor, LeavesTheCallersThreadsAlone) {
  const std::size_t before = allowed_threads();
  const auto call = [](std::size_t allowed) {
    std::atomic<long> calls = 0;
    parallel_for(static_cast<int>(allowed) + 6, 100, [&](long) {
      EXPECT_EQ(allowed_threads(), allowed);
      ++calls;
    });
    EXPECT_EQ(calls, 100);
    EXPECT_EQ(allowed_threads(), allowed);
  };
  call(before);
  {
    const tbb::global_control own(tbb::global_control::max_allowed_parallelism, 1);
    call(1);
  }
  tbb::task_arena arena(3);
  arena.execute([&] {
    call(before);
    EXPECT_EQ(tbb::this_task_arena::max_concurrency(), 3);
  });
}

Known round_hill() {
  return {[](const VectorXd& x) { return -x.squaredNorm(); }, VectorXd::Constant(2, -1),
          VectorXd::Constant(2, 1)};
}

TEST(SearchOptions, RejectWhatIsOutOfRange) {
  const Known objective = round_hill();
  const auto rejected = [&](const char* key, const std::function<void(SearchOptions&)>& spoil) {
    SearchOptions options;
    spoil(options);
    expect_rejected(key, [&] { check(options, objective); });
  };
  EXPECT_NO_THROW(check({}, objective));
  for (const long budget : {0L, -1L}) {
    rejected("budget", [&](SearchOptions& options) { options.budget = budget; });
  }
  for (const int threads : {0, -1, 1025}) {
    rejected("threads", [&](SearchOptions& options) { options.threads = threads; });
  }
  rejected("starts_wanted", [](SearchOptions& options) { options.starts_wanted = -1; });
  for (const double value : {std::nan(""), kInfinity, -kInfinity}) {
    const Eigen::Vector2d point(0.5, value);
    rejected("search start", [&](SearchOptions& options) { options.start = point; });
    rejected("search starts", [&](SearchOptions& options) { options.starts = {{point, 1}}; });
    rejected("search starts", [&](SearchOptions& options) {
      options.starts = {{VectorXd::Zero(2), value}};
    });
  }
  rejected("search start", [](SearchOptions& options) { options.start = VectorXd::Zero(3); });
  rejected("search starts", [](SearchOptions& options) {
    options.starts = {{VectorXd::Zero(2), 1}, {VectorXd::Zero(1), 1}};
  });
}

TEST(SearchRun, AsksUntilTheAnswerIsYes) {
  long asked = 0;
  SearchOptions options;
  options.interrupted = [&] { return ++asked == 3; };
  SearchRun run(options);
  EXPECT_FALSE(run.ended());
  EXPECT_FALSE(run.ended());
  EXPECT_FALSE(run.interrupted());
  EXPECT_TRUE(run.ended());
  EXPECT_TRUE(run.ended());
  EXPECT_TRUE(run.interrupted());
  EXPECT_EQ(asked, 3);
}

/// Chunks of 64 points.
TEST(EvaluateAll, MakesNoMoreOnceTheRunHasEnded) {
  const Known objective = round_hill();
  std::atomic<long> left = 70, reported = 0, shown = 0;
  SearchOptions options;
  options.interrupted = [&] { return left <= 0; };
  options.progress = [&](long count) { reported = count; };
  options.evaluated = [&](double value) {
    --left;
    ++shown;
    EXPECT_LE(value, 0);
  };
  SearchRun run(options);
  const auto point = [](long i) { return VectorXd::Constant(2, 1e-3 * static_cast<double>(i)); };
  const std::vector<double> values = evaluate_all(objective, 200, point, 1, run);
  ASSERT_EQ(values.size(), 200U);
  EXPECT_EQ(values[69], -2 * 0.069 * 0.069);
  EXPECT_TRUE(std::isnan(values[70]));
  EXPECT_TRUE(std::isnan(values[199]));
  EXPECT_EQ(objective.count(), 70);
  EXPECT_EQ(reported, 70);
  EXPECT_EQ(shown, 70);
}

}  // namespace
}  // namespace maxwrench
