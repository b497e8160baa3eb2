#include "benchmarks/suite/suite_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <stdexcept>

#include "benchmarks/suite/product.h"
#include "benchmarks/tables/write_file.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "problems/loader/block.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

using Names = ProductColumns::Names;

constexpr const char* kStatic = "static";
constexpr const char* kInTime = "in_time";
constexpr int kMostSeeds = 1'000'000;

Names texts_of(const Block& block, const char* key) {
  const Names names = block.is_text(key) ? Names{block.text(key)} : block.texts(key);
  if (names.empty()) block.throw_bad_value(key, "a name, a list of names, or \"all\"");
  return names;
}

/// Reads the names of a key, all of which must be known; keeps `names` if the key is missing.
void read_names(const Block& block, const char* key, const Names& known, Names& names) {
  if (!block.has(key)) return;
  names = texts_of(block, key);
  if (names == Names{kAll}) return;
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    block.throw_bad_value(key, "'" + name + "'",
                          fmt::format("\"all\" or some of {}", fmt::join(known, " ")));
  }
}

template <class Table>
void add_names(const Table& table, Names& names) {
  for (const auto& entry : table) {
    if (std::find(names.begin(), names.end(), entry.name) == names.end()) {
      names.emplace_back(entry.name);
    }
  }
}

/// Single methods, and stages joined by +.
void read_searches(const Block& block, Names& names) {
  if (!block.has("search")) return;
  names = texts_of(block, "search");
  if (names == Names{kAll}) return;
  for (const std::string& name : names) {
    try {
      find_search(name);
    } catch (const std::invalid_argument& error) {
      const std::string why = error.what();
      const std::size_t expected = why.find("expected ");
      block.throw_bad_value("search", "'" + name + "'",
                            expected == std::string::npos ? why : why.substr(expected + 9));
    }
  }
}

/// Experiments do not search.
void read_integrators(const Block& block, Names& names) {
  if (!block.has("integrator")) return;
  read_names(block, "integrator", stiff_integrators(), names);
  for (const char* key : {"search", "seeds", "budget"}) {
    if (block.has(key)) block.throw_bad_value(key, "no such key beside integrator");
  }
}

ProductColumns read_columns(const Block& block) {
  Names known_measures, known_solvers = {kNoSolver}, known_schemes = scheme_names(false);
  add_names(measures(), known_measures);
  add_names(wrench_solvers(), known_solvers);
  add_names(trajectory_solvers(), known_solvers);
  for (const std::string& name : scheme_names(true)) {
    if (std::count(known_schemes.begin(), known_schemes.end(), name) == 0) {
      known_schemes.push_back(name);
    }
  }
  ProductColumns columns;
  read_names(block, "measure", known_measures, columns.measure);
  read_names(block, "wrench", {"pure", "any"}, columns.wrench);
  read_names(block, "solver", known_solvers, columns.solver);
  read_names(block, "scheme", known_schemes, columns.scheme);
  read_searches(block, columns.search);
  read_integrators(block, columns.integrator);
  columns.seed.resize(static_cast<std::size_t>(block.whole("seeds", 1, kMostSeeds, 1)));
  std::iota(columns.seed.begin(), columns.seed.end(), 1);
  if (block.has("budget")) columns.budget = block.whole("budget", 1, kMostBudget);
  return columns;
}

/// The names of all shipped problems, or only of the tasks in time or of the static ones.
Names shipped_group(const std::string& group) {
  Names names;
  for (const std::string& name : shipped_problems()) {
    const bool in_time = load_problem(name).motion.has_value();
    if (group == kAll || in_time == (group == kInTime)) names.push_back(name);
  }
  return names;
}

Names read_problems(const Block& block) {
  const Names shipped = shipped_problems();
  Names names;
  for (const std::string& word : texts_of(block, "problem")) {
    if (word == kAll || word == kStatic || word == kInTime) {
      const Names group = shipped_group(word);
      names.insert(names.end(), group.begin(), group.end());
    } else if (std::find(shipped.begin(), shipped.end(), word) != shipped.end()) {
      names.push_back(word);
    } else {
      const auto path = (block.file().parent_path() / word).lexically_normal();
      if (!std::filesystem::is_regular_file(path)) {
        block.throw_bad_value("problem", "'" + word + "'",
                              fmt::format("all, static, in_time, a task file or some of {}",
                                          fmt::join(shipped, " ")));
      }
      names.push_back(path.string());
    }
  }
  return names;
}

}  // namespace

Workload read_suite_file(const std::filesystem::path& file) {
  const Block root = Block::read(file);
  root.allow_only({"product"});
  Workload work;
  if (root.list("product").empty()) root.throw_bad_value("product", "one [[product]] or more");
  for (const Block& block : root.list("product")) {
    block.allow_only({"problem", "measure", "wrench", "solver", "search", "scheme", "seeds",
                      "budget", "integrator"});
    const ProductColumns columns = read_columns(block);
    const std::size_t before = work.cases.size();
    for (const std::string& name : read_problems(block)) {
      if (!work.problems.contains(name)) work.problems.emplace(name, load_problem(name));
      const std::vector<Case> cases = product(work.problems.at(name), columns);
      work.cases.insert(work.cases.end(), cases.begin(), cases.end());
    }
    const bool none_built_in = columns.integrator == Names{kAll} && stiff_integrators().empty();
    if (work.cases.size() == before && !none_built_in) {
      block.throw_bad_value("problem", "a combination of columns that is not valid",
                            "at least one row of the product");
    }
  }
  sort_cases(work.cases);
  work.suite = text_of(file);
  return work;
}

}  // namespace maxwrench
