#include <algorithm>
#include <array>

#include "maxwrench/task.h"
#include "python/src/part_values.h"
#include "python/src/parts.h"

namespace maxwrench::python {
namespace {

Surface surface_in(const std::string& key, const std::string& name) {
  static constexpr std::array<const char*, 4> kNames = {"point", "line", "plane", "circle"};
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) throw BadValue(key, shown(name), "point, line, plane or circle");
  return static_cast<Surface>(found - kNames.begin());
}

ContactSpec::Direction make_direction(const std::string& key, const py::handle& object) {
  const Part part(key, object, "Direction");
  return {part.numbers(key + ".direction", "direction", 6), part.number(key + ".min", "min"),
          part.number(key + ".max", "max")};
}

}  // namespace

ContactSpec contact_in(const py::object& value) {
  const Part part("contact", value, "Contact");
  ContactSpec contact;
  contact.end_effector = part.text("contact.end_effector", "end_effector");
  contact.forces = part.text("contact.forces", "forces");
  if (part.has("mu")) contact.mu = part.number("contact.mu", "mu");
  contact.basis = parts_in<ContactSpec::Direction>(
      "contact.basis", part.get("basis"), "a list of maxwrench.Direction", &make_direction);
  contact.surface = surface_in("contact.surface", part.text("contact.surface", "surface"));
  contact.frame = part.pose("contact.frame", "frame");
  if (part.has("radius")) contact.radius = part.number("contact.radius", "radius");
  contact.min = part.numbers("contact.min", "min");
  contact.max = part.numbers("contact.max", "max");
  contact.initial = part.numbers("contact.default", "default");
  contact.joints = names_in("contact.joints", part.get("joints"));
  contact.rest = numbers_by_name("contact.rest", part.get("rest"));
  contact.length_scale = part.number("contact.length_scale", "length_scale");
  contact.sigma_min = part.number("contact.sigma_min", "sigma_min");
  return contact;
}

}  // namespace maxwrench::python
