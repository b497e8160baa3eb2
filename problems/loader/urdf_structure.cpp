#include "problems/loader/urdf_structure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "problems/loader/bad_input.h"
#include "problems/loader/xacro.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& file) {
  std::ifstream stream = open_file(file, "a URDF file");
  std::string text(std::istreambuf_iterator<char>(stream), {});
  // Some makers put their licence before the declaration, where XML allows nothing.
  const std::size_t declaration = text.find("<?xml");
  if (declaration != std::string::npos && declaration > 0 && text.starts_with("<!--")) {
    const std::size_t end = text.find("?>", declaration);
    if (end != std::string::npos) text.erase(declaration, end + 2 - declaration);
  }
  return text;
}

/// The parser does not expand entities of the file's own, so what they stand for would be lost.
void require_no_entities(const fs::path& file, const std::string& text) {
  const std::size_t entity = text.find("<!ENTITY");
  if (entity == std::string::npos) return;
  const auto lines =
      std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(entity), '\n');
  throw_bad_input(file, fmt::format("line {}", lines + 1), "entities that it defines itself",
                  "a URDF without them");
}

void parse(const fs::path& file, const std::string& text, tinyxml2::XMLDocument& document) {
  require_no_entities(file, text);
  document.Parse(text.c_str());
  if (!document.Error()) return;
  const bool deep = document.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED;
  throw_bad_input(file, fmt::format("line {}", document.ErrorLineNum()),
                  deep ? fmt::format("an element within {} others", TINYXML2_MAX_ELEMENT_DEPTH)
                       : fmt::format("'{}'", document.ErrorName()),
                  deep ? "a file with less nesting" : "valid XML");
}

/// The links or joints by name.
std::map<std::string, UrdfElement> named_elements(const UrdfElement& robot, const char* tag) {
  std::map<std::string, UrdfElement> found;
  for (const UrdfElement& each : robot.children(tag)) {
    const UrdfElement element = each.with_name();
    if (found.emplace(name_of(element), element).second) continue;
    element.throw_bad_input("", "a duplicate name", "unique names");
  }
  return found;
}

/// A joint may lead from a link that the file does not describe, such as `world`. If no other link
/// is the root, it is one without mass.
void add_missing_root(const fs::path& file, const std::map<std::string, UrdfElement>& joints,
                      tinyxml2::XMLDocument& document, std::map<std::string, UrdfElement>& links,
                      std::vector<std::string>& notes) {
  std::set<std::string> missing, children;
  for (const auto& [name, joint] : joints) {
    children.insert(end_of(joint, "child"));
    if (const std::string parent = end_of(joint, "parent"); !links.contains(parent)) {
      missing.insert(parent);
    }
  }
  const bool rooted = std::any_of(links.begin(), links.end(), [&children](const auto& link) {
    return !children.contains(link.first);
  });
  if (missing.size() != 1 || rooted || children.contains(*missing.begin())) return;
  tinyxml2::XMLElement* xml = document.NewElement("link");
  document.InsertEndChild(xml);
  xml->SetAttribute("name", missing.begin()->c_str());
  links.emplace(*missing.begin(), UrdfElement(file, *xml, "link").with_name());
  notes.push_back(
      fmt::format("link[{}]: not in the file; it is the root, without mass", *missing.begin()));
}

/// The parent of each link.
std::map<std::string, std::string> find_parents(const std::map<std::string, UrdfElement>& links,
                                                const std::map<std::string, UrdfElement>& joints) {
  std::map<std::string, std::string> parents, joint_to;
  for (const auto& [name, joint] : joints) {
    for (const char* end : {"parent", "child"}) {
      if (links.contains(end_of(joint, end))) continue;
      joint.child(end).throw_bad_input("link", fmt::format("'{}'", end_of(joint, end)),
                                       "a link of this file");
    }
    const std::string child = end_of(joint, "child");
    if (!parents.emplace(child, end_of(joint, "parent")).second) {
      joint.child("child").throw_bad_input(
          "link", fmt::format("'{}'", child),
          fmt::format("a link that no other joint leads to ('{}' does)", joint_to.at(child)));
    }
    joint_to.emplace(child, name);
  }
  return parents;
}

/// The link without a parent. Rejects links that it does not lead to.
std::string find_root(const fs::path& file, const std::map<std::string, UrdfElement>& links,
                      const std::map<std::string, std::string>& parents) {
  std::vector<std::string> roots;
  for (const auto& [name, link] : links) {
    if (!parents.contains(name)) roots.push_back(name);
  }
  if (roots.size() != 1) {
    throw_bad_input(
        file, "link",
        roots.empty() ? "a joint to every link" : fmt::format("roots {}", fmt::join(roots, ", ")),
        "one root: one link that no joint leads to");
  }
  const std::string& root = roots.front();
  for (const auto& [name, link] : links) {
    std::string at = name;
    for (std::size_t steps = 0; at != root && steps < links.size(); ++steps) at = parents.at(at);
    if (at == root) continue;
    link.throw_bad_input("", "a loop of joints",
                         fmt::format("a tree: joints that lead here from the root '{}'", root));
  }
  return root;
}

/// The elements that are read, by the element that holds them.
const std::map<std::string, std::set<std::string>>& known_elements() {
  static const std::map<std::string, std::set<std::string>> kKnown = {
      {"robot", {"link", "joint"}},
      {"link", {"inertial", "collision"}},
      {"inertial", {"origin", "mass", "inertia"}},
      {"collision", {"origin", "geometry"}},
      {"geometry", {"box", "cylinder", "sphere", "capsule", "mesh"}},
      {"joint", {"origin", "parent", "child", "axis", "limit", "mimic"}}};
  return kKnown;
}

void collect_ignored(const tinyxml2::XMLElement& element, std::map<std::string, int>& counts) {
  const auto known = known_elements().find(element.Name());
  if (known == known_elements().end()) return;
  for (const tinyxml2::XMLElement* each = element.FirstChildElement(); each != nullptr;
       each = each->NextSiblingElement()) {
    if (known->second.contains(each->Name())) {
      collect_ignored(*each, counts);
    } else {
      ++counts[fmt::format("{}.{}", element.Name(), each->Name())];
    }
  }
}

void count_ignored(const tinyxml2::XMLElement& robot, std::vector<std::string>& notes) {
  std::map<std::string, int> counts;
  collect_ignored(robot, counts);
  // These say how a robot looks, or repeat what limits say. To ignore them changes nothing.
  for (const char* idle : {"link.visual", "robot.material", "robot.transmission"}) {
    counts.erase(idle);
  }
  std::vector<std::string> ignored;
  for (const auto& [name, count] : counts) ignored.push_back(fmt::format("{} of {}", count, name));
  if (!ignored.empty()) notes.push_back(fmt::format("not read: {}", fmt::join(ignored, ", ")));
}

}  // namespace

UrdfElement parse_robot(const fs::path& file, tinyxml2::XMLDocument& document) {
  parse(file, read_text(file), document);
  const tinyxml2::XMLElement* xml = document.FirstChildElement("robot");
  if (xml != nullptr && (file.extension() == ".xacro" || is_xacro(*xml))) {
    parse(file, expand_xacro(file), document);
    xml = document.FirstChildElement("robot");
  }
  if (xml == nullptr) throw_bad_input(file, "robot", "nothing", "an element <robot>");
  if (xml->NextSiblingElement("robot") != nullptr)
    throw_bad_input(file, "robot", "two", "one robot");
  const UrdfElement robot(file, *xml, "robot");
  const std::string version = robot.attribute("version").value_or("1.0");
  if (version != "1.0") robot.throw_bad_input("version", fmt::format("'{}'", version), "1.0");
  return robot;
}

std::string name_of(const UrdfElement& element) { return element.attribute("name").value(); }

std::string end_of(const UrdfElement& joint, const char* end) {
  const UrdfElement element = joint.child(end);
  const std::optional<std::string> link = element.attribute("link");
  if (!link) element.throw_bad_input("link", "nothing", "a link of this file");
  return *link;
}

UrdfStructure read_structure(const fs::path& file, tinyxml2::XMLDocument& document,
                             std::vector<std::string>& notes) {
  constexpr std::size_t kMostLinks = 1000;
  const UrdfElement robot = parse_robot(file, document);
  UrdfStructure structure;
  structure.name = robot.attribute("name").value_or("");
  structure.links = named_elements(robot, "link");
  const std::size_t count = structure.links.size();
  if (count == 0) throw_bad_input(file, "link", "nothing", "one link or more");
  if (count > kMostLinks) {
    throw_bad_input(file, "link", fmt::format("{} links", count),
                    fmt::format("at most {}", kMostLinks));
  }
  const auto joints = named_elements(robot, "joint");
  add_missing_root(file, joints, document, structure.links, notes);
  structure.root = find_root(file, structure.links, find_parents(structure.links, joints));
  for (const UrdfElement& joint : robot.children("joint")) {
    structure.joints.push_back(joint.with_name());
    structure.joints_from[end_of(joint, "parent")].push_back(structure.joints.back());
  }
  structure.materials = read_materials(robot);
  count_ignored(*document.FirstChildElement("robot"), notes);
  return structure;
}

}  // namespace maxwrench
