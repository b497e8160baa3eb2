#include "maxwrench/batch.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>

namespace maxwrench {
namespace {

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

}  // namespace
}  // namespace maxwrench
