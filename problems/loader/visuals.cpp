#include "problems/loader/visuals.h"

#include <algorithm>
#include <stdexcept>

#include "problems/loader/block.h"
#include "problems/loader/robot_choices.h"
#include "problems/loader/urdf_tree.h"

namespace maxwrench {
namespace {

/// Whether the tree has the links of the robot, to which the visuals belong.
bool is_of(const UrdfTree& tree, const Robot& robot) {
  return std::equal(tree.links.begin(), tree.links.end(), robot.links.begin(), robot.links.end(),
                    [](const Link& a, const Link& b) { return a.name == b.name; });
}

/// The tree of a URDF that was read alone. If a tool was chosen, joints without effort that do not
/// carry it are locked; then it is the only end effector.
UrdfTree read_alone(const Robot& robot, const std::vector<std::filesystem::path>& packages) {
  UrdfChoices choices;
  choices.packages = packages;
  choices.meshes = MeshUse::kIgnore;
  UrdfTree tree = read_urdf(robot.files.front(), choices);
  if (is_of(tree, robot) || robot.end_effectors.size() != 1) return tree;
  choices.tips = {robot.end_effectors.front().name};
  return read_urdf(robot.files.front(), choices);
}

UrdfTree read_with_toml(const std::filesystem::path& file) {
  const Block root = Block::read(file);
  UrdfChoices choices = read_choices(root);
  choices.meshes = MeshUse::kIgnore;
  return read_urdf(file.parent_path() / root.text("urdf"), choices);
}

}  // namespace

std::vector<Visual> read_visuals(const Robot& robot,
                                 const std::vector<std::filesystem::path>& packages) {
  if (robot.files.empty()) return {};
  try {
    const std::filesystem::path file = robot.files.front();
    const UrdfTree tree =
        file.extension() == ".toml" ? read_with_toml(file) : read_alone(robot, packages);
    return is_of(tree, robot) ? tree.visuals : std::vector<Visual>();
  } catch (const std::invalid_argument&) {  // the files have been replaced
    return {};
  }
}

}  // namespace maxwrench
