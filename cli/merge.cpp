#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <stdexcept>

#include "benchmarks/write_file.h"
#include "cli/cli.h"
#include "cli/row_writer.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

struct MergeOptions {
  std::string out;
  std::vector<std::string> folders;
};

/// Every row of `more`; one that is there already must be the same.
void add_values(const Table& more, const fs::path& from, Table& all, const fs::path& out) {
  if (more.size() == 0 && !fs::exists(from / "machine.txt")) {  // a part may be empty
    throw std::invalid_argument(
        fmt::format("{}: got no rows, expected a folder that `run` wrote", from.string()));
  }
  more.each([&](const std::vector<std::string>& row) {
    const auto there = all.find(row);
    if (there && *there != row) {
      const auto end = row.begin() + static_cast<std::ptrdiff_t>(case_columns().size());
      throw std::invalid_argument(
          fmt::format("{}: got another row of {} than {} has, expected the same",
                      (from / "values.csv").string(),
                      fmt::join(std::vector<std::string>(row.begin(), end), ","), out.string()));
    }
    all.add(row);
  });
}

/// Of a row that was measured more than once the first time stays.
void add_times(const Table& more, Table& all) {
  more.each([&](const std::vector<std::string>& row) {
    if (!all.find(row)) all.add(row);
  });
}

int merge(const MergeOptions& options) {
  std::size_t rows = 0;
  {  // one table after the other: a million rows fill a gigabyte
    Table values = values_table(options.out);
    for (const std::string& folder : options.folders) {
      add_values(
          values_table(folder), folder, values,
          folder == options.folders.front() ? options.out : options.out + " or an earlier one");
    }
    values.write();
    rows = values.size();
  }
  Table times = times_table(options.out);
  for (const std::string& folder : options.folders) add_times(times_table(folder), times);
  times.write();
  const std::string plan = text_of(fs::path(options.folders.front()) / "plan.toml");
  if (!plan.empty()) write_file(fs::path(options.out) / "plan.toml", plan);
  fmt::print("{} rows in {}\n", rows, (fs::path(options.out) / "values.csv").string());
  return kAnswered;
}

}  // namespace

void add_merge(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<MergeOptions>();
  CLI::App& command =
      *app.add_subcommand("merge", "one folder of rows from several, such as those of shards");
  command.add_option("out", options->out, "folder that they go to; what it holds stays")
      ->required()
      ->check(refuse_empty);
  command.add_option("folders", options->folders, "folders that `run` wrote")->required();
  command.callback([options, &exit_status] { exit_status = merge(*options); });
}

}  // namespace maxwrench
