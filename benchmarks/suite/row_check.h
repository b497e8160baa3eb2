#pragma once

#include <string>

#include "benchmarks/tables/csv.h"

namespace maxwrench {

struct Problem;

inline constexpr const char* kOwnWord =
    "that this search found the value from this seed; evaluations and calls, except that they fit "
    "the budget; status and reason of a row without a value; evaluations of an experiment";

/// The result of the check of a row of values.csv.
struct RowCheck {
  std::string rejection;   ///< empty: its claims follow from the problem's data
  bool has_value = false;  ///< it claims a value; otherwise it must have a reason
  double deviation = 0;    ///< of the value, as a share of 1 + |value|
};

/// Whether a row of values.csv, with all `value_columns`, follows from the files of its task, whose
/// digest it carries.
///
/// Its posture or trajectory is evaluated again and verified from the problem's data, like that of
/// any row: value, beta_linf and `value_between_knots` within kAnswerTolerance (1 + |value|),
/// limits and collisions; h, u, lambda and the residuals of the same posture. For the L-infinity
/// polytope with one contact, other efforts and multipliers are accepted if their balance, limits
/// and gap prove them. An experiment is repeated: its reading, to 1e-4, the planned value, and
/// whether it was held. Status, unit and label must belong to such a row, its names must be
/// complete, and evaluations and calls within the budget. For a row without a value, experiments
/// and evaluations are repeated, and so is the evaluation of what a search found and could not
/// confirm. A row that cannot be read is rejected.
///
/// Searches are not repeated: `kOwnWord` says what is taken on trust.
RowCheck check_row(const Problem& problem, const CsvFile& csv, std::size_t row);

}  // namespace maxwrench
