#pragma once

#include <initializer_list>
#include <string>

#include "benchmarks/tables/csv.h"
#include "maxwrench/solve.h"

// What a row of values.csv claims, cell by cell. A function named reject_... returns why a claim is
// wrong, or nothing.

namespace maxwrench {

/// A row of a file.
struct RowClaim {
  const CsvFile& csv;
  std::size_t row;

  const std::string& text(const char* column) const { return csv.text(row, column); }
  /// Numbers that are separated by blanks. Throws std::invalid_argument, which names the cell.
  Eigen::VectorXd vector(const char* column) const;
};

/// A number beside the value, such as its beta_linf, is `anew`; NaN: there is none.
std::string reject_other(const RowClaim& claim, const char* column, double anew);

/// Numbers are those of the same posture evaluated anew.
std::string reject_numbers(const RowClaim& claim, const char* column, const Eigen::VectorXd& anew);

/// The residual is that of the answer, up to rounding.
std::string reject_residual(const RowClaim& claim, const Residual& anew, double beta);

/// These cells are empty.
std::string reject_filled(const RowClaim& claim, std::initializer_list<const char*> columns);

/// The evaluations of a search are within its budget, and those of its methods are among them. That
/// the search took so many is not checked.
std::string reject_effort(const Case& c, const RowClaim& claim);

/// The names are complete, exist and are a valid choice together.
std::string reject_names(const Problem& problem, const Case& c);

/// Digest, label and units belong to the task, and a row of this status can have a value, or none.
std::string reject_words(const Problem& problem, const Case& c, const RowClaim& claim,
                         bool has_value);

}  // namespace maxwrench
