#include "cli/suite/workers.h"

#include <algorithm>
#include <deque>
#include <mutex>
#include <optional>
#include <set>

#include "benchmarks/race/comparison.h"
#include "benchmarks/suite/cost.h"
#include "benchmarks/tables/write_file.h"
#include "cli/suite/row_writer.h"
#include "maxwrench/batch.h"

namespace maxwrench {
namespace {

struct Job {
  Case choice;
  double seconds;  ///< expected
  bool alone;      ///< would wait for another job of this kind
};

/// Hands out each job once, the longest first; of jobs that must run alone, only one at a time.
class Jobs {
 public:
  explicit Jobs(std::vector<Job> jobs) {
    std::stable_sort(jobs.begin(), jobs.end(),
                     [](const Job& a, const Job& b) { return a.seconds > b.seconds; });
    for (Job& job : jobs) (job.alone ? alone_ : others_).push_back(std::move(job));
  }

  std::optional<Job> next() {
    const std::lock_guard guard(mutex_);
    std::deque<Job>& jobs = alone_busy_ || alone_.empty() ? others_ : alone_;
    if (jobs.empty()) return std::nullopt;
    Job job = std::move(jobs.front());
    jobs.pop_front();
    alone_busy_ = alone_busy_ || job.alone;
    return job;
  }
  void finished(const Job& job) {
    const std::lock_guard guard(mutex_);
    if (job.alone) alone_busy_ = false;
  }
  void stop() {
    const std::lock_guard guard(mutex_);
    alone_.clear();
    others_.clear();
  }

 private:
  std::mutex mutex_;
  std::deque<Job> alone_, others_;
  bool alone_busy_ = false;
};

}  // namespace

void solve_cases(const Workload& work, const std::vector<Case>& cases,
                 const std::filesystem::path& folder, int threads) {
  const Forecast forecast(times_table(folder));
  std::vector<Job> all;
  double seconds = 0;
  for (const Case& c : cases) {
    all.push_back({c, forecast.seconds(work.problems.at(c.problem), c), waits_for_others(c)});
    seconds += all.back().seconds;
  }
  std::set<std::string> named;
  for (const Case& c : cases) {
    if (named.insert(c.problem).second) prepare(work.problems.at(c.problem), threads);
  }
  RowWriter writer("run", folder, 1, seconds);
  if (!work.suite.empty()) write_file(folder / "suite.toml", work.suite);
  Jobs jobs(std::move(all));
  parallel_for(threads, threads, [&](long) {
    try {
      while (const auto job = jobs.next()) {
        writer.carry_out(work.problems.at(job->choice.problem), job->choice, job->seconds);
        jobs.finished(*job);
      }
    } catch (...) {
      jobs.stop();
      throw;
    }
  });
  writer.finish();
}

}  // namespace maxwrench
