#include "benchmarks/report/differences.h"

#include <cmath>
#include <map>

#include "benchmarks/race/race_statistics.h"
#include "benchmarks/race/significance.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

using RowsByCase = std::map<std::vector<std::string>, const ResultRow*>;

RowsByCase rows_by_case(const Results& results) {
  RowsByCase rows;
  for (const ResultRow& row : results.rows) rows[case_values(row.choice)] = &row;
  return rows;
}

void compare_values(const RowPair& pair, Differences& changes) {
  const ResultRow &a = *pair.a, &b = *pair.b;
  const bool as_held = !a.is_experiment() || a.reason.empty() == b.reason.empty();
  const bool comparable =
      as_held && a.status == b.status && a.beta.has_value() == b.beta.has_value();
  const double away = comparable && a.beta ? std::abs(*a.beta - *b.beta) : 0;
  const double rounding = a.is_experiment() ? kSameReading : kSameValue;
  if (!comparable || away > rounding * (1 + std::abs(a.beta.value_or(0)))) {
    changes.changed.push_back(pair);
  } else {
    ++(away == 0 ? changes.same : changes.rounded);
  }
}

TimeRatio time_change(const std::string& column, const std::string& name,
                      const std::vector<double>& ratios) {
  std::vector<double> logarithms;
  for (const double ratio : ratios) logarithms.push_back(std::log(ratio));
  const ConfidenceInterval interval = median_interval(ratios);
  return {column,       name,          static_cast<long>(ratios.size()), median(ratios),
          interval.low, interval.high, wilcoxon_signed_rank(logarithms)};
}

std::vector<TimeRatio> time_changes(const std::vector<RowPair>& pairs) {
  std::map<std::pair<int, std::string>, std::vector<double>> ratios;
  for (const RowPair& pair : pairs) {
    const bool experiment = pair.a->is_experiment();
    const std::optional<double> a = experiment ? pair.a->ms() : pair.a->us;
    const std::optional<double> b = experiment ? pair.b->ms() : pair.b->us;
    if (!a || !b || *a <= 0 || *b <= 0) continue;
    const Case& c = pair.a->choice;
    const std::string names[] = {"rows", c.solver, c.search, c.problem, c.integrator};
    for (int i = 0; i < 5; ++i) {
      const bool of_searches = i == 1 || i == 2;
      if (experiment ? of_searches : names[i].empty()) continue;
      ratios[{i, names[i]}].push_back(*b / *a);
    }
  }
  static const char* const kColumns[] = {"all", "solver", "search", "problem", "integrator"};
  std::vector<TimeRatio> changes;
  std::vector<double> p;
  for (const auto& [key, sample] : ratios) {
    changes.push_back(time_change(kColumns[key.first], key.second, sample));
    p.push_back(changes.back().p);
  }
  p = holm(p);
  for (std::size_t i = 0; i < p.size(); ++i) changes[i].p = p[i];
  return changes;
}

}  // namespace

bool TimeRatio::is_significant() const {
  return p < 0.05 && (times_low > 1 + kDrift || times_high < 1 / (1 + kDrift));
}

Differences find_differences(const Results& a, const Results& b) {
  Differences changes;
  const RowsByCase before = rows_by_case(a), after = rows_by_case(b);
  std::vector<RowPair> pairs;
  for (const auto& [key, row] : before) {
    const auto found = after.find(key);
    if (found == after.end()) {
      changes.only_a.push_back(row);
    } else {
      pairs.push_back({row, found->second});
    }
  }
  for (const auto& [key, row] : after) {
    if (!before.contains(key)) changes.only_b.push_back(row);
  }
  for (const RowPair& pair : pairs) compare_values(pair, changes);
  changes.times = time_changes(pairs);
  return changes;
}

}  // namespace maxwrench
