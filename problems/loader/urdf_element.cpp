#include "problems/loader/urdf_element.h"

#include <fmt/format.h>

#include <cmath>
#include <locale>
#include <sstream>

#include "problems/loader/bad_input.h"

namespace maxwrench {

UrdfElement UrdfElement::with_name() const {
  const std::optional<std::string> name = attribute("name");
  if (name && !name->empty()) return {*file_, *xml_, fmt::format("{}[{}]", tag(), *name)};
  maxwrench::throw_bad_input(*file_, fmt::format("line {}: {}.name", xml_->GetLineNum(), tag()),
                             name ? "''" : "nothing", "a name");
}

UrdfElement UrdfElement::child(const char* tag) const {
  const std::vector<UrdfElement> all = children(tag);
  if (all.size() == 1) return all.front();
  throw_bad_input(tag, all.empty() ? "nothing" : fmt::format("{} elements", all.size()),
                  fmt::format("one <{}>", tag));
}

std::optional<UrdfElement> UrdfElement::child_if_any(const char* tag) const {
  const std::vector<UrdfElement> all = children(tag);
  if (all.empty()) return std::nullopt;
  if (all.size() == 1) return all.front();
  throw_bad_input(tag, fmt::format("{} elements", all.size()),
                  fmt::format("one <{}> at most", tag));
}

std::vector<UrdfElement> UrdfElement::children(const char* tag) const {
  std::vector<UrdfElement> all;
  const tinyxml2::XMLElement* next = xml_->FirstChildElement(tag);
  for (; next != nullptr; next = next->NextSiblingElement(tag)) {
    all.emplace_back(*file_, *next, fmt::format("{}.{}", key_, next->Name()));
  }
  return all;
}

std::optional<std::string> UrdfElement::attribute(const char* name) const {
  const char* text = xml_->Attribute(name);
  return text == nullptr ? std::nullopt : std::optional<std::string>(text);
}

double UrdfElement::number(const char* name, std::optional<double> otherwise) const {
  if (otherwise && !attribute(name)) return *otherwise;
  return numbers(name, 1)[0];
}

Eigen::Vector3d UrdfElement::vector(const char* name,
                                    const std::optional<Eigen::Vector3d>& otherwise) const {
  if (otherwise && !attribute(name)) return *otherwise;
  return numbers(name, 3);
}

Eigen::VectorXd UrdfElement::numbers(const char* name, int count) const {
  const std::optional<std::string> text = attribute(name);
  std::istringstream stream(text.value_or(""));
  stream.imbue(std::locale::classic());
  Eigen::VectorXd values(count);
  bool good = true;
  for (double& value : values) good = good && stream >> value && std::isfinite(value);
  if (good && (stream >> std::ws).eof()) return values;
  throw_bad_input(name, text ? fmt::format("'{}'", *text) : "nothing",
                  count == 1 ? "a finite number" : fmt::format("{} finite numbers", count));
}

void UrdfElement::throw_bad_input(std::string_view attribute, std::string_view got,
                                  std::string_view expected) const {
  const std::string key = attribute.empty() ? key_ : fmt::format("{}.{}", key_, attribute);
  maxwrench::throw_bad_input(*file_, key, got, expected);
}

}  // namespace maxwrench
