#include "problems/loader/urdf_visual.h"

#include <fmt/format.h>

#include <stdexcept>

#include "problems/loader/urdf_tree.h"

namespace maxwrench {
namespace {

std::optional<std::array<double, 4>> colour_in(const UrdfElement& material) {
  const std::optional<UrdfElement> colour = material.child_if_any("color");
  if (!colour) return {};
  const Eigen::VectorXd rgba = colour->numbers("rgba", 4).cwiseMax(0).cwiseMin(1);
  return std::array<double, 4>{rgba[0], rgba[1], rgba[2], rgba[3]};
}

/// The colour in the visual itself, or that of the material it names.
std::optional<std::array<double, 4>> colour_of(const UrdfElement& visual,
                                               const Materials& materials) {
  const std::optional<UrdfElement> material = visual.child_if_any("material");
  if (!material) return {};
  if (const auto own = colour_in(*material)) return own;
  const auto named = materials.find(material->attribute("name").value_or(""));
  if (named == materials.end()) return {};
  return named->second;
}

/// Sets kind, size and mesh. Returns whether there is such a body.
bool read_body(const UrdfElement& shape, const MeshShapes& meshes, Visual& visual) {
  const std::string tag = shape.tag();
  if (tag == "box") {
    visual.kind = Visual::Kind::kBox;
    visual.size = shape.vector("size");
  } else if (tag == "cylinder") {
    visual.kind = Visual::Kind::kCylinder;
    const double diameter = 2 * shape.number("radius");
    visual.size = {diameter, diameter, shape.number("length")};
  } else if (tag == "sphere") {
    visual.kind = Visual::Kind::kSphere;
    visual.size.setConstant(2 * shape.number("radius"));
  } else if (tag == "mesh") {
    visual.size = shape.vector("scale", Eigen::Vector3d::Ones());
    visual.mesh = meshes.find(shape.attribute("filename").value_or("")).file.string();
    return !visual.mesh.empty();
  } else {
    return false;
  }
  return visual.size.minCoeff() > 0;
}

}  // namespace

Materials read_materials(const UrdfElement& robot) {
  Materials materials;
  for (const UrdfElement& material : robot.children("material")) {
    const std::optional<std::string> name = material.attribute("name");
    if (!name) continue;
    try {
      if (const auto colour = colour_in(material)) materials[*name] = *colour;
    } catch (const std::invalid_argument&) {  // a colour changes no result
    }
  }
  return materials;
}

std::vector<Visual> read_visuals(const UrdfElement& link, const Materials& materials,
                                 const MeshShapes& meshes, std::vector<std::string>& notes) {
  std::vector<Visual> visuals;
  for (const UrdfElement& element : link.children("visual")) {
    try {
      const std::optional<UrdfElement> geometry = element.child_if_any("geometry");
      const std::vector<UrdfElement> shapes =
          geometry ? geometry->children() : std::vector<UrdfElement>();
      Visual visual;
      if (shapes.empty() || !read_body(shapes.front(), meshes, visual)) continue;
      visual.placement = origin_of(element);
      visual.colour = colour_of(element, materials);
      visuals.push_back(visual);
    } catch (const std::invalid_argument& error) {
      notes.push_back(fmt::format("{}: not shown: {}", element.key(), error.what()));
    }
  }
  return visuals;
}

}  // namespace maxwrench
