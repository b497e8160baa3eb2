#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

const fs::path kRobots = fs::path(MAXWRENCH_SOURCE_DIR) / "tests/data/robots";

std::vector<std::string> lines_of(const fs::path& file) {
  std::vector<std::string> lines;
  std::istringstream text(read_text(file));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

bool is_example(const std::string& line) {
  return line.size() > 1 && line[0] == '#' && line[1] != ' ';
}

/// The first lines of the examples: each is a block of commented lines.
std::vector<std::size_t> examples_in(const std::vector<std::string>& lines) {
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (is_example(lines[i]) && (i == 0 || !is_example(lines[i - 1]))) starts.push_back(i);
  }
  return starts;
}

void write_lines(const fs::path& file, const std::vector<std::string>& lines) {
  std::ofstream out(file);
  for (const std::string& line : lines) out << line << '\n';
}

/// Uncomments one example after another; each time the task is still valid.
void try_examples(const fs::path& folder, const std::string& file, std::size_t expected) {
  const std::vector<std::string> lines = lines_of(folder / file);
  const std::vector<std::size_t> starts = examples_in(lines);
  EXPECT_EQ(starts.size(), expected) << file;
  for (const std::size_t start : starts) {
    std::vector<std::string> used = lines;
    for (std::size_t i = start; i < used.size() && is_example(used[i]); ++i) used[i].erase(0, 1);
    write_lines(folder / file, used);
    for (const char* checked : {"check robot.toml", "check task.toml"}) {
      const CommandResult result = run_maxwrench(checked, folder);
      EXPECT_EQ(result.exit_status, 0) << used[start] << '\n' << result.err;
    }
  }
  write_lines(folder / file, lines);
}

TEST(Init, SLOW_WritesFilesToStartFrom) {
  for (const char* robot : {"ur10", "panda"}) {
    const TemporaryFolder folder;
    const std::string urdf = (kRobots / robot / (std::string(robot) + ".urdf")).string();
    const CommandResult result = run_maxwrench("init '" + urdf + "' --out new", folder.path());
    ASSERT_EQ(result.exit_status, 0) << result.err;
    EXPECT_EQ(result.out, "new/robot.toml\nnew/task.toml\n");
    const fs::path here = folder.path() / "new";
    const CommandResult solved = run_maxwrench("solve task.toml --budget 200 --json", here);
    ASSERT_EQ(solved.exit_status, 0) << solved.err;
    EXPECT_GT(nlohmann::json::parse(solved.out)["beta"], 0);
    try_examples(here, "robot.toml", 10);
    // The arm of six joints has no joint to choose.
    try_examples(here, "task.toml", std::string(robot) == "panda" ? 4 : 3);
    // The files belong to the user.
    const CommandResult again = run_maxwrench("init '" + urdf + "' --out new", folder.path());
    EXPECT_EQ(again.exit_status, 2);
    EXPECT_EQ(again.err,
              "maxwrench: --out: got 'new/robot.toml', which exists, expected a folder without "
              "it\n");
  }
}

/// The pose of an arm of four joints is given by them: its six numbers, once rounded, would not be
/// reached.
TEST(Init, GivesThePoseOfAShortArmByItsJoints) {
  const TemporaryFolder folder;
  std::string urdf = "<robot name='short'><link name='l0'/>";
  const char* axes[] = {"0 0 1", "0 1 0", "0 1 0", "1 0 0"};
  for (int i = 1; i <= 4; ++i) {
    urdf += fmt::format(
        "<link name='l{0}'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' "
        "ixz='0' iyz='0'/></inertial></link><joint name='j{0}' type='revolute'><parent "
        "link='l{1}'/><child link='l{0}'/><origin xyz='0.1 0.02 0.3'/><axis xyz='{2}'/><limit "
        "lower='-2' upper='2' effort='90' velocity='1'/></joint>",
        i, i - 1, axes[i - 1]);
  }
  std::ofstream(folder.path() / "short.urdf") << urdf << "</robot>";
  ASSERT_EQ(run_maxwrench("init short.urdf", folder.path()).exit_status, 0);
  EXPECT_NE(read_text(folder.path() / "task.toml").find("[pose]\njoints = { \"j1\" = "),
            std::string::npos);
  const CommandResult result = run_maxwrench("eval task.toml", folder.path());
  EXPECT_EQ(result.exit_status, 0) << result.err;
}

/// Without --out the files are beside the URDF, whose path is then its name.
TEST(Init, NamesTheUrdfRelativeToItself) {
  const TemporaryFolder folder;
  fs::copy(kRobots / "ur10/ur10.urdf", folder.path());
  ASSERT_EQ(run_maxwrench("init ur10.urdf --tool tool0", folder.path()).exit_status, 0);
  const std::string text = read_text(folder.path() / "robot.toml");
  EXPECT_NE(text.find("\nurdf = \"ur10.urdf\"\n"), std::string::npos) << text;
  EXPECT_NE(text.find("[end_effectors.\"tool0\"]"), std::string::npos) << text;
  EXPECT_EQ(text.find("ee_link"), std::string::npos) << text;
}

}  // namespace
}  // namespace maxwrench
