#pragma once

#include <span>
#include <vector>

// Whether a difference exceeds noise: pure functions of samples, without random numbers.

namespace maxwrench {

struct ConfidenceInterval {
  double low = 0, high = 0;
};

/// The percentile bootstrap interval of the median of n values, some of which may be infinite. The
/// k-th smallest of n values drawn with replacement is at most the i-th smallest of the sample,
/// x_(i), with probability
///
///     P(X*_(k) <= x_(i)) = P(Binomial(n, i/n) >= k)
///
/// (Efron: Bootstrap methods: another look at the jackknife, 1979), so nothing need be drawn. `low`
/// is the (1 - confidence)/2 quantile of the lower of the two middle values, `high` the (1 +
/// confidence)/2 quantile of the upper one. If n is odd, the two are the same, and the interval is
/// that of endless resampling; otherwise it contains that interval. NaN for fewer than
/// `kLeastSample` values, which are too few for a statement at 95 %.
ConfidenceInterval median_interval(std::vector<double> values, double confidence = 0.95);
inline constexpr int kLeastSample = 6;

/// The two-sided p of Wilcoxon's signed rank test that paired differences are symmetric about zero.
/// Zeros and NaN are left out, ties get the mean of their ranks, and infinite differences are the
/// largest. Exact up to 100 differences, ties included; beyond that by the normal distribution,
/// corrected for ties and continuity. 1 if no difference is left.
double wilcoxon_signed_rank(std::span<const double> differences);

/// Holm's correction of p values for this number of tests, in their order.
std::vector<double> holm(std::span<const double> p);

}  // namespace maxwrench
