#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "problems/loader/urdf_element.h"

namespace maxwrench {

/// A URDF file as a tree of links.
struct UrdfStructure {
  std::string root;
  std::map<std::string, UrdfElement> links;
  /// From each link to its children, in the order of the file.
  std::map<std::string, std::vector<UrdfElement>> joints_from;
};

/// Of a link or joint of the structure.
std::string name_of(const UrdfElement& element);

/// The link at one end of a joint: `parent` or `child`.
std::string end_of(const UrdfElement& joint, const char* end);

/// Rejects what is not XML, elements that are nested deeper than the parser goes, another version
/// of URDF than 1.0, links and joints without a name of their own, and what is not one tree of at
/// most 1000 links. `document` holds the elements that the answer refers to, as it does to `file`.
UrdfStructure read_structure(const std::filesystem::path& file, tinyxml2::XMLDocument& document);

}  // namespace maxwrench
