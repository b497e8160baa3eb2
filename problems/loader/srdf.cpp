#include "problems/loader/srdf.h"

#include <tinyxml2.h>

#include "problems/loader/bad_input.h"
#include "problems/loader/urdf_structure.h"

namespace maxwrench {
namespace {

std::string text_of(const UrdfElement& element, const char* name) {
  const std::optional<std::string> text = element.attribute(name);
  if (text) return *text;
  element.throw_bad_input(name, "nothing", "a name");
}

}  // namespace

Srdf read_srdf(const std::filesystem::path& file) {
  tinyxml2::XMLDocument document;
  const UrdfElement robot = parse_robot(file, document);
  Srdf srdf;
  for (const UrdfElement& pair : robot.children("disable_collisions")) {
    srdf.ignore.emplace_back(text_of(pair, "link1"), text_of(pair, "link2"));
  }
  for (const UrdfElement& state : robot.children("group_state")) {
    auto& positions = srdf.states[text_of(state, "name")];
    for (const UrdfElement& joint : state.children("joint")) {
      // A joint of several axes has several numbers; the base moves by other means.
      const std::string value = text_of(joint, "value");
      if (value.find_first_of(" \t") != std::string::npos) continue;
      positions[text_of(joint, "name")] = joint.number("value");
    }
  }
  return srdf;
}

}  // namespace maxwrench
