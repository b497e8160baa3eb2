#include "problems/loader/urdf_document.h"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <tinyxml.h>
#include <urdf_parser/urdf_parser.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <locale>
#include <mutex>
#include <sstream>
#include <string_view>

#include "problems/loader/bad_input.h"
#include "problems/loader/urdf_structure.h"

namespace maxwrench {
namespace {

/// Keeps what urdfdom would print; the first line says what is wrong.
class FirstError : public console_bridge::OutputHandler {
 public:
  FirstError() { console_bridge::useOutputHandler(this); }
  ~FirstError() override { console_bridge::restorePreviousOutputHandler(); }
  FirstError(const FirstError&) = delete;
  FirstError& operator=(const FirstError&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && text_.empty()) text_ = text;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

struct NumberAttribute {
  std::string_view element, attribute;
  int count;
  bool required;
};

constexpr NumberAttribute kNumberAttributes[] = {
    {"origin", "xyz", 3, false},     {"origin", "rpy", 3, false},
    {"axis", "xyz", 3, true},        {"limit", "lower", 1, false},
    {"limit", "upper", 1, false},    {"limit", "effort", 1, true},
    {"limit", "velocity", 1, true},  {"mass", "value", 1, true},
    {"inertia", "ixx", 1, true},     {"inertia", "ixy", 1, true},
    {"inertia", "ixz", 1, true},     {"inertia", "iyy", 1, true},
    {"inertia", "iyz", 1, true},     {"inertia", "izz", 1, true},
    {"box", "size", 3, true},        {"sphere", "radius", 1, true},
    {"cylinder", "radius", 1, true}, {"cylinder", "length", 1, true},
};

bool are_finite_numbers(const char* text, int count) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  for (int i = 0; i < count; ++i) {
    double value = 0;
    if (!(stream >> value) || !std::isfinite(value)) return false;
  }
  return (stream >> std::ws).eof();
}

/// urdfdom names neither file nor link when a number is bad, so numbers are checked before it. Only
/// links and joints: other blocks, such as <gazebo>, have their own rules.
void check_numbers(const std::filesystem::path& file, const TiXmlElement& element,
                   const std::string& path) {
  for (const NumberAttribute& known : kNumberAttributes) {
    if (element.ValueStr() != known.element) continue;
    const char* text = element.Attribute(known.attribute.data());
    if (text == nullptr && !known.required) continue;
    if (text != nullptr && are_finite_numbers(text, known.count)) continue;
    refuse(file, fmt::format("{}.{}", path, known.attribute),
           text == nullptr ? "nothing" : fmt::format("'{}'", text),
           known.count == 1 ? "a finite number" : fmt::format("{} finite numbers", known.count));
  }
  const bool root = path == "robot";
  const TiXmlElement* child = element.FirstChildElement();
  for (; child != nullptr; child = child->NextSiblingElement()) {
    if (root && child->ValueStr() != "link" && child->ValueStr() != "joint") continue;
    const char* name = child->Attribute("name");
    const std::string label =
        name == nullptr ? child->ValueStr() : fmt::format("{}[{}]", child->ValueStr(), name);
    check_numbers(file, *child, root ? label : path + "." + label);
  }
}

urdf::ModelInterfaceSharedPtr parse(const std::filesystem::path& file, const std::string& text) {
  static std::mutex mutex;  // console_bridge has one handler for the whole process
  const std::lock_guard<std::mutex> lock(mutex);
  const FirstError error;
  urdf::ModelInterfaceSharedPtr model;
  std::string reason;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::exception& exception) {
    reason = exception.what();
  }
  if (!error.text().empty()) reason = error.text();
  if (model == nullptr) refuse(file, "robot", fmt::format("'{}'", reason), "a valid URDF");
  return model;
}

}  // namespace

UrdfDocument read_urdf_document(const std::filesystem::path& file) {
  std::ifstream stream = open_file(file, "a URDF file");
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  require_shallow(file, text);
  TiXmlDocument xml;
  xml.Parse(text.c_str());
  if (xml.Error()) {
    refuse(file, fmt::format("line {}", xml.ErrorRow()), fmt::format("'{}'", xml.ErrorDesc()),
           "valid XML");
  }
  const TiXmlElement* robot = xml.FirstChildElement("robot");
  if (robot == nullptr) refuse(file, "robot", "nothing", "an element <robot>");
  check_numbers(file, *robot, "robot");
  check_structure(file, *robot);
  UrdfDocument document{parse(file, text), {}};
  const TiXmlElement* joint = robot->FirstChildElement("joint");
  for (; joint != nullptr; joint = joint->NextSiblingElement("joint")) {
    const int position = static_cast<int>(document.joint_order.size());
    document.joint_order.emplace(joint->Attribute("name"), position);
  }
  return document;
}

}  // namespace maxwrench
