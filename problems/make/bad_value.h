#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// A value that a robot or a task cannot have: "KEY: got VALUE, expected ...", in one line.
class BadValue : public std::invalid_argument {
 public:
  BadValue(std::string_view key, std::string_view got, std::string_view expected);
  const std::string& key() const { return key_; }
  const std::string& got() const { return got_; }
  const std::string& expected() const { return expected_; }

 private:
  std::string key_, got_, expected_;
};

/// Each run of white space as one space.
std::string one_line(std::string_view text);
/// "KEY: got VALUE, expected ...", a long value cut.
std::string bad_value_line(std::string_view key, std::string_view got, std::string_view expected);

// Values as in a file.
std::string shown(double value);
std::string shown(const std::string& text);
std::string shown(const std::vector<std::string>& texts);
std::string shown(const Eigen::VectorXd& numbers);

/// Rejects all but `size` finite numbers.
void require_numbers(std::string_view key, const Eigen::VectorXd& numbers, Eigen::Index size);
void require_finite(std::string_view key, double value);
/// Rejects numbers that are not finite, and an R that is no rotation.
void require_pose(std::string_view key, const Pose<double>& pose);
/// > 0.
void require_positive(std::string_view key, double value,
                      std::string_view expected = "a number > 0");
void require_non_negative(std::string_view key, double value);
/// v / |v|.
Eigen::Vector3d direction_of(std::string_view key, const Eigen::Vector3d& v);

}  // namespace maxwrench
