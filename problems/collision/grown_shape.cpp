#include "problems/collision/grown_shape.h"

#include "problems/collision/shapes.h"

#ifndef __EMSCRIPTEN__
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#endif

namespace maxwrench {
namespace {

#ifdef __EMSCRIPTEN__

class Grown final : public GrownShape {
 public:
  Grown(const Shape& shape, double margin) : grown_(rounded_core(shape)) {
    switch (shape.kind) {
      case Shape::Kind::kCapsule:
        grown_.rounding += margin;
        break;
      case Shape::Kind::kCylinder:
        grown_.core.half_sizes.z() += margin;
        grown_.core.disc_radius += margin;
        break;
      case Shape::Kind::kBox:
      case Shape::Kind::kHull:  // is not grown
        grown_.core.half_sizes.array() += margin;
        break;
    }
  }

  bool intersects(const Pose<double>& pose, const GrownShape& other,
                  const Pose<double>& other_pose) const override {
    const RoundedCore& b = static_cast<const Grown&>(other).grown_;
    return closer_than(grown_.core, pose, b.core, other_pose, grown_.rounding + b.rounding);
  }

 private:
  RoundedCore grown_;
};

#else

using Geometry = fcl::CollisionGeometryd;

std::unique_ptr<const Geometry> geometry(const Shape& shape, double margin) {
  const double r = shape.radius + margin;
  const double length = 2 * shape.half_length;
  const Eigen::Vector3d sides = 2 * (shape.half_sizes.array() + margin).matrix();
  switch (shape.kind) {
    case Shape::Kind::kCapsule:
      if (length == 0) return std::make_unique<fcl::Sphered>(r);
      return std::make_unique<fcl::Capsuled>(r, length);
    case Shape::Kind::kCylinder:
      return std::make_unique<fcl::Cylinderd>(r, length + 2 * margin);
    case Shape::Kind::kBox:
    case Shape::Kind::kHull:  // is not grown
      break;
  }
  return std::make_unique<fcl::Boxd>(sides.x(), sides.y(), sides.z());
}

fcl::Transform3d to_fcl(const Pose<double>& pose) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  transform.linear() = pose.R;
  transform.translation() = pose.p;
  return transform;
}

class Grown final : public GrownShape {
 public:
  Grown(const Shape& shape, double margin) : geometry_(geometry(shape, margin)) {}

  bool intersects(const Pose<double>& pose, const GrownShape& other,
                  const Pose<double>& other_pose) const override {
    const Geometry& b = *static_cast<const Grown&>(other).geometry_;
    const fcl::CollisionRequestd request;  // only whether they collide, by libccd
    fcl::CollisionResultd result;
    return fcl::collide(geometry_.get(), to_fcl(pose), &b, to_fcl(other_pose), request, result) > 0;
  }

 private:
  std::unique_ptr<const Geometry> geometry_;
};

#endif

}  // namespace

std::shared_ptr<const GrownShape> make_grown_shape(const Shape& shape, double margin) {
  return std::make_shared<Grown>(shape, margin);
}

}  // namespace maxwrench
