#include "problems/loader/urdf_structure.h"

#include <fmt/format.h>
#include <tinyxml.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <vector>

#include "problems/loader/bad_input.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

struct ElementRule {
  std::string_view parent;
  const char* child;
  bool required;  ///< else at most one
};

constexpr ElementRule kElementRules[] = {
    {"link", "inertial", false},   {"inertial", "origin", false},  {"inertial", "mass", true},
    {"inertial", "inertia", true}, {"collision", "origin", false}, {"collision", "geometry", true},
    {"joint", "parent", true},     {"joint", "child", true},       {"joint", "origin", false},
    {"joint", "axis", false},      {"joint", "limit", false},      {"joint", "mimic", false},
};

int count_of(const TiXmlElement& element, const char* child) {
  int n = 0;
  const TiXmlElement* next = element.FirstChildElement(child);
  for (; next != nullptr; next = next->NextSiblingElement(child)) ++n;
  return n;
}

void check_elements(const fs::path& file, const TiXmlElement& element, const std::string& key) {
  for (const ElementRule& rule : kElementRules) {
    if (element.ValueStr() != rule.parent) continue;
    const int n = count_of(element, rule.child);
    if (n == 1 || (n == 0 && !rule.required)) continue;
    refuse(file, fmt::format("{}.{}", key, rule.child),
           n == 0 ? "nothing" : fmt::format("{} elements", n),
           fmt::format("one <{}>{}", rule.child, rule.required ? "" : " at most"));
  }
}

void check_shape(const fs::path& file, const TiXmlElement& collision, const std::string& key) {
  constexpr std::array<std::string_view, 3> kShapes = {"box", "cylinder", "sphere"};
  const char* expected =
      "one box, cylinder or sphere, or no <collision> here and capsules in the robot's TOML";
  const TiXmlElement* shape = collision.FirstChildElement("geometry")->FirstChildElement();
  const std::string geometry = key + ".geometry";
  if (shape == nullptr) refuse(file, geometry, "nothing", expected);
  if (std::find(kShapes.begin(), kShapes.end(), shape->ValueStr()) == kShapes.end()) {
    refuse(file, geometry, fmt::format("<{}>", shape->ValueStr()), expected);
  }
  const TiXmlElement* second = shape->NextSiblingElement();
  if (second == nullptr) return;
  refuse(file, geometry, fmt::format("<{}> and <{}>", shape->ValueStr(), second->ValueStr()),
         expected);
}

void check_link(const fs::path& file, const TiXmlElement& link, const std::string& key) {
  check_elements(file, link, key);
  const TiXmlElement* inertial = link.FirstChildElement("inertial");
  if (inertial != nullptr) check_elements(file, *inertial, key + ".inertial");
  const TiXmlElement* collision = link.FirstChildElement("collision");
  for (; collision != nullptr; collision = collision->NextSiblingElement("collision")) {
    check_elements(file, *collision, key + ".collision");
    check_shape(file, *collision, key + ".collision");
  }
}

/// Links or joints by name.
using Named = std::map<std::string, const TiXmlElement*>;

Named named_elements(const fs::path& file, const TiXmlElement& robot, const char* kind) {
  Named found;
  const TiXmlElement* element = robot.FirstChildElement(kind);
  for (; element != nullptr; element = element->NextSiblingElement(kind)) {
    const char* name = element->Attribute("name");
    if (name == nullptr || *name == '\0') {
      refuse(file, fmt::format("line {}: {}.name", element->Row(), kind),
             name == nullptr ? "nothing" : "''", "a name");
    }
    if (!found.emplace(name, element).second) {
      refuse(file, fmt::format("{}[{}]", kind, name), "two of this name", "names of their own");
    }
  }
  return found;
}

/// The link at one end of a joint.
std::string end_of(const fs::path& file, const std::string& joint, const TiXmlElement& element,
                   const char* end, const Named& links) {
  const char* link = element.FirstChildElement(end)->Attribute("link");
  if (link != nullptr && links.contains(link)) return link;
  refuse(file, fmt::format("joint[{}].{}.link", joint, end),
         link == nullptr ? "nothing" : fmt::format("'{}'", link), "a link of this file");
}

/// The link without a parent; the others lead to it unless there is a loop.
std::string find_root(const fs::path& file, const Named& links,
                      const std::map<std::string, std::string>& parents) {
  std::vector<std::string> roots;
  for (const auto& [name, link] : links) {
    if (!parents.contains(name)) roots.push_back(name);
  }
  if (roots.size() == 1) return roots.front();
  refuse(file, "link",
         roots.empty() ? "a joint to every link" : fmt::format("roots {}", fmt::join(roots, ", ")),
         "one root: one link that no joint leads to");
}

void check_tree(const fs::path& file, const Named& links, const Named& joints) {
  std::map<std::string, std::string> parents, joint_to;  // of a link
  for (const auto& [name, joint] : joints) {
    check_elements(file, *joint, fmt::format("joint[{}]", name));
    const std::string parent = end_of(file, name, *joint, "parent", links);
    const std::string child = end_of(file, name, *joint, "child", links);
    if (!parents.emplace(child, parent).second) {
      refuse(file, fmt::format("joint[{}].child.link", name), fmt::format("'{}'", child),
             fmt::format("a link that no other joint leads to ('{}' does)", joint_to.at(child)));
    }
    joint_to.emplace(child, name);
  }
  const std::string root = find_root(file, links, parents);
  for (const auto& [name, link] : links) {
    std::string at = name;
    for (std::size_t steps = 0; at != root && steps < links.size(); ++steps) at = parents.at(at);
    if (at == root) continue;
    refuse(file, fmt::format("link[{}]", name), "a loop of joints",
           fmt::format("a tree: joints that lead here from the root '{}'", root));
  }
}

/// The place of the '>' that ends the tag at `at`, outside of quotes.
std::size_t end_of_tag(const std::string& text, std::size_t at) {
  char quote = '\0';
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (quote == '\0' && c == '>') return at;
    if (c == quote) {
      quote = '\0';
    } else if (quote == '\0' && (c == '"' || c == '\'')) {
      quote = c;
    }
  }
  return std::string::npos;
}

}  // namespace

void require_shallow(const fs::path& file, const std::string& text) {
  constexpr int kDeepest = 100;
  const std::string_view view = text;
  int depth = 0;
  std::size_t at = text.find('<');
  while (at != std::string::npos) {
    std::size_t end = 0;
    if (view.substr(at).starts_with("<!--")) {
      end = text.find("-->", at);
    } else if (view.substr(at).starts_with("<![CDATA[")) {
      end = text.find("]]>", at);
    } else {
      end = end_of_tag(text, at);
      if (end == std::string::npos) return;  // no XML
      const char first = text[at + 1];
      if (first == '/') --depth;
      if (first != '/' && first != '?' && first != '!' && text[end - 1] != '/') ++depth;
    }
    if (depth > kDeepest) {
      const auto line =
          std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
      refuse(file, fmt::format("line {}", line + 1), "an element within 100 others",
             "a file that is nested less");
    }
    at = end == std::string::npos ? end : text.find('<', end);
  }
}

void check_structure(const fs::path& file, const TiXmlElement& robot) {
  constexpr std::size_t kMostLinks = 1000;
  if (robot.NextSiblingElement("robot") != nullptr) refuse(file, "robot", "two", "one robot");
  const Named links = named_elements(file, robot, "link");
  const Named joints = named_elements(file, robot, "joint");
  if (links.empty()) refuse(file, "link", "nothing", "one link or more");
  if (links.size() > kMostLinks) {
    refuse(file, "link", fmt::format("{} links", links.size()),
           fmt::format("at most {}", kMostLinks));
  }
  for (const auto& [name, link] : links) check_link(file, *link, fmt::format("link[{}]", name));
  check_tree(file, links, joints);
}

}  // namespace maxwrench
