#include "benchmarks/race/race_file.h"
#include "benchmarks/report/benchmark_sets.h"
#include "cli/report/sections.h"
#include "cli/suite/race_figures.h"

namespace maxwrench {
namespace {

constexpr std::size_t kNamedSearches = 8;

/// Adds a column for each target: `tenth` and so on after a prefix.
void add_target_columns(const std::string& prefix, std::vector<std::string>& columns) {
  for (const char* target : kTargetNames) columns.push_back(prefix + target);
}

/// Keeps steps that a reader can distinguish: those 1 % apart on a logarithmic axis, and the last.
void thin(std::vector<EcdfPanel>& panels) {
  for (EcdfPanel& panel : panels) {
    for (EcdfCurve& curve : panel.curves) {
      std::vector<Eigen::Vector2d> kept;
      for (const Eigen::Vector2d& step : curve.steps) {
        if (!kept.empty() && step.x() < 1.01 * kept.back().x()) {
          kept.back().y() = step.y();
        } else {
          kept.push_back(step);
        }
      }
      curve.steps = std::move(kept);
    }
  }
}

ReportSection standing_section(const std::vector<RaceGroup>& groups) {
  ReportSection section;
  ReportTable& table = section.table;
  table.name = "race_standings";
  table.title = "The race: searches in groups of tasks";
  table.note =
      "Empirical distributions of the share of targets (10 %, 1 %, 0.1 % and 0.01 % below the best "
      "known value) that a search reached, and how it compares with the fastest search of each "
      "task. A task that a search does not support counts as missed.";
  table.columns = {"group", "search", "supported", "typical", "worst"};
  add_target_columns("reached_", table.columns);
  for (const RaceGroup& group : groups) {
    const std::vector<Standing> all = standings(group.races);
    std::vector<EcdfPanel> panels = ecdf_panels(group.races, group.title);
    thin(panels);
    section.figures.push_back(draw_ecdf(panels, leaders(all, kNamedSearches), 1));
    for (const Standing& each : all) {
      auto& line = table.rows.emplace_back(std::vector<ReportCell>{
          group.title, each.search, static_cast<double>(each.supported), each.typical, each.worst});
      line.insert(line.end(), each.reached.begin(), each.reached.end());
    }
  }
  return section;
}

ReportSection race_benchmark_set_section(const std::vector<RaceGroup>& groups) {
  std::vector<BenchmarkSet> benchmark_sets;
  for (const RaceGroup& group : groups) benchmark_sets.push_back(search_benchmark_set(group));
  ReportTable table{
      "race_significance",
      "The race: profiles and significance",
      "Performance profiles of the processor time to 0.1 % below the best known value; instances "
      "are tasks and seeds, and an attempt that never reaches this target fails. Times are "
      "multiples of those of the default search: a median with its 95 % bootstrap interval, and "
      "Wilcoxon's signed rank test with Holm's correction.",
      {},
      {}};
  return benchmark_set_section(std::move(table), benchmark_sets, "search", "median_ms");
}

ReportSection expected_section(const std::vector<Comparison>& races) {
  ReportTable table{
      "race_expected",
      "The race: expected running times",
      "COCO's expected running time of a search that is restarted until it reaches the target: "
      "everything spent, divided by the number of runs that reached it.",
      {"problem", "measure", "wrench", "scheme", "search", "solver", "runs", "solved"},
      {}};
  add_target_columns("ert_ms_", table.columns);
  add_target_columns("ert_evaluations_", table.columns);
  for (const Comparison& race : races) {
    for (const auto* group : {&race.contenders, &race.peers}) {
      for (const Contender& contender : *group) {
        const std::vector<RaceRun> runs = contender.runs();
        const Case& c = contender.attempts.front().choice;
        auto& line = table.rows.emplace_back(std::vector<ReportCell>{
            c.problem, c.measure, to_string(c.wrench), c.scheme, c.search, c.solver,
            static_cast<double>(runs.size()), static_cast<double>(reached(runs, race.target()))});
        for (const double share : kTargetShares) {
          line.emplace_back(1e3 * contender.expected(race.target(share), &Spent::seconds));
        }
        for (const double share : kTargetShares) {
          line.emplace_back(contender.expected(race.target(share), &Spent::evaluations));
        }
      }
    }
  }
  return {table, {}, false};
}

}  // namespace

std::vector<ReportSection> race_sections(const std::vector<Comparison>& races) {
  if (races.empty()) return {};
  const std::vector<RaceGroup> groups = race_groups(races);
  return {standing_section(groups), race_benchmark_set_section(groups), expected_section(races)};
}

}  // namespace maxwrench
