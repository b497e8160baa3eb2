#include "problems/make/bad_value.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <cmath>

namespace maxwrench {

BadValue::BadValue(std::string_view key, std::string_view got, std::string_view expected)
    : std::invalid_argument(one_line(bad_value_line(key, got, expected))),
      key_(key),
      got_(got),
      expected_(expected) {}

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool space = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!space) line += c;
    if (space && !line.empty() && line.back() != ' ') line += ' ';
  }
  return line;
}

std::string bad_value_line(std::string_view key, std::string_view got, std::string_view expected) {
  constexpr std::size_t kLongest = 120;
  const bool cut = got.size() > kLongest;
  return fmt::format("{}: got {}{}, expected {}", key, got.substr(0, kLongest), cut ? "..." : "",
                     expected);
}

std::string shown(double value) { return fmt::format("{}", value); }

std::string shown(const std::string& text) { return fmt::format("'{}'", text); }

std::string shown(const std::vector<std::string>& texts) {
  std::vector<std::string> parts;
  for (const std::string& text : texts) parts.push_back(shown(text));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

std::string shown(const Eigen::VectorXd& numbers) {
  return fmt::format("[{}]", fmt::join(numbers.data(), numbers.data() + numbers.size(), ", "));
}

void require_numbers(std::string_view key, const Eigen::VectorXd& numbers, Eigen::Index size) {
  if (numbers.size() == size && numbers.allFinite()) return;
  throw BadValue(key, numbers.size() == 0 ? "nothing" : shown(numbers),
                 fmt::format("a list of {} finite number{}", size, size == 1 ? "" : "s"));
}

void require_finite(std::string_view key, double value) {
  if (!std::isfinite(value)) throw BadValue(key, shown(value), "a finite number");
}

void require_pose(std::string_view key, const Pose<double>& pose) {
  constexpr double kRounding = 1e-9;
  require_numbers(std::string(key) + ".xyz", pose.p, 3);
  const double error = (pose.R.transpose() * pose.R - Eigen::Matrix3d::Identity()).norm();
  if (error < kRounding && pose.R.determinant() > 0) return;
  throw BadValue(std::string(key) + ".rpy",
                 shown(Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(pose.R.data(), 9))),
                 "a rotation, R'R = I and det R = 1 (here by columns)");
}

void require_positive(std::string_view key, double value, std::string_view expected) {
  if (!(value > 0)) throw BadValue(key, shown(value), expected);
}

void require_non_negative(std::string_view key, double value) {
  require_finite(key, value);
  if (value < 0) throw BadValue(key, shown(value), "a number >= 0");
}

Eigen::Vector3d direction_of(std::string_view key, const Eigen::Vector3d& v) {
  require_numbers(key, v, 3);
  if (v.stableNorm() < 1e-9) throw BadValue(key, shown(v), "a direction of nonzero length");
  return v.stableNormalized();
}

}  // namespace maxwrench
