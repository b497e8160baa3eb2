#include "solvers/added_strategies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>

#include "lib/math/require.h"
#include "maxwrench/batch.h"
#include "maxwrench/robot.h"
#include "maxwrench/strategies.h"

namespace maxwrench {
namespace {

/// A copy of a text that lives as long as the program.
const char* kept(const char* text) {
  static std::mutex mutex;
  static auto* const texts = new std::deque<std::string>;  // its elements keep their place
  const std::lock_guard guard(mutex);
  return texts->emplace_back(text).c_str();
}

/// The entries that users added to one family. Those that were replaced stay, because a running
/// solve may refer to them.
template <class Entry>
class Additions {
 public:
  /// The only object of a family. It is never destroyed: an entry may hold objects of a language
  /// that has ended before the program does.
  static Additions& get() {
    static auto* const only = new Additions;
    return *only;
  }

  void add(Entry entry) {
    const std::lock_guard guard(mutex_);
    const Entry* const added = &entries_.emplace_back(std::move(entry));
    const auto same = std::find_if(newest_.begin(), newest_.end(), [added](const Entry* before) {
      return std::string_view(before->name) == added->name;
    });
    if (same == newest_.end()) {
      newest_.push_back(added);
    } else {
      *same = added;
    }
  }

  std::vector<const Entry*> newest() {
    const std::lock_guard guard(mutex_);
    return newest_;
  }

 private:
  std::mutex mutex_;
  std::deque<Entry> entries_;  // they keep their place
  std::vector<const Entry*> newest_;
};

template <class Entry>
bool any_named(std::span<const Entry> table, std::string_view name) {
  return std::any_of(table.begin(), table.end(),
                     [name](const Entry& entry) { return entry.name == name; });
}

/// Copies the texts of an entry whose name nothing else has.
template <class Entry>
void keep_texts(const char* family, bool taken, Entry& entry) {
  const std::string_view name = entry.name;
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  if (name.empty() || !std::all_of(name.begin(), name.end(), allowed)) {
    std::string shown(name);
    std::replace_if(
        shown.begin(), shown.end(), [](unsigned char c) { return c < ' '; }, ' ');  // in one line
    throw std::invalid_argument(
        fmt::format("{}: got '{}', expected a name of letters, digits and '_'", family, shown));
  }
  if (taken) {
    throw std::invalid_argument(
        fmt::format("{}: got '{}', expected a name that is not built in", family, name));
  }
  if (!entry.make) {
    throw std::invalid_argument(
        fmt::format("{}: got '{}' with an empty make, expected a function", family, name));
  }
  entry.name = kept(entry.name);
  entry.summary = kept(entry.summary ? entry.summary : "");
}

/// Throws std::invalid_argument if the maker of an entry returned null.
template <class Strategy>
std::unique_ptr<Strategy> require_made(const char* family, const char* name,
                                       std::unique_ptr<Strategy> made) {
  if (made) return made;
  throw std::invalid_argument(
      fmt::format("{}: got none from the make of '{}', expected an object", family, name));
}

/// A search of a user. The stages and restarts around it rely on what it counts and returns.
class AddedSearch final : public Search {
 public:
  AddedSearch(const char* name, std::unique_ptr<Search> search)
      : name_(name), search_(std::move(search)) {}

  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    SearchRun run(options);
    SearchOptions own = options;
    own.interrupted = [&run] { return run.ended(); };
    SearchResult result = search_->maximize(objective, own);
    result.interrupted = run.interrupted();
    const long fewest = result.interrupted ? 0 : 1;
    if (result.evaluations < fewest || result.evaluations > options.budget) {
      throw std::invalid_argument(
          fmt::format("search: got {} evaluations by '{}', expected {} to {}", result.evaluations,
                      name_, fewest, options.budget));
    }
    if (result.status == Status::kBestFound) {
      require_candidate({result.theta_r, result.value}, objective);
    }
    for (const Candidate& start : result.starts) require_candidate(start, objective);
    return result;
  }

 private:
  void require_candidate(const Candidate& candidate, const Objective& objective) const {
    if (candidate.theta_r.size() != objective.dimension()) {
      throw std::invalid_argument(
          fmt::format("search: got {} numbers as theta_r by '{}', expected {}",
                      candidate.theta_r.size(), name_, objective.dimension()));
    }
    if (!candidate.theta_r.allFinite() || !std::isfinite(candidate.value)) {
      throw std::invalid_argument(fmt::format(
          "search: got a point or a value that is not finite by '{}', expected finite numbers",
          name_));
    }
    for (int i = 0; i < objective.dimension(); ++i) {
      const double lower = objective.lower()[i], upper = objective.upper()[i];
      const double x = candidate.theta_r[i];
      if (x >= lower - kLimitTolerance && x <= upper + kLimitTolerance) continue;
      throw std::invalid_argument(fmt::format(
          "search: got {} as theta_r[{}] by '{}', expected {} to {}", x, i, name_, lower, upper));
    }
  }

  const char* name_;
  std::unique_ptr<Search> search_;
};

}  // namespace

void add_measure(MeasureEntry entry) {
  if (!entry.name) entry.name = "";
  keep_texts("measure", any_named(measures(), entry.name), entry);
  if (entry.unit) entry.unit = kept(entry.unit);
  entry.make = [name = entry.name, make = std::move(entry.make)](
                   const Problem& problem, std::unique_ptr<WrenchSolver> solver) {
    return require_made("measure", name, make(problem, std::move(solver)));
  };
  Additions<MeasureEntry>::get().add(std::move(entry));
}

void add_search(SearchEntry entry) {
  if (!entry.name) entry.name = "";
  require(entry.budget_fraction >= 0 && entry.budget_fraction <= 1, "budget_fraction",
          entry.budget_fraction, "a number from 0 to 1");
  require(entry.cost >= 1, "cost", entry.cost, "at least 1");
  const auto absent = not_built_in();  // a name means the same in every build
  bool taken = std::any_of(absent.begin(), absent.end(), [&entry](const Absent& other) {
    return std::string_view(other.family) == "search" && std::string_view(other.name) == entry.name;
  });
  for (const auto table : {trajectory_searches(), searches(), facet_searches(), transfer_searches(),
                           path_searches()}) {
    taken = taken || any_named(table, entry.name);
  }
  keep_texts("search", taken, entry);
  entry.make = [name = entry.name, make = std::move(entry.make)]() -> std::unique_ptr<Search> {
    return std::make_unique<AddedSearch>(name, require_made("search", name, make()));
  };
  Additions<SearchEntry>::get().add(std::move(entry));
}

std::vector<const MeasureEntry*> added_measures() {
  return Additions<MeasureEntry>::get().newest();
}

std::vector<const SearchEntry*> added_searches() { return Additions<SearchEntry>::get().newest(); }

}  // namespace maxwrench
