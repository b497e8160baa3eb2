#include "maxwrench/version.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// Two commits with the same sources but other results and another message, and a third with other
/// sources, as cmake/version.cmake describes them; then what the manual says of the last; then that
/// with other results, with another source beside it, and with a changed one.
constexpr const char* kScript = R"sh(
set -e
git init -q .
git config user.name nobody
git config user.email nobody@localhost
mkdir results
echo 1 > source
describe() {
  git add source results
  git commit -q "$@"
  look
}
look() {
  cmake -D SOURCE="$PWD" -D RELEASE=1.0 -D OUTPUT="$PWD/.git/version.cpp" -P "$VERSION" 1>&2
  sed -n 's/.*return "\(.*\)".*/\1/p' .git/version.cpp
}
echo 1 > results/table
describe -m first
echo 2 > results/table
describe --amend -m rewritten
echo 2 > source
describe -m third
git ls-tree -r HEAD | grep -vP '\tresults/' | sha1sum | cut -c -10
echo 3 > results/table
look
mkdir lib
echo 1 > lib/more.cpp
look
rm lib/more.cpp
echo 3 > source
look
)sh";

TEST(Version, NamesItsSourcesAlsoWhereTheCommitIsRewritten) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "script") << kScript;
  const CommandResult result = run_maxwrench("--version > /dev/null; VERSION='" MAXWRENCH_SOURCE_DIR
                                             "/cmake/version.cmake' bash script",
                                             folder.path());
  std::istringstream words(result.out);
  std::string version[3], sources[3], manual;
  for (int i = 0; i < 3; ++i) words >> version[i] >> sources[i];
  words >> manual;
  ASSERT_EQ(manual.size(), 10U) << result.out << result.err;
  EXPECT_EQ(version[0].find("1.0+"), 0U) << version[0];
  EXPECT_NE(version[0], version[1]);
  EXPECT_EQ(sources[0], sources[1]);
  EXPECT_NE(sources[1], sources[2]);
  EXPECT_EQ(sources[2], manual);
  for (const char* more : {"", ".dirty", ".dirty"}) {
    std::string looked, of;
    words >> looked >> of;
    EXPECT_EQ(looked, version[2] + more);
    EXPECT_EQ(of, manual);
  }
}

TEST(Version, DescribesTheBuild) {
  const std::string text = describe_build();
  EXPECT_EQ(text.find(std::string("maxwrench ") + version() + "\nsources " + sources_id() + "\n"),
            0U)
      << text;
}

}  // namespace
}  // namespace maxwrench
