#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "maxwrench/strategies.h"
#include "solvers/added_strategies.h"
#include "solvers/search/composition.h"
#include "solvers/search/makers.h"
#include "solvers/search/restart.h"

namespace maxwrench {
namespace {

/// The entries that are built in, then those that users added.
template <class Entry>
std::vector<const Entry*> with_added(std::initializer_list<std::span<const Entry>> built_in,
                                     const std::vector<const Entry*>& added) {
  std::vector<const Entry*> all;
  for (const std::span<const Entry> table : built_in) {
    for (const Entry& entry : table) all.push_back(&entry);
  }
  all.insert(all.end(), added.begin(), added.end());
  return all;
}

template <class Entry>
const char* name_in(const Entry& entry) {
  return entry.name;
}
template <class Entry>
const char* name_in(const Entry* entry) {
  return entry->name;
}

template <class Entry>
const Entry& find(std::span<const Entry> table, const char* family, std::string_view name) {
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&](const Entry& entry) { return name_in(entry) == name; });
  if (found != table.end()) return *found;
  std::vector<std::string_view> names;
  for (const Entry& entry : table) names.emplace_back(name_in(entry));
  std::string why;
  for (const Absent& absent : not_built_in()) {
    if (absent.name != name || std::string_view(absent.family) != family) continue;
    why = fmt::format(", which is not built in (it needs {})", absent.library);
  }
  throw std::invalid_argument(
      fmt::format("{}: got '{}'{}, expected one of {}", family, name, why, fmt::join(names, " ")));
}

/// The stages that a name lists.
NamedSearch find_stages(std::span<const SearchEntry* const> table, std::string_view name) {
  NamedSearch search{std::string(name), name.starts_with(kRestarted), {}, true};
  if (search.restarts) name.remove_prefix(kRestarted.size());
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('+', begin), name.size());
    const SearchEntry& stage = *find(table, "search", name.substr(begin, end - begin));
    if (begin > 0 && !stage.accepts_starts) {
      std::vector<std::string_view> others;
      for (const SearchEntry* entry : table) {
        if (entry->accepts_starts) others.emplace_back(entry->name);
      }
      throw std::invalid_argument(fmt::format(
          "search: got '{}', where {} accepts no start, expected as a later stage one of {}", name,
          stage.name, fmt::join(others, " ")));
    }
    search.stages.push_back(&stage);
    search.local = search.local && stage.local;
    begin = end + 1;
  }
  return search;
}

}  // namespace

std::vector<std::string> stiff_integrators() {
  std::vector<std::string> names;
  for (const IntegratorEntry& entry : integrators()) {
    if (entry.stiff) names.emplace_back(entry.name);
  }
  return names;
}

const MeasureEntry& find_measure(std::string_view name) {
  const auto table = with_added({measures()}, added_measures());
  return *find(std::span(table), "measure", name);
}
const LpEntry& find_lp_solver(std::string_view name) { return find(lp_solvers(), "solver", name); }
const WrenchSolverEntry& find_wrench_solver(std::string_view name) {
  return find(wrench_solvers(), "solver", name);
}
const TrajectorySolverEntry& find_trajectory_solver(std::string_view name) {
  return find(trajectory_solvers(), "solver", name);
}
NamedSearch find_search(std::string_view name) {
  return find_stages(with_added({trajectory_searches(), searches(), facet_searches(),
                                 transfer_searches(), path_searches()},
                                added_searches()),
                     name);
}
std::unique_ptr<Search> NamedSearch::make() const {
  if (restarts) return make_restart({name, false, stages, local});
  return stages.size() == 1 ? stages.front()->make() : make_composition(stages);
}
const IntegratorEntry& find_integrator(std::string_view name) {
  return find(integrators(), "integrator", name);
}

}  // namespace maxwrench
