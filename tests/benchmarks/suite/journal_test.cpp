#include "benchmarks/suite/journal.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

TEST(Journal, GrowsByLinesAndBelongsToOne) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "sub" / "j";
  Journal journal(file);
  journal.begin("first");
  journal.add("second");
  EXPECT_EQ(read_text(file), "first\nsecond\n");
  EXPECT_THROW(Journal{file}, std::invalid_argument);
  EXPECT_TRUE(Journal::is_held(file));
  journal.remove();
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_FALSE(Journal::is_held(file));
}

}  // namespace
}  // namespace maxwrench
