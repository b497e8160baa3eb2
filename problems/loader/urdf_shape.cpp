#include "problems/loader/urdf_shape.h"

#include <fmt/format.h>

#include <algorithm>

#include "problems/loader/urdf_tree.h"

namespace maxwrench {
namespace {

/// The shape of an element of `geometry`, or why there is none.
struct Given {
  std::optional<Shape> shape;
  std::string why;
};

Given read_round(const UrdfElement& given) {
  const std::string tag = given.tag();
  Shape shape;
  shape.radius = given.number("radius");
  if (tag != "sphere") shape.half_length = given.number("length") / 2;
  if (tag == "cylinder") shape.kind = Shape::Kind::kCylinder;
  const bool flat = tag == "cylinder" ? !(shape.half_length > 0) : shape.half_length < 0;
  if (!(shape.radius > 0) || flat) return {{}, fmt::format("a {} without size", tag)};
  return {shape, ""};
}

Given read_box(const UrdfElement& given) {
  Shape shape;
  shape.kind = Shape::Kind::kBox;
  shape.half_sizes = given.vector("size") / 2;
  if (!(shape.half_sizes.minCoeff() > 0)) return {{}, "a box without size"};
  return {shape, ""};
}

Given mesh_of(const UrdfElement& given, MeshUse meshes, MeshReading& reading) {
  const std::optional<std::string> name = given.attribute("filename");
  if (!name) given.throw_bad_input("filename", "nothing", "the name of a mesh");
  const Eigen::Vector3d scale = given.vector("scale", Eigen::Vector3d::Ones());
  if (!scale.all()) {
    given.throw_bad_input("scale", given.attribute("scale").value(), "numbers other than 0");
  }
  const MeshShape mesh = reading.shapes.shape(*name, scale, meshes);
  if (!mesh.shape) return {{}, mesh.note};
  const std::string file = mesh.file.string();
  if (std::find(reading.files.begin(), reading.files.end(), file) == reading.files.end()) {
    reading.files.push_back(file);
  }
  const char* mirrored = scale.prod() < 0 ? ", mirrored by its scale" : "";
  reading.notes.push_back(fmt::format("{}: {}: {}{}", given.key(), file, mesh.note, mirrored));
  return {mesh.shape, ""};
}

Given read_geometry(const UrdfElement& given, MeshUse meshes, MeshReading& reading) {
  const std::string tag = given.tag();
  if (tag == "box") return read_box(given);
  if (tag == "cylinder" || tag == "sphere" || tag == "capsule") return read_round(given);
  if (tag == "mesh") return mesh_of(given, meshes, reading);
  return {{}, fmt::format("<{}>", tag)};
}

/// Elements of `collision` that stand one level too deep.
bool is_misplaced(const UrdfElement& element) {
  return element.tag() == "origin" || element.tag() == "material";
}

}  // namespace

std::optional<Shape> read_shape(const UrdfElement& collision, MeshUse meshes,
                                MeshReading& reading) {
  const auto leave_out = [&](const std::string& why) {
    reading.warnings.push_back(fmt::format("{}.geometry: {}: no shape", collision.key(), why));
    return std::optional<Shape>();
  };
  const std::optional<UrdfElement> geometry = collision.child_if_any("geometry");
  std::vector<UrdfElement> shapes = geometry ? geometry->children() : std::vector<UrdfElement>();
  if (shapes.size() > 1) std::erase_if(shapes, is_misplaced);
  if (shapes.empty()) return leave_out("nothing");
  if (shapes.size() > 1) {
    geometry->throw_bad_input("", fmt::format("<{}> and <{}>", shapes[0].tag(), shapes[1].tag()),
                              "one shape");
  }
  if (shapes[0].tag() == "mesh" && meshes == MeshUse::kIgnore) return {};
  Given given = read_geometry(shapes[0], meshes, reading);
  if (!given.shape) return leave_out(given.why);
  given.shape->placement = origin_of(collision) * given.shape->placement;
  return given.shape;
}

}  // namespace maxwrench
