#pragma once

#include <string>
#include <vector>

#include "benchmarks/suite/results.h"

namespace maxwrench {

/// Two values of one case count as the same up to this, relative to 1 + |beta|: another order of
/// summation may change them this much.
inline constexpr double kSameValue = 1e-9;

/// A factor that all times of a run share, such as the load of the machine, does not appear as
/// noise between rows. Two runs of one build on a busy machine differed by up to 3 %.
inline constexpr double kDrift = 0.05;

/// The rows of one case in two folders.
struct RowPair {
  const ResultRow* a = nullptr;
  const ResultRow* b = nullptr;
};

/// The ratio of the second folder's times to the first folder's, over pairs of rows that agree in a
/// column.
struct TimeRatio {
  std::string column, name;
  long rows = 0;
  double times = 1;  ///< the median of the ratios of the rows
  /// Its 95 % bootstrap interval; NaN for few rows.
  double times_low = 0, times_high = 0;
  double p = 1;  ///< Wilcoxon of the logarithms, corrected by Holm for all lines

  /// Whether it exceeds noise: the whole interval is further than `kDrift` from 1, and p < 0.05.
  bool is_significant() const;
};

/// The differences between two folders.
struct Differences {
  /// Pairs that differ in status, in having a value, or by more than `kSameValue`; for experiments,
  /// by more than `kSameReading` or in being held.
  std::vector<RowPair> changed;
  long same = 0;     ///< equal status and value, bit by bit
  long rounded = 0;  ///< differences too small for `changed`
  std::vector<const ResultRow*> only_a, only_b;
  /// For all rows, then by solver, search, problem and integrator. For searches the time of an
  /// evaluation, for experiments the whole time.
  std::vector<TimeRatio> times;
};

/// The folders must outlive the result.
Differences find_differences(const Results& a, const Results& b);
Differences find_differences(const Results&&, const Results&) = delete;
Differences find_differences(const Results&, const Results&&) = delete;

}  // namespace maxwrench
