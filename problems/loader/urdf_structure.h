#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "problems/loader/urdf_element.h"
#include "problems/loader/urdf_visual.h"

namespace maxwrench {

/// A URDF file as a tree of links.
struct UrdfStructure {
  std::string name;  ///< of the element <robot>; may be empty
  std::string root;
  std::map<std::string, UrdfElement> links;
  std::vector<UrdfElement> joints;  ///< in the order of the file
  /// The joints from each link to its children, in the order of the file.
  std::map<std::string, std::vector<UrdfElement>> joints_from;
  Materials materials;
};

/// The element <robot> of a URDF or SRDF file. Rejects a file that is not XML.
UrdfElement parse_robot(const std::filesystem::path& file, tinyxml2::XMLDocument& document);

/// The name of a link or joint of the structure.
std::string name_of(const UrdfElement& element);

/// The link at one end of a joint; `end` is `parent` or `child`.
std::string end_of(const UrdfElement& joint, const char* end);

/// Rejects text that is not XML, elements that are nested too deeply for the parser, URDF versions
/// other than 1.0, links and joints without a unique name, and structures that are not one tree of
/// at most 1000 links. A file in xacro's language is expanded by the program xacro, if it is
/// installed. The result refers to `document` and `file`, which must outlive it.
///
/// Adds a line to `notes` that counts the elements which are not read.
UrdfStructure read_structure(const std::filesystem::path& file, tinyxml2::XMLDocument& document,
                             std::vector<std::string>& notes);

}  // namespace maxwrench
