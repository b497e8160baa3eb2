#pragma once

#include <tinyxml2.h>

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace maxwrench {

/// An element of a URDF file. Its key, such as `link[hull].inertial`, is how messages name it. It
/// lives as long as its document and the path of the file.
class UrdfElement {
 public:
  UrdfElement(const std::filesystem::path& file, const tinyxml2::XMLElement& xml, std::string key)
      : file_(&file), xml_(&xml), key_(std::move(key)) {}

  std::string tag() const { return xml_->Name(); }

  /// A link or joint with its name in the key, `link[hull]`. Rejects one without a name.
  UrdfElement with_name() const;

  /// The only child with this tag. Rejects none and several.
  UrdfElement child(const char* tag) const;
  /// Nothing if there is none. Rejects several.
  std::optional<UrdfElement> child_if_any(const char* tag) const;
  /// All children, or those with this tag, in the order of the file.
  std::vector<UrdfElement> children(const char* tag = nullptr) const;

  /// The text of an attribute, or nothing.
  std::optional<std::string> attribute(const char* name) const;
  /// Rejects all but a finite number, and an attribute that is not there unless there is a value to
  /// take instead.
  double number(const char* name, std::optional<double> otherwise = {}) const;
  /// The same of three numbers.
  Eigen::Vector3d vector(const char* name,
                         const std::optional<Eigen::Vector3d>& otherwise = {}) const;

  /// Throws the line of `bad_input.h` about this element or, if it is named, an attribute.
  [[noreturn]] void throw_bad_input(std::string_view attribute, std::string_view got,
                                    std::string_view expected) const;

 private:
  Eigen::VectorXd numbers(const char* name, int count) const;

  const std::filesystem::path* file_;
  const tinyxml2::XMLElement* xml_;
  std::string key_;
};

}  // namespace maxwrench
