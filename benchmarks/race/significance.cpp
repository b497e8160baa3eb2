#include "benchmarks/race/significance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace maxwrench {
namespace {

constexpr std::size_t kExactUpTo = 100;

/// The number of standard deviations beyond which a double cannot represent the tail of the
/// binomial distribution.
constexpr double kFar = 40;

/// P(Binomial(n, share) >= k), k of 1 to n.
double binomial_tail(int n, double share, int k) {
  if (share >= 1) return 1;
  const double mean = n * share, far = kFar * std::sqrt(mean * (1 - share));
  if (k < mean - far) return 1;
  const int last = std::min(n, static_cast<int>(mean + far) + 1);
  double sum = 0;
  for (int j = k; j <= last; ++j) {
    sum += std::exp(std::lgamma(n + 1) - std::lgamma(j + 1) - std::lgamma(n - j + 1) +
                    j * std::log(share) + (n - j) * std::log1p(-share));
  }
  return std::min(sum, 1.0);
}

/// The rank in the sample, 1 to n, of a quantile of the k-th smallest of n drawn values.
int bootstrap_place(int n, int k, double probability) {
  int low = 1, high = n;
  while (low < high) {
    const int middle = (low + high) / 2;
    const double below = binomial_tail(n, static_cast<double>(middle) / n, k);
    if (below >= probability) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return low;
}

/// Twice the rank of each size, so that means of ranks are whole numbers.
std::vector<int> doubled_ranks(const std::vector<double>& sizes) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return sizes[a] < sizes[b]; });
  std::vector<int> ranks(sizes.size());
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && sizes[order[end]] == sizes[order[first]]) ++end;
    for (std::size_t i = first; i < end; ++i) ranks[order[i]] = static_cast<int>(first + 1 + end);
  }
  return ranks;
}

/// The probability of both tails of a sum of ranks with random signs, by counting its 2^n values.
double exact_p(const std::vector<int>& ranks, int sum) {
  const int total = std::accumulate(ranks.begin(), ranks.end(), 0);
  std::vector<double> share(static_cast<std::size_t>(total) + 1, 0);
  share[0] = 1;
  int reach = 0;
  for (const int rank : ranks) {
    reach += rank;
    for (int s = reach; s >= 0; --s) {
      const auto at = static_cast<std::size_t>(s);
      share[at] = 0.5 * (share[at] + (s >= rank ? share[at - static_cast<std::size_t>(rank)] : 0));
    }
  }
  const auto lesser = static_cast<std::ptrdiff_t>(std::min(sum, total - sum));
  return std::min(1.0, 2 * std::accumulate(share.begin(), share.begin() + lesser + 1, 0.0));
}

double normal_p(const std::vector<int>& ranks, double sum) {
  double total = 0, squares = 0;  // a random sign at rank r has variance r^2/4
  for (const double rank : ranks) {
    total += rank;
    squares += rank * rank;
  }
  const double away = std::max(0.0, std::abs(sum - total / 2) - 1);  // half a rank, doubled
  return std::erfc(away / std::sqrt(squares / 4) / std::sqrt(2.0));
}

}  // namespace

ConfidenceInterval median_interval(std::vector<double> values, double confidence) {
  const auto n = static_cast<int>(values.size());
  if (n < kLeastSample) return {NAN, NAN};
  std::sort(values.begin(), values.end());
  const int low = bootstrap_place(n, (n + 1) / 2, (1 - confidence) / 2);
  const int high = bootstrap_place(n, n / 2 + 1, (1 + confidence) / 2);
  return {values[static_cast<std::size_t>(low - 1)], values[static_cast<std::size_t>(high - 1)]};
}

double wilcoxon_signed_rank(std::span<const double> differences) {
  std::vector<double> sizes;
  std::vector<bool> positive;
  for (const double difference : differences) {
    if (difference == 0 || std::isnan(difference)) continue;
    sizes.push_back(std::abs(difference));
    positive.push_back(difference > 0);
  }
  const std::vector<int> ranks = doubled_ranks(sizes);
  double sum = 0;  // with many ranks it exceeds an int
  for (std::size_t i = 0; i < ranks.size(); ++i) sum += positive[i] ? ranks[i] : 0;
  if (ranks.empty()) return 1;
  return ranks.size() <= kExactUpTo ? exact_p(ranks, static_cast<int>(sum)) : normal_p(ranks, sum);
}

std::vector<double> holm(std::span<const double> p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
  std::vector<double> corrected(p.size());
  double largest = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double times = static_cast<double>(p.size() - i) * p[order[i]];
    largest = std::max(largest, std::min(1.0, times));
    corrected[order[i]] = largest;
  }
  return corrected;
}

}  // namespace maxwrench
