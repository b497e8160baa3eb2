#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <stdexcept>

#include "benchmarks/suite/map_store.h"
#include "benchmarks/tables/csv.h"
#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/suite/row_writer.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

struct MergeOptions {
  std::string out;
  std::vector<std::string> folders;
};

/// Throws unless `run` has written to the folder and has ended.
void require_ended(const fs::path& folder) {
  const fs::path file = table_file(folder / "values.csv"), journal = folder / "values.csv.part";
  if (!fs::exists(file) && !fs::exists(journal)) {
    throw std::invalid_argument(
        fmt::format("{}: got no table, expected one that `run` wrote", file.string()));
  }
  for (const fs::path& each : {journal, folder / "times.csv.part"}) {
    if (!Journal::is_held(each)) continue;
    throw std::invalid_argument(fmt::format(
        "{}: got a file that is being written, expected a run that has ended", each.string()));
  }
}

/// Adds every row of `more`; a row that already exists must be the same.
void add_values(const Table& more, const fs::path& from, Table& all, const fs::path& out) {
  more.each([&](const std::vector<std::string>& row) {
    const auto there = all.find(row);
    if (there && *there != row) {
      const auto end = row.begin() + static_cast<std::ptrdiff_t>(case_columns().size());
      throw std::invalid_argument(
          fmt::format("{}: got a row of {} that differs from that in {}, expected the same",
                      table_file(from / "values.csv").string(),
                      fmt::join(std::vector<std::string>(row.begin(), end), ","), out.string()));
    }
    all.add(row);
  });
}

/// Adds the times of all folders; for a row measured in several folders, the first time.
void add_times(const std::vector<std::string>& folders, Table& all) {
  for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder) {
    times_table(*folder).each([&](const std::vector<std::string>& row) { all.add(row); });
  }
}

/// Copies the file from the first folder that has it.
void take_over(const char* name, const MergeOptions& options) {
  for (const std::string& folder : options.folders) {
    const std::string text = text_of(fs::path(folder) / name);
    if (!text.empty()) return write_file(fs::path(options.out) / name, text);
  }
}

int merge(const MergeOptions& options) {
  if (holds_map(options.folders.front())) {
    const std::size_t cells = merge_maps(options.out, options.folders);
    fmt::print("{} cells in {}\n", cells, table_file(fs::path(options.out) / "map.csv").string());
    return kAnswered;
  }
  for (const std::string& folder : options.folders) require_ended(folder);
  std::size_t rows = 0;
  {  // one table after the other, because a million rows fill a gigabyte
    Table values = values_table(options.out);
    values.hold();
    for (const std::string& folder : options.folders) {
      add_values(
          values_table(folder), folder, values,
          folder == options.folders.front() ? options.out : options.out + " or an earlier one");
    }
    values.write();
    rows = values.size();
  }
  Table times = times_table(options.out);
  times.hold();
  add_times(options.folders, times);
  times.write();
  take_over("suite.toml", options);
  take_over("machine.txt", options);
  fmt::print("{} rows in {}\n", rows, table_file(fs::path(options.out) / "values.csv").string());
  return kAnswered;
}

}  // namespace

void add_merge(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<MergeOptions>();
  CLI::App& command = *app.add_subcommand(
      "merge", "merges the rows or maps of several folders, such as those of shards");
  command.add_option("out", options->out, "folder for all rows; its existing rows are kept")
      ->required()
      ->check(reject_empty);
  command.add_option("folders", options->folders, "folders that `run` or `map` wrote")->required();
  command.callback([options, &exit_status] { exit_status = merge(*options); });
}

}  // namespace maxwrench
