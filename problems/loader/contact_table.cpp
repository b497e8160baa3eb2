#include "problems/loader/contact_table.h"

#include "problems/loader/urdf_tree.h"

namespace maxwrench {
namespace {

Surface read_surface(const Block& block) {
  const std::string name = block.text("surface", "point");
  if (name == "point") return Surface::kPoint;
  if (name == "line") return Surface::kLine;
  if (name == "plane") return Surface::kPlane;
  if (name == "circle") return Surface::kCircle;
  block.throw_bad_value("surface", "point, line, plane or circle");
}

ContactSpec::Direction read_direction(const Block& block) {
  block.allow_only({"direction", "min", "max"});
  return {block.numbers("direction", 6), block.number("min", -kInfinity),
          block.number("max", kInfinity)};
}

}  // namespace

ContactSpec read_contact(const Block& block) {
  block.allow_only({"end_effector", "forces", "mu", "basis", "surface", "xyz", "rpy", "radius",
                    "min", "max", "default", "joints", "rest", "length_scale", "sigma_min"});
  ContactSpec contact;
  contact.end_effector = block.text("end_effector");
  contact.forces = block.text("forces");
  if (block.has("mu")) contact.mu = block.number("mu");
  for (const Block& each : block.list("basis")) contact.basis.push_back(read_direction(each));
  contact.surface = read_surface(block);
  contact.frame = pose_from_xyz_rpy(block.vector("xyz"), block.vector("rpy"));
  if (block.has("radius")) contact.radius = block.number("radius");
  contact.min = block.any_numbers("min");
  contact.max = block.any_numbers("max");
  contact.initial = block.any_numbers("default");
  contact.joints = block.texts("joints");
  contact.rest = block.table("rest").numbers_by_name();
  contact.length_scale = block.number("length_scale", contact.length_scale);
  contact.sigma_min = block.number("sigma_min", contact.sigma_min);
  return contact;
}

}  // namespace maxwrench
