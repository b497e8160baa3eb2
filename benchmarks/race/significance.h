#pragma once

#include <span>
#include <vector>

// Whether a difference is more than noise: pure functions of samples, without random numbers.

namespace maxwrench {

struct ConfidenceInterval {
  double low = 0, high = 0;
};

/// The percentile bootstrap interval of the median of n values, of which some may be infinite. The
/// k-th smallest of n values that are drawn with replacement is at most the i-th smallest of the
/// sample, x_(i), with probability
///
///     P(X*_(k) <= x_(i)) = P(Binomial(n, i/n) >= k)
///
/// (Efron: Bootstrap methods: another look at the jackknife, 1979), so nothing is drawn: `low` is
/// the (1 - confidence)/2 quantile for the lower, `high` the (1 + confidence)/2 quantile for the
/// upper of the two middle places, which are one if n is odd (then it is the interval of endless
/// resampling; else it holds it). NaN of less than `kLeastSample` values: too few to say anything
/// at 95 %.
ConfidenceInterval median_interval(std::vector<double> values, double confidence = 0.95);
inline constexpr int kLeastSample = 6;

/// The two-sided p of Wilcoxon's signed rank test that paired differences are symmetric about zero.
/// Zeros are left out, ties get the mean of their ranks; infinite ones are the largest, and NaN
/// counts as none. Exact up to 100 differences, given their ties; beyond that normal, corrected for
/// ties and continuity. 1 if no difference is left.
double wilcoxon_signed_rank(std::span<const double> differences);

/// Holm's correction of p values for as many tests, in their order.
std::vector<double> holm(std::span<const double> p);

}  // namespace maxwrench
