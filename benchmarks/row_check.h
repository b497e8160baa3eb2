#pragma once

#include <string>

#include "benchmarks/csv.h"

namespace maxwrench {

struct Problem;

/// What was checked of a row of values.csv.
struct RowCheck {
  std::string refusal;     ///< empty: what it claims follows from the problem's data
  bool has_value = false;  ///< it claims one; else it has to have a reason why not
  double deviation = 0;    ///< of the value, as a share of 1 + |value|
};

/// Whether the table of theta_r of a row of values.csv, with all `value_columns`, has the value
/// that it claims, within its limits and without collisions, up to kAnswerTolerance (1 + |value|):
/// the lower level is solved anew and its answer verified from the problem's data, as that of any
/// row. And of the L-infinity polytope with one contact, whether the row's own efforts, wrench and
/// multipliers do: balance, limits, and a gap that proves them optimal. Unit, yardstick and
/// `continuous` are compared, too, and the status must be one that has a value, or has none. An
/// experiment is carried out again: its reading, to 1e-4, what was planned, and whether it was
/// held. Of a row without a value the names and the status must be known, and experiments and
/// evaluations are made again; searches are not. What cannot be read is a refusal.
RowCheck check_row(const Problem& problem, const CsvFile& csv, std::size_t row);

}  // namespace maxwrench
