#include "benchmarks/race/race_summary.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "maxwrench/strategies.h"

namespace maxwrench {
namespace {

constexpr std::size_t kThousandth = 2;
static_assert(kTargetShares[kThousandth] == 1e-3);

const Contender* contender_of(const Comparison& comparison, const std::string& search) {
  for (const Contender& contender : comparison.contenders) {
    if (contender.search == search && !contender.attempts.empty()) return &contender;
  }
  return nullptr;
}

double median_value(const Contender& contender) {
  std::vector<double> values;
  for (const Attempt& each : contender.attempts) values.push_back(each.value);
  return median(std::move(values));
}

double least_seconds(const Comparison& comparison) {
  double least = kInfinity;
  for (const Contender& contender : comparison.contenders) {
    least = std::min(least, contender.expected(comparison.target(), &Spent::seconds));
  }
  return least;
}

Standing standing_of(std::span<const Comparison> comparisons, const std::string& search) {
  Standing standing;
  standing.search = search;
  std::vector<double> factors;
  for (const Comparison& comparison : comparisons) {
    const Contender* contender = contender_of(comparison, search);
    standing.is_default = standing.is_default || comparison.default_search == search;
    standing.supported += contender ? 1 : 0;
    const double seconds =
        contender ? contender->expected(comparison.target(), &Spent::seconds) : kInfinity;
    standing.seconds.push_back(seconds);
    const double least = least_seconds(comparison);
    factors.push_back(std::isfinite(seconds) && least > 0 ? seconds / least : kInfinity);
  }
  standing.typical = median(factors);
  if (!factors.empty()) standing.worst = *std::max_element(factors.begin(), factors.end());
  for (std::size_t i = 0; i < kTargetShares.size(); ++i) {
    double reached = 0, all = 0;
    for (const Comparison& comparison : comparisons) {
      for (const Spent& hit : hits_of(comparison, search, kTargetShares[i])) {
        reached += std::isfinite(hit.evaluations) ? 1 : 0;
        ++all;
      }
    }
    standing.reached[i] = all > 0 ? reached / all : 0;
  }
  return standing;
}

}  // namespace

std::vector<Spent> hits_of(const Comparison& comparison, const std::string& search, double share) {
  std::vector<Spent> hits;
  if (const Contender* contender = contender_of(comparison, search)) {
    for (const Attempt& each : contender->attempts) {
      hits.push_back(first_hit(each.run, comparison.target(share)));
    }
    return hits;
  }
  std::size_t seeds = 1;
  for (const Contender& other : comparison.contenders) {
    seeds = std::max(seeds, other.attempts.size());
  }
  hits.assign(seeds, kNever);
  return hits;
}

std::vector<const Contender*> ranking(const Comparison& comparison) {
  std::vector<std::tuple<double, double, const Contender*>> keyed;
  for (const Contender& contender : comparison.contenders) {
    if (contender.attempts.empty()) continue;
    keyed.emplace_back(contender.expected(comparison.target(), &Spent::seconds),
                       -median_value(contender), &contender);
  }
  std::stable_sort(keyed.begin(), keyed.end(), [](const auto& a, const auto& b) {
    return std::tie(std::get<0>(a), std::get<1>(a)) < std::tie(std::get<0>(b), std::get<1>(b));
  });
  std::vector<const Contender*> ranked;
  for (const auto& each : keyed) ranked.push_back(std::get<2>(each));
  return ranked;
}

bool is_plain(const std::string& search) {
  const auto table = searches();
  return std::any_of(table.begin(), table.end(),
                     [&](const SearchEntry& entry) { return entry.name == search; });
}

std::vector<Standing> standings(std::span<const Comparison> comparisons) {
  std::vector<Standing> all;
  for (const Comparison& comparison : comparisons) {
    for (const Contender& contender : comparison.contenders) {
      const bool known = std::any_of(all.begin(), all.end(), [&](const Standing& other) {
        return other.search == contender.search;
      });
      if (!known) all.push_back(standing_of(comparisons, contender.search));
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Standing& a, const Standing& b) {
    if (a.typical != b.typical) return a.typical < b.typical;
    return a.reached[kThousandth] > b.reached[kThousandth];
  });
  return all;
}

std::vector<std::string> leaders(const std::vector<Standing>& standings, std::size_t count) {
  std::vector<std::string> names;
  auto defaults = static_cast<std::size_t>(std::count_if(
      standings.begin(), standings.end(), [](const auto& s) { return s.is_default; }));
  for (const Standing& standing : standings) {
    defaults -= standing.is_default ? 1 : 0;
    if (standing.is_default || names.size() + defaults < count) names.push_back(standing.search);
  }
  return names;
}

std::vector<EcdfStep> target_ecdf(std::span<const Comparison> comparisons,
                                  const std::string& search, Cost cost) {
  std::vector<double> hits;
  for (const Comparison& comparison : comparisons) {
    for (const double share : kTargetShares) {
      for (const Spent& hit : hits_of(comparison, search, share)) hits.push_back(hit.*cost);
    }
  }
  return ecdf(std::move(hits));
}

}  // namespace maxwrench
