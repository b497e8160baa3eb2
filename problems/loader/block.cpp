#include "problems/loader/block.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

#include "problems/loader/bad_input.h"

namespace maxwrench {
namespace {

/// The value almost as the user wrote it. (toml++ prints 0.3 with 17 digits.)
std::string as_written(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_string()) return fmt::format("'{}'", node.as_string()->get());
  if (node.is_floating_point()) return fmt::format("{}", node.as_floating_point()->get());
  if (const toml::array* array = node.as_array()) {
    std::vector<std::string> parts;
    for (const toml::node& part : *array) parts.push_back(as_written(part));
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }
  std::ostringstream out;
  node.visit([&out](const auto& value) { out << value; });
  return out.str();
}

std::optional<double> finite_number(const toml::node& node) {
  if (!node.is_number()) return std::nullopt;
  const toml::value<int64_t>* const whole = node.as_integer();  // value<double> may reject it
  const double value = whole ? static_cast<double>(whole->get()) : *node.value<double>();
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<Eigen::VectorXd> all_numbers(const toml::array& array) {
  Eigen::VectorXd numbers(static_cast<Eigen::Index>(array.size()));
  for (Eigen::Index i = 0; i < numbers.size(); ++i) {
    const auto value = finite_number(*array.get(static_cast<std::size_t>(i)));
    if (!value) return std::nullopt;
    numbers[i] = *value;
  }
  return numbers;
}

std::optional<std::vector<std::string>> all_texts(const toml::array& array) {
  std::vector<std::string> texts;
  for (const toml::node& node : array) {
    if (!node.is_string()) return std::nullopt;
    texts.push_back(node.as_string()->get());
  }
  return texts;
}

/// toml++ recurses for every part of a dotted key, so a long key would overflow the stack.
void require_short_keys(const std::filesystem::path& file, const std::string& text) {
  constexpr int kMostDots = 1000;
  int dots = 0;
  for (const char c : text) {
    const bool in_key = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                        std::string_view("_-\"' \t").find(c) != std::string_view::npos;
    if (c == '.') ++dots;
    if (c != '.' && !in_key) dots = 0;
    if (dots > kMostDots) {
      throw_bad_input(file, "file", fmt::format("a key of more than {} parts", kMostDots),
                      "shorter keys");
    }
  }
}

struct Source {
  toml::source_position at;
  std::string block, text;
};

void collect_sources(const toml::table& table, const Block& root, const std::string& path,
                     std::vector<Source>& found) {
  for (const char* key : {"source", "status"}) {
    const toml::node* node = table.get(key);
    if (node != nullptr && !node->is_string()) {
      throw_bad_input(root.file(), path.empty() ? key : path + "." + key, as_written(*node),
                      "a string");
    }
  }
  const toml::node* source = table.get("source");
  const toml::node* status = table.get("status");
  if (source != nullptr || status != nullptr) {
    std::string text = source == nullptr ? "not given" : source->as_string()->get();
    if (status != nullptr) text += fmt::format(" [{}]", status->as_string()->get());
    found.push_back({(source == nullptr ? status : source)->source().begin, path, text});
  }
  const std::string prefix = path.empty() ? "" : path + ".";
  for (const auto& [key, node] : table) {
    const std::string name = prefix + std::string(key.str());
    if (const toml::table* inner = node.as_table()) collect_sources(*inner, root, name, found);
    if (const toml::array* array = node.as_array()) {
      for (std::size_t i = 0; i < array->size(); ++i) {
        const toml::table* entry = array->get(i)->as_table();
        if (entry) collect_sources(*entry, root, fmt::format("{}[{}]", name, i), found);
      }
    }
  }
}

}  // namespace

Block::Block(std::filesystem::path file, std::string path, std::shared_ptr<const toml::table> root,
             const toml::table* table)
    : file_(std::move(file)), path_(std::move(path)), root_(std::move(root)), table_(table) {}

Block Block::read(const std::filesystem::path& file) {
  std::ifstream stream = open_file(file, "a TOML file");
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  require_short_keys(file, text);
  try {
    auto root = std::make_shared<const toml::table>(toml::parse(text, file.string()));
    const toml::table* table = root.get();
    return Block(file, "", std::move(root), table);
  } catch (const toml::parse_error& error) {
    const auto row = error.source().begin.line;
    std::istringstream lines(text);
    std::string line;
    for (toml::source_index i = 0; i < row; ++i) std::getline(lines, line);
    throw_bad_input(file, fmt::format("line {}", row), fmt::format("'{}'", line),
                    fmt::format("valid TOML ({})", error.description()));
  }
}

Block Block::of(toml::table table) {
  auto root = std::make_shared<const toml::table>(std::move(table));
  const toml::table* all = root.get();
  return Block({}, "", std::move(root), all);
}

Block Block::inner(std::string path, const toml::table& table) const {
  return Block(file_, std::move(path), root_, &table);
}

std::string Block::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

bool Block::has(std::string_view key) const { return table_ != nullptr && table_->contains(key); }

void Block::allow_only(const std::vector<std::string_view>& keys) const {
  if (table_ == nullptr) return;
  std::vector<std::string_view> known = keys;
  known.insert(known.end(), {"source", "status"});
  for (const auto& [key, node] : *table_) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    throw_bad_input(file_, path_of(key.str()), "an unknown key",
                    fmt::format("one of {}", fmt::join(known, ", ")));
  }
}

void Block::throw_bad_value(std::string_view key, std::string_view expected) const {
  const toml::node* node = table_ == nullptr ? nullptr : table_->get(key);
  throw_bad_value(key, node == nullptr ? "nothing" : as_written(*node), expected);
}

void Block::throw_bad_value(std::string_view key, std::string_view got,
                            std::string_view expected) const {
  throw_bad_input(file_, path_of(key), got, expected);
}

const toml::node& Block::require(std::string_view key, std::string_view expected) const {
  const toml::node* node = table_ == nullptr ? nullptr : table_->get(key);
  if (node == nullptr) throw_bad_value(key, expected);
  return *node;
}

const toml::array& Block::array(std::string_view key, std::string_view expected) const {
  const toml::node& node = require(key, expected);
  if (!node.is_array()) throw_bad_value(key, expected);
  return *node.as_array();
}

std::string Block::text(std::string_view key) const {
  const toml::node& node = require(key, "a string");
  if (!node.is_string()) throw_bad_value(key, "a string");
  if (node.as_string()->get().empty()) throw_bad_value(key, "a string that is not empty");
  return node.as_string()->get();
}

std::string Block::text(std::string_view key, std::string_view fallback) const {
  return has(key) ? text(key) : std::string(fallback);
}

double Block::number(std::string_view key) const {
  const auto value = finite_number(require(key, "a finite number"));
  if (!value) throw_bad_value(key, "a finite number");
  return *value;
}

double Block::number(std::string_view key, double fallback) const {
  return has(key) ? number(key) : fallback;
}

Eigen::VectorXd Block::numbers(std::string_view key, int size) const {
  const std::string expected =
      fmt::format("a list of {} finite number{}", size, size == 1 ? "" : "s");
  if (static_cast<int>(array(key, expected).size()) != size) throw_bad_value(key, expected);
  return listed(key, expected);
}

Eigen::VectorXd Block::any_numbers(std::string_view key) const {
  return has(key) ? listed(key, "a list of finite numbers") : Eigen::VectorXd();
}

Eigen::VectorXd Block::listed(std::string_view key, std::string_view expected) const {
  const auto result = all_numbers(array(key, expected));
  if (!result) throw_bad_value(key, expected);
  return *result;
}

Eigen::Vector3d Block::vector(std::string_view key) const { return numbers(key, 3); }

Eigen::Vector3d Block::vector(std::string_view key, const Eigen::Vector3d& fallback) const {
  return has(key) ? vector(key) : fallback;
}

Eigen::Vector3d Block::direction(std::string_view key) const {
  const Eigen::Vector3d value = vector(key);
  if (value.stableNorm() < 1e-9) throw_bad_value(key, "a direction of nonzero length");
  return value.stableNormalized();
}

int Block::whole(std::string_view key, int low, int high) const {
  const double value = number(key);
  if (value < low || value > high || value != std::floor(value)) {
    throw_bad_value(key, fmt::format("a whole number from {} to {}", low, high));
  }
  return static_cast<int>(value);
}

int Block::whole(std::string_view key, int low, int high, int fallback) const {
  return has(key) ? whole(key, low, high) : fallback;
}

bool Block::truth(std::string_view key, bool fallback) const {
  if (!has(key)) return fallback;
  const toml::node& node = require(key, "true or false");
  if (!node.is_boolean()) throw_bad_value(key, "true or false");
  return node.as_boolean()->get();
}

bool Block::is_text(std::string_view key) const {
  return has(key) && table_->get(key)->is_string();
}

std::vector<std::string> Block::texts(std::string_view key) const {
  auto result = all_texts(array(key, "a list of strings"));
  if (!result) throw_bad_value(key, "a list of strings");
  return *result;
}

std::vector<std::pair<std::string, std::string>> Block::text_pairs(std::string_view key) const {
  const char* expected = "a list of pairs of names, such as [[\"a\", \"b\"]]";
  std::vector<std::pair<std::string, std::string>> result;
  for (const toml::node& node : array(key, expected)) {
    const auto pair = node.is_array() ? all_texts(*node.as_array()) : std::nullopt;
    if (!pair || pair->size() != 2) throw_bad_value(key, as_written(node), expected);
    result.emplace_back((*pair)[0], (*pair)[1]);
  }
  return result;
}

std::vector<Eigen::VectorXd> Block::rows(std::string_view key, int size) const {
  const std::string expected = fmt::format("a list of lists of {} finite numbers", size);
  std::vector<Eigen::VectorXd> result;
  for (const toml::node& node : array(key, expected)) {
    const auto row = node.is_array() ? all_numbers(*node.as_array()) : std::nullopt;
    if (!row || row->size() != size) throw_bad_value(key, as_written(node), expected);
    result.push_back(*row);
  }
  if (result.empty()) throw_bad_value(key, expected);
  return result;
}

std::vector<std::vector<std::string>> Block::text_lists(std::string_view key) const {
  const char* expected = "a list of lists of names, such as [[\"a\"], [\"b\", \"c\"]]";
  std::vector<std::vector<std::string>> result;
  for (const toml::node& node : array(key, expected)) {
    const auto list = node.is_array() ? all_texts(*node.as_array()) : std::nullopt;
    if (!list || list->empty()) throw_bad_value(key, as_written(node), expected);
    result.push_back(*list);
  }
  if (result.empty()) throw_bad_value(key, expected);
  return result;
}

Block Block::table(std::string_view key) const {
  if (!has(key)) return Block(file_, path_of(key), root_, nullptr);
  const toml::table* table = table_->get(key)->as_table();
  if (table == nullptr) throw_bad_value(key, fmt::format("a table [{}], not a list", path_of(key)));
  return inner(path_of(key), *table);
}

std::vector<Block> Block::list(std::string_view key) const {
  std::vector<Block> result;
  if (!has(key)) return result;
  for (const toml::node& node : array(key, "a list of tables")) {
    if (!node.is_table()) throw_bad_value(key, "a list of tables");
    result.push_back(inner(fmt::format("{}[{}]", path_of(key), result.size()), *node.as_table()));
  }
  return result;
}

std::vector<std::pair<std::string, Block>> Block::named(std::string_view key) const {
  std::vector<std::pair<std::string, Block>> result;
  const Block outer = table(key);
  if (outer.table_ == nullptr) return result;
  for (const auto& [name, node] : *outer.table_) {
    if (name.str() == "source" || name.str() == "status") continue;
    if (!node.is_table()) outer.throw_bad_value(name.str(), "a table");
    result.emplace_back(name.str(), outer.inner(outer.path_of(name.str()), *node.as_table()));
  }
  const auto line = [](const auto& entry) { return entry.second.table_->source().begin.line; };
  std::stable_sort(result.begin(), result.end(),
                   [line](const auto& a, const auto& b) { return line(a) < line(b); });
  return result;
}

std::vector<std::string> Block::keys() const {
  std::vector<std::string> result;
  if (table_ == nullptr) return result;
  for (const auto& [key, node] : *table_) {
    if (key.str() != "source" && key.str() != "status") result.emplace_back(key.str());
  }
  return result;
}

std::map<std::string, double> Block::numbers_by_name() const {
  std::map<std::string, double> result;
  for (const std::string& key : keys()) result.emplace(key, number(key));
  return result;
}

std::vector<std::pair<std::string, std::string>> Block::sources(std::string_view root_name) const {
  std::vector<Source> found;
  if (table_ != nullptr) collect_sources(*table_, *this, path_, found);
  std::stable_sort(found.begin(), found.end(),
                   [](const Source& a, const Source& b) { return a.at.line < b.at.line; });
  std::vector<std::pair<std::string, std::string>> result;
  for (Source& source : found) {
    if (source.block.empty()) source.block = root_name;
    result.emplace_back(std::move(source.block), std::move(source.text));
  }
  return result;
}

}  // namespace maxwrench
