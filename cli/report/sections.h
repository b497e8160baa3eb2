#pragma once

#include <string>
#include <vector>

#include "cli/report/report_table.h"

namespace maxwrench {

struct Case;
struct Comparison;
struct BenchmarkSet;
struct Results;

/// One table of a report with the figures above it, as SVG.
struct ReportSection {
  ReportTable table;
  std::vector<std::string> figures;
  bool printed = true;  ///< also on the terminal
};

/// Sections on the rows of a run: tasks, solvers, searches, costs, experiments in the virtual tank
/// if there are any, failures, the rows themselves.
std::vector<ReportSection> run_sections(const Results& results);
/// Sections on its races: groups of tasks, significance, expected running times; empty without
/// races.
std::vector<ReportSection> race_sections(const std::vector<Comparison>& races);
/// The differences between two folders.
std::vector<ReportSection> change_sections(const Results& a, const Results& b);
/// All columns with their units and meanings.
ReportSection dictionary_section();

/// The columns of a case.
std::vector<ReportCell> case_cells(const Case& c);
/// Adds a line for each method of each benchmark set to a table that already has its name, title
/// and note. `method` and `cost` name the columns of the method and its cost. The figures are
/// performance profiles, one for each benchmark set: `performance_ratios` as shares of instances.
ReportSection benchmark_set_section(ReportTable table,
                                    const std::vector<BenchmarkSet>& benchmark_sets,
                                    const std::string& method, const std::string& cost);

}  // namespace maxwrench
