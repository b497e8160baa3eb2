#include "tests/fuzz/damaged_problems.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "maxwrench/load.h"
#include "maxwrench/objective.h"
#include "maxwrench/strategies.h"
#include "tests/fuzz/damage.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

const char* const kTomlWords[] = {
    "[",         "]",        "[[",      "]]",        "=",
    "{",         "}",        "\"",      "\"\"\"",    "true",
    "\n",        "#",        "[pose]",  "[theta_r]", "[wrench]",
    "[contact]", "[motion]", "[path]",  "T = 0\n",   "k = 1\n",
    "type",      "xyz",      "default", "min",       "source = \"x\"\n",
    ", 1",       "\xff",     "..",      "\\u0000"};
const char* const kUrdfWords[] = {
    "<",          "/>",       ">",         "\"",       "<link name=\"a\"/>",
    "</robot>",   "<!--",     "&lt;",      "<joint",   "type=\"fixed\"",
    "<origin/>",  "\n",       "<inertia ", "parent",   "<mass value=\"0\"/>",
    "continuous", "floating", "\xff",      "<limit/>", "<sphere radius=\"1\"/>"};

bool is_state(const fs::path& file) { return file.stem().string().starts_with("state"); }

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

std::string answer(const Problem& problem) {
  if (problem.motion) return problem.type();
  const auto objective = make_capability_objective(problem, Wrench::kPure, [&] {
    return find_measure("linf_polytope").make(problem, find_wrench_solver("condensed").make());
  });
  objective->evaluate(problem.theta_r_default);
  if (objective->verdict().status != Status::kOptimal && objective->verdict().reason.empty()) {
    throw std::logic_error("no verdict and no reason");
  }
  return to_string(objective->verdict().status);
}

}  // namespace

/// A robot's files belong to the first task of their folder.
DamagedProblems::DamagedProblems() {
  const fs::path shipped = MAXWRENCH_SOURCE_DIR "/problems";
  std::vector<fs::path> tasks;
  for (const std::string& name : shipped_problems()) {
    const fs::path family = fs::path(name).parent_path();
    if (!fs::exists(folder_.path() / family)) {
      fs::create_directories((folder_.path() / family).parent_path());
      fs::copy(shipped / family, folder_.path() / family, fs::copy_options::recursive);
    }
    tasks.push_back(folder_.path() / (name + ".toml"));
    targets_.push_back({tasks.back(), tasks.back(), read_text(tasks.back())});
  }
  for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
    const fs::path& file = entry.path();
    const bool of_robot = file.extension() == ".urdf" || file.extension() == ".toml";
    if (!of_robot || std::count(tasks.begin(), tasks.end(), file)) continue;
    const auto task = std::find_if(tasks.begin(), tasks.end(), [&](const fs::path& other) {
      return other.parent_path() == file.parent_path();
    });
    if (task != tasks.end()) targets_.push_back({file, *task, read_text(file)});
  }
  std::sort(targets_.begin(), targets_.end(),
            [](const Target& a, const Target& b) { return a.file < b.file; });
}

std::string DamagedProblems::read(const Target& target) {
  try {
    const Problem problem = load_problem(target.task.string());
    if (!is_state(target.file)) return answer(problem);
    load_state(target.file, problem.robot);
    return "read";
  } catch (const std::invalid_argument& error) {
    const std::string line = error.what();
    if (line.empty() || line.find('\n') != std::string::npos) {
      throw std::logic_error("rejected in not one line: '" + line + "'");
    }
    return "rejected";
  }
}

std::string DamagedProblems::step(Random& random) {
  const auto last = static_cast<int>(targets_.size()) - 1;
  const Target& target = targets_[static_cast<std::size_t>(whole(random, 0, last))];
  const bool urdf = target.file.extension() == ".urdf";
  const auto words =
      urdf ? std::span<const char* const>(kUrdfWords) : std::span<const char* const>(kTomlWords);
  const std::string text = damaged(target.text, words, random);
  write(target.file, text);
  std::string outcome;
  try {
    outcome = read(target);
  } catch (const std::exception& error) {
    write(target.file, target.text);
    throw std::logic_error(target.file.filename().string() + ": " + error.what() + "\n" + text);
  }
  write(target.file, target.text);
  const char* const kind = urdf ? "urdf" : is_state(target.file) ? "state" : "toml";
  return std::string(kind) + ", " + outcome;
}

}  // namespace maxwrench
