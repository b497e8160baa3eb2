#pragma once

#include <string>

#include "benchmarks/tables/csv.h"

namespace maxwrench {

struct Problem;

inline constexpr const char* kOwnWord =
    "that this search found the value from this seed; evaluations and calls, except that they fit "
    "the budget; status and reason of a row without a value; evaluations of an experiment";

/// What was checked of a row of values.csv.
struct RowCheck {
  std::string rejection;   ///< empty: what it claims follows from the problem's data
  bool has_value = false;  ///< it claims one; else it has to have a reason why not
  double deviation = 0;    ///< of the value, as a share of 1 + |value|
};

/// Whether a row of values.csv, with all `value_columns`, follows from the files of its task, whose
/// digest it carries. Its posture or trajectory is evaluated anew and verified from the problem's
/// data, as that of any row: value, beta_linf and `value_between_knots` within kAnswerTolerance (1
/// + |value|), limits and collisions kept; h, u, lambda and the residuals of the same posture. Of
/// the L-infinity polytope with one contact other efforts and multipliers do as well, if they prove
/// themselves: balance, limits, and a gap. An experiment is carried out again: its reading, to
/// 1e-4, what was planned, and whether it was held. Status, unit and label are those that belong to
/// such a row, its names complete, evaluations and calls within the budget. Of a row without a
/// value experiments and evaluations are made again, and what a search found and could not confirm.
/// What cannot be read is a rejection.
///
/// Searches are not made again: `kOwnWord` says what is taken as it stands.
RowCheck check_row(const Problem& problem, const CsvFile& csv, std::size_t row);

}  // namespace maxwrench
