#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// An invalid value of a robot or a task: "KEY: got VALUE, expected ...", in one line.
class BadValue : public std::invalid_argument {
 public:
  BadValue(std::string_view key, std::string_view got, std::string_view expected);
  const std::string& key() const { return key_; }
  const std::string& got() const { return got_; }
  const std::string& expected() const { return expected_; }

 private:
  std::string key_, got_, expected_;
};

/// The text with each run of white space replaced by one space.
std::string one_line(std::string_view text);
/// "KEY: got VALUE, expected ...", in which a long value is shortened.
std::string bad_value_line(std::string_view key, std::string_view got, std::string_view expected);

// Values as they are written in a file.
std::string shown(double value);
std::string shown(const std::string& text);
std::string shown(const std::vector<std::string>& texts);
std::string shown(const Eigen::VectorXd& numbers);

/// Rejects anything other than `size` finite numbers.
void require_numbers(std::string_view key, const Eigen::VectorXd& numbers, Eigen::Index size);
void require_finite(std::string_view key, double value);
/// Rejects values that are not finite, and an R that is not a rotation.
void require_pose(std::string_view key, const Pose<double>& pose);
/// Rejects anything other than a number > 0.
void require_positive(std::string_view key, double value,
                      std::string_view expected = "a number > 0");
void require_non_negative(std::string_view key, double value);
/// v / |v|.
Eigen::Vector3d direction_of(std::string_view key, const Eigen::Vector3d& v);

}  // namespace maxwrench
