#pragma once

#include <map>
#include <optional>
#include <vector>

#include "verify/lp_proof.h"

namespace maxwrench {

/// Entries by column.
using SparseRow = std::map<int, mpq_class>;

/// Solves M x = rhs for a square M given by its rows; returns nothing if M is singular. Eliminates
/// with pivots in the rows that have the fewest entries.
std::optional<RationalVector> solve_rational(std::vector<SparseRow> rows, RationalVector rhs);

}  // namespace maxwrench
