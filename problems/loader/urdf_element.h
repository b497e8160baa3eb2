#pragma once

#include <tinyxml2.h>

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace maxwrench {

/// An element of a URDF file. Messages name it by its key, such as `link[hull].inertial`. Its
/// document and the path of its file must outlive it.
class UrdfElement {
 public:
  UrdfElement(const std::filesystem::path& file, const tinyxml2::XMLElement& xml, std::string key)
      : file_(&file), xml_(&xml), key_(std::move(key)) {}

  std::string tag() const { return xml_->Name(); }
  const std::string& key() const { return key_; }

  /// The link or joint with its name in the key, `link[hull]`. Rejects an element without a name.
  UrdfElement with_name() const;

  /// The only child with this tag. Rejects a missing child and several children.
  UrdfElement child(const char* tag) const;
  /// The only child with this tag; empty if there is none. Rejects several children.
  std::optional<UrdfElement> child_if_any(const char* tag) const;
  /// All children, or those with this tag, in the order of the file.
  std::vector<UrdfElement> children(const char* tag = nullptr) const;

  /// The text of an attribute; empty if it is missing.
  std::optional<std::string> attribute(const char* name) const;
  /// A finite number. Rejects any other value, and a missing attribute unless `otherwise` is given.
  double number(const char* name, std::optional<double> otherwise = {}) const;
  /// The same for three numbers.
  Eigen::Vector3d vector(const char* name,
                         const std::optional<Eigen::Vector3d>& otherwise = {}) const;
  /// `count` finite numbers. Rejects any other value and a missing attribute.
  Eigen::VectorXd numbers(const char* name, int count) const;

  /// Throws the error of `bad_input.h` about this element or, if `attribute` is not empty, about
  /// that attribute.
  [[noreturn]] void throw_bad_input(std::string_view attribute, std::string_view got,
                                    std::string_view expected) const;

 private:
  const std::filesystem::path* file_;
  const tinyxml2::XMLElement* xml_;
  std::string key_;
};

}  // namespace maxwrench
