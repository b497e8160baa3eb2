#pragma once

#include <string>
#include <vector>

#include "benchmarks/suite/results.h"

namespace maxwrench {

/// Values of one case count as the same up to this, relative to 1 + |beta|: what another order of
/// sums may change.
inline constexpr double kSameValue = 1e-9;

/// What all times of a run share, such as the load of the machine, is no noise between rows; two
/// runs of one build on a busy machine differed by up to 3 %.
inline constexpr double kDrift = 0.05;

/// The rows of one case in two folders.
struct RowPair {
  const ResultRow* a = nullptr;
  const ResultRow* b = nullptr;
};

/// How many times as long the second folder took, over pairs of rows that agree in a column.
struct TimeRatio {
  std::string column, name;
  long rows = 0;
  double times = 1;  ///< the median of the ratios row by row
  /// Its bootstrap interval of 95 %; NaN of few rows.
  double times_low = 0, times_high = 0;
  double p = 1;  ///< Wilcoxon of the logarithms, corrected by Holm for all lines

  /// Beyond noise: the whole interval lies further than `kDrift` from 1, and p < 0.05.
  bool is_significant() const;
};

/// What differs between two folders.
struct Differences {
  /// In status, in having a value, or by more than `kSameValue`; of experiments by `kSameReading`,
  /// or in being held.
  std::vector<RowPair> changed;
  long same = 0;     ///< status and value, bit by bit
  long rounded = 0;  ///< less than `changed`
  std::vector<const ResultRow*> only_a, only_b;
  /// All rows, then by solver, search, problem and integrator; of searches the time of an
  /// evaluation, of experiments all of it.
  std::vector<TimeRatio> times;
};

/// The folders outlive the answer.
Differences find_differences(const Results& a, const Results& b);
Differences find_differences(const Results&&, const Results&) = delete;
Differences find_differences(const Results&, const Results&&) = delete;

}  // namespace maxwrench
