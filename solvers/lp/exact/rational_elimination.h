#pragma once

#include <map>
#include <optional>
#include <vector>

#include "verify/lp_proof.h"

namespace maxwrench {

/// Entries by column.
using SparseRow = std::map<int, mpq_class>;

/// x of M x = rhs, M square and given by rows; none if M is singular. Elimination with pivots where
/// a row has the fewest entries.
std::optional<RationalVector> solve_rational(std::vector<SparseRow> rows, RationalVector rhs);

}  // namespace maxwrench
