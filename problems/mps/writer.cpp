#include "problems/mps/writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace maxwrench {
namespace {

constexpr const char* kObjective = "objective";

std::string without_blanks(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isspace(c); }, '_');
  return name;
}

std::vector<std::string> names_or(const std::vector<std::string>& given, int count, char letter) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) {
    names.push_back(given.empty() ? fmt::format("{}{}", letter, i + 1) : without_blanks(given[i]));
  }
  const std::set<std::string> different(names.begin(), names.end());
  if (different.size() != names.size() || different.count("") + different.count(kObjective) > 0) {
    throw std::invalid_argument(
        fmt::format("MPS: the names of {}, expected all different, none empty or '{}'",
                    letter == 'r' ? "rows" : "columns", kObjective));
  }
  return names;
}

std::string bound(const char* type, const std::string& column) {
  return fmt::format(" {} BND {}\n", type, column);
}

std::string bound(const char* type, const std::string& column, double value) {
  return fmt::format(" {} BND {} {:.17g}\n", type, column, value);
}

std::string bounds(const std::string& column, double l, double u) {
  if (l > u) {
    throw std::invalid_argument(fmt::format(
        "MPS: bounds {} .. {} of {}, expected a lower one below the upper one", l, u, column));
  }
  if (l == u) return bound("FX", column, l);
  if (std::isinf(l) && std::isinf(u)) return bound("FR", column);
  // MI comes before UP, because readers interpret a negative upper bound alone in different ways.
  const std::string low = std::isinf(l) ? bound("MI", column) : bound("LO", column, l);
  return std::isinf(u) ? low : low + bound("UP", column, u);
}

}  // namespace

std::string mps_text(const LinearProgram& program, const std::string& name) {
  const std::vector<std::string> rows = names_or(program.row_names, program.rows(), 'r');
  const std::vector<std::string> cols = names_or(program.col_names, program.cols(), 'x');
  std::string text = fmt::format("NAME {} FREE\nOBJSENSE\n    MAX\nROWS\n N {}\n",
                                 without_blanks(name), kObjective);
  for (const std::string& row : rows) text += " E " + row + "\n";
  text += "COLUMNS\n";
  std::string limits;
  for (int j = 0; j < program.cols(); ++j) {
    // Even a zero is written, so that a column without entries exists.
    text += fmt::format(" {} {} {:.17g}\n", cols[j], kObjective, program.c[j]);
    for (Eigen::SparseMatrix<double>::InnerIterator it(program.A, j); it; ++it) {
      if (it.value() == 0) continue;
      text += fmt::format(" {} {} {:.17g}\n", cols[j], rows[it.row()], it.value());
    }
    limits += bounds(cols[j], program.l[j], program.u[j]);
  }
  text += "RHS\n";
  for (int i = 0; i < program.rows(); ++i) {
    text += fmt::format(" RHS {} {:.17g}\n", rows[i], program.b[i]);
  }
  return text + "BOUNDS\n" + limits + "ENDATA\n";
}

}  // namespace maxwrench
