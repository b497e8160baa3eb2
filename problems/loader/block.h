#pragma once

#include <toml++/impl/forward_declarations.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// A table of a TOML file. It knows its file and its key path, so that every error names them. All
/// numbers that it returns are finite. `source` and `status` are allowed in every table.
class Block {
 public:
  /// Reads the file and returns its root table. Rejects a missing file or a syntax error.
  static Block read(const std::filesystem::path& file);
  /// A root table of no file.
  static Block of(toml::table table);

  const std::filesystem::path& file() const { return file_; }
  bool has(std::string_view key) const;
  /// Rejects every key that is not in the list.
  void allow_only(const std::vector<std::string_view>& keys) const;
  [[noreturn]] void throw_bad_value(std::string_view key, std::string_view expected) const;
  [[noreturn]] void throw_bad_value(std::string_view key, std::string_view got,
                                    std::string_view expected) const;

  // Values. Without a fallback the key is required.
  std::string text(std::string_view key) const;
  std::string text(std::string_view key, std::string_view fallback) const;
  double number(std::string_view key) const;
  double number(std::string_view key, double fallback) const;
  Eigen::VectorXd numbers(std::string_view key, int size) const;
  Eigen::VectorXd any_numbers(std::string_view key) const;  ///< of any size; empty without key
  Eigen::Vector3d vector(std::string_view key) const;
  Eigen::Vector3d vector(std::string_view key, const Eigen::Vector3d& fallback) const;
  Eigen::Vector3d direction(std::string_view key) const;  ///< normalised; zero is rejected
  int whole(std::string_view key, int low, int high) const;
  int whole(std::string_view key, int low, int high, int fallback) const;
  bool truth(std::string_view key, bool fallback) const;
  bool is_text(std::string_view key) const;
  std::vector<std::string> texts(std::string_view key) const;
  std::vector<std::pair<std::string, std::string>> text_pairs(std::string_view key) const;
  /// A list of one or more lists of `size` numbers.
  std::vector<Eigen::VectorXd> rows(std::string_view key, int size) const;
  /// A list of one or more lists of names, none of them empty.
  std::vector<std::vector<std::string>> text_lists(std::string_view key) const;

  // Tables; empty if the key is missing. `list` is an array of tables, `named` a table of tables in
  // the order of the file.
  Block table(std::string_view key) const;
  std::vector<Block> list(std::string_view key) const;
  std::vector<std::pair<std::string, Block>> named(std::string_view key) const;
  /// The keys of this table, without `source` and `status`.
  std::vector<std::string> keys() const;
  /// All entries of this table, each of which must be a number.
  std::map<std::string, double> numbers_by_name() const;

  /// Pairs of a block's name and its `source` with its `status` in brackets, for this table and all
  /// tables in it, in the order of the file.
  std::vector<std::pair<std::string, std::string>> sources(std::string_view root_name) const;

 private:
  Block(std::filesystem::path file, std::string path, std::shared_ptr<const toml::table> root,
        const toml::table* table);
  Block inner(std::string path, const toml::table& table) const;
  std::string path_of(std::string_view key) const;
  const toml::node& require(std::string_view key, std::string_view expected) const;
  const toml::array& array(std::string_view key, std::string_view expected) const;
  Eigen::VectorXd listed(std::string_view key, std::string_view expected) const;

  std::filesystem::path file_;
  std::string path_;                         ///< of this table; empty for the root
  std::shared_ptr<const toml::table> root_;  ///< keeps the tables alive
  const toml::table* table_;                 ///< null if an optional table is missing
};

}  // namespace maxwrench
