#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/support/edited_copy.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

void expect_one_line(const CommandResult& result, const std::string& mention) {
  EXPECT_EQ(result.exit_status, 2) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_EQ(result.err.rfind("maxwrench: ", 0), 0U) << result.err;
  EXPECT_NE(result.err.find(mention), std::string::npos) << result.err;
}

const std::string kSelf = "'" MAXWRENCH_COMMAND "' ";

/// The script's own redirections count.
CommandResult run_script(const std::string& script, const fs::path& folder) {
  return run_maxwrench("--version > /dev/null; (" + script + ")", folder);
}

/// min x + y subject to x + y >= 2 with names in Latin-1. Those that differ only there stay apart.
TEST(Streams, NamesInLatin1ComeOutAsUtf8) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "l.mps")
      << "NAME s\nROWS\n N cost\n G su\xE9m\nCOLUMNS\n    x\xE4 cost 1 su\xE9m 1\n"
         "    x\xF6 cost 1 su\xE9m 1\nRHS\n    RHS su\xE9m 2\nENDATA\n";
  const CommandResult result = run_maxwrench("lp l.mps --json", folder.path());
  ASSERT_EQ(result.exit_status, 0) << result.err;
  const json object = json::parse(result.out);
  ASSERT_EQ(object["x"].size(), 2U);
  EXPECT_EQ(object["x"]["x\u00E4"].get<double>() + object["x"]["x\u00F6"].get<double>(), 2);
  EXPECT_EQ(object["duals"]["su\u00E9m"], 1);
}

TEST(Streams, PathsInLatin1ComeOutAsUtf8) {
  const EditedCopy copy;
  fs::copy(copy.path() / "force.toml", copy.path() / "f\xE9.toml");
  const CommandResult result = run_maxwrench("eval 'f\xE9.toml' --json", copy.path());
  ASSERT_EQ(result.exit_status, 0) << result.err;
  EXPECT_EQ(json::parse(result.out)["problem"], "f\u00E9.toml");
}

/// Paths that the system itself rejects.
TEST(Streams, ImpossiblePathsAreOneLine) {
  const TemporaryFolder folder;
  fs::create_symlink("circle", folder.path() / "circle");
  for (const std::string& path : {std::string(300, 'a'), std::string("circle")}) {
    for (const char* words :
         {"check ", "eval ", "lp ", "solve ", "plot ", "simulate ", "compare --budget 1 ",
          "eval planar/force --state ", "plot planar/force --out ", "eval planar/force --write ",
          "run problem=planar/force measure=ellipsoid budget=1 --out "}) {
      SCOPED_TRACE(words);
      const CommandResult result = run_maxwrench(words + path, folder.path());
      EXPECT_EQ(result.out, "");
      expect_one_line(result, path);
    }
  }
}

TEST(Streams, SLOW_AnAnswerThatDoesNotArriveIsAnError) {
  const TemporaryFolder folder;
  for (const char* words : {"list", "--help", "--version", "check planar/force",
                            "eval planar/force --json", "plot planar/force"}) {
    SCOPED_TRACE(words);
    expect_one_line(run_script(kSelf + words + " > /dev/full", folder.path()), "stdout");
    expect_one_line(run_script(kSelf + words + " >&-", folder.path()), "stdout");
  }
  // The complaint has nowhere to go.
  for (const char* place : {"2>&-", "2> /dev/full"}) {
    EXPECT_EQ(run_script(kSelf + "eval planar/none " + place, folder.path()).exit_status, 2);
  }
}

/// With stdout closed, the file must not take its number and receive the answer.
TEST(Streams, FilesDoNotReceiveWhatIsMeantForStdout) {
  const TemporaryFolder folder;
  const std::string words = "eval planar/force --write program.mps ";
  ASSERT_EQ(run_maxwrench(words, folder.path()).exit_status, 0);
  const std::string program = read_text(folder.path() / "program.mps");
  expect_one_line(run_script(kSelf + words + ">&-", folder.path()), "stdout");
  EXPECT_EQ(read_text(folder.path() / "program.mps"), program);
}

/// A file that stdout already writes gets both, one after the other.
TEST(Streams, StdoutByNameIsAppendedTo) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_maxwrench("eval planar/force --write program.mps", folder.path()).exit_status, 0);
  const CommandResult both =
      run_maxwrench("eval planar/force --json --write /dev/stdout", folder.path());
  const std::string program = read_text(folder.path() / "program.mps");
  ASSERT_EQ(both.exit_status, 0) << both.err;
  ASSERT_EQ(both.out.substr(0, program.size()), program);
  EXPECT_EQ(json::parse(both.out.substr(program.size()))["problem"], "planar/force");
}

TEST(Streams, AReaderThatLeavesEarlyHearsNoComplaint) {
  const TemporaryFolder folder;
  const CommandResult result = run_script(kSelf + "check uvms/valve | head -c 1", folder.path());
  EXPECT_EQ(result.out.size(), 1U);
  EXPECT_EQ(result.err, "");
}

/// A file of at most one block; what was there before stays.
TEST(Streams, AFileThatDoesNotFitLeavesNothing) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "old.svg") << "old";
  const fs::path command = folder.path() / "limited";
  std::ofstream(command) << "ulimit -f 1\nexec '" MAXWRENCH_COMMAND "' \"$@\"\n";
  for (const char* name : {"old.svg", "new.svg"}) {
    const std::string words =
        std::string("--version > /dev/null; sh limited plot planar/force --out ") + name;
    expect_one_line(run_maxwrench(words, folder.path()), "File too large");
  }
  EXPECT_EQ(read_text(folder.path() / "old.svg"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 2);
}

struct Clash {
  const char* words;
  const char* mention;
};

class OutputOnInput : public testing::TestWithParam<Clash> {};

INSTANTIATE_TEST_SUITE_P(
    Each, OutputOnInput,
    testing::Values(Clash{"eval force.toml --write force.toml", "--write"},
                    Clash{"eval force.toml --write ./link.toml", "--write"},
                    Clash{"eval force.toml --write vehicle.urdf", "--write"},
                    Clash{"plot force.toml --out ./../$(basename $PWD)/force.toml", "--out"},
                    Clash{"plot force.toml --out vehicle.toml", "--out"},
                    Clash{"simulate force.toml --ramp 0.1 --hold 0.1 --out a --figure ./a",
                          "--figure"},
                    Clash{"simulate force.toml --ramp 0.1 --hold 0.1 --out force.toml", "--out"},
                    Clash{"plot force.toml --out ''", "--out"},
                    Clash{"eval force.toml --write ''", "--write"},
                    Clash{"run force.toml budget=1 --out ''", "--out"}));

TEST_P(OutputOnInput, IsRejectedBeforeAnythingIsWritten) {
  const EditedCopy copy;
  fs::create_symlink("force.toml", copy.path() / "link.toml");
  const auto files = [&] {
    std::map<std::string, std::string> texts;
    for (const auto& entry : fs::directory_iterator(copy.path()))
      texts[entry.path().filename().string()] = read_text(entry.path());
    return texts;
  };
  const auto before = files();
  const CommandResult result = run_maxwrench(GetParam().words, copy.path());
  EXPECT_EQ(result.out, "");
  expect_one_line(result, GetParam().mention);
  EXPECT_EQ(files(), before);
}

}  // namespace
}  // namespace maxwrench
