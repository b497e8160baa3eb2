#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace maxwrench {

/// Expects std::invalid_argument with one line that names first the key, then the given value and
/// what was expected.
template <class Call>
void expect_rejected(const char* key, const Call& call) {
  try {
    call();
    ADD_FAILURE() << key << ": not rejected";
  } catch (const std::invalid_argument& error) {
    const std::string line = error.what();
    EXPECT_EQ(line.find(key), 0U) << line;
    EXPECT_NE(line.find(": got "), std::string::npos) << line;
    EXPECT_NE(line.find("expected"), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

}  // namespace maxwrench
