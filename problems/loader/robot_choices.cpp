#include "problems/loader/robot_choices.h"

namespace maxwrench {
namespace {

std::optional<MeshUse> read_mesh_use(const Block& block) {
  if (!block.has("meshes")) return std::nullopt;
  const std::string use = block.text("meshes");
  if (use == "hull") return MeshUse::kHull;
  if (use == "capsules") return MeshUse::kCapsules;
  if (use == "ignore") return MeshUse::kIgnore;
  block.throw_bad_value("meshes", "'hull', 'capsules' or 'ignore'");
}

std::optional<double> number_if_any(const Block& block, std::string_view key) {
  return block.has(key) ? std::optional<double>(block.number(key)) : std::nullopt;
}

JointChoice read_joint_choice(const Block& block) {
  block.allow_only({"effort", "velocity", "lower", "upper", "lock", "mimic"});
  JointChoice choice;
  choice.effort = number_if_any(block, "effort");
  if (choice.effort.value_or(0) < 0) block.throw_bad_value("effort", "a number >= 0");
  choice.velocity = number_if_any(block, "velocity");
  if (choice.velocity.value_or(1) <= 0) block.throw_bad_value("velocity", "a number > 0");
  choice.lower = number_if_any(block, "lower");
  choice.upper = number_if_any(block, "upper");
  choice.lock = number_if_any(block, "lock");
  if (block.has("mimic")) {
    if (choice.lock) block.throw_bad_value("lock", "no such key beside mimic");
    const Block mimic = block.table("mimic");
    mimic.allow_only({"joint", "ratio", "offset"});
    choice.mimic = {mimic.text("joint"), mimic.number("ratio", 1), mimic.number("offset", 0)};
  }
  return choice;
}

LinkChoice read_link_choice(const Block& block) {
  block.allow_only({"mass", "com", "inertia", "meshes"});
  LinkChoice choice;
  choice.mass = number_if_any(block, "mass");
  if (choice.mass.value_or(0) < 0) block.throw_bad_value("mass", "a number >= 0");
  if (block.has("com")) choice.com = block.vector("com");
  if (block.has("inertia")) choice.inertia = read_inertia(block, "inertia");
  choice.meshes = read_mesh_use(block);
  return choice;
}

}  // namespace

Eigen::Matrix3d read_inertia(const Block& block, std::string_view key) {
  const Vector6d i = block.numbers(key, 6);
  Eigen::Matrix3d inertia;
  inertia << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
  return inertia;
}

UrdfChoices read_choices(const Block& root) {
  UrdfChoices choices;
  if (root.has("packages")) {
    for (const std::string& folder : root.texts("packages")) {
      choices.packages.push_back(root.file().parent_path() / folder);
    }
  }
  choices.meshes = read_mesh_use(root.table("collision")).value_or(choices.meshes);
  for (const auto& [name, block] : root.named("joints")) {
    choices.joints.emplace(name, read_joint_choice(block));
  }
  for (const auto& [name, block] : root.named("links")) {
    choices.links.emplace(name, read_link_choice(block));
  }
  for (const auto& [name, block] : root.named("end_effectors")) {
    choices.tips.insert(block.text("link"));
  }
  return choices;
}

}  // namespace maxwrench
