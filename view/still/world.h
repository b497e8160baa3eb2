#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "view/still/painter.h"

namespace maxwrench {

/// A few words at a place of the picture.
struct Note {
  std::string name, value;  ///< "rear left", "-40 N"
  Eigen::Vector3d at;       ///< as the camera sees it [m]
  std::string colour;
  bool bold = false;
  double weight = 0;  ///< the heaviest ones have their places first
};

/// A frame of a scene as the camera sees it [m].
struct Still {
  std::vector<Face> faces;
  std::vector<Note> notes;
  std::vector<std::vector<Eigen::Vector2d>> shadows;  ///< on the floor
  std::vector<Eigen::Vector3d> floor;  ///< the ends of the lines of its grid, two for each
};

/// Draws frames of a scene as the page of `view` does, with its colours and scales.
class StillWorld {
 public:
  /// @param scene      as `scene_of` makes it; it must outlive the world
  /// @param frames     the frames that will be drawn; they give the scales
  StillWorld(const nlohmann::ordered_json& scene,
             const std::vector<const nlohmann::ordered_json*>& frames);

  Still draw(const nlohmann::ordered_json& frame) const;

  double grid_step() const { return step_; }  ///< m
  bool shows_force() const { return most_force_ > 1e-6; }
  /// "force", "torque", or empty: what the sets of wrenches are of.
  const std::string& shown_set() const { return shown_set_; }
  double force_metres() const { return force_metres_; }    ///< of 1 N of the wrench
  double thrust_metres() const { return thrust_metres_; }  ///< of 1 N of a thruster; 0: none

 private:
  struct Body {
    std::size_t link;
    Solid solid;
    Rgb colour;
    double opacity;
  };

  Eigen::AlignedBox3d box_of(const nlohmann::ordered_json& frame) const;
  void draw_links(const nlohmann::ordered_json& frame, Painter& painter, Still& still) const;
  void draw_efforts(const nlohmann::ordered_json& frame, Painter& painter, Still& still) const;
  void draw_wrenches(const nlohmann::ordered_json& frame, Painter& painter, Still& still) const;
  void draw_sets(const nlohmann::ordered_json& frame, Painter& painter, Still& still) const;
  void draw_contact(Painter& painter) const;
  void draw_floor(const Eigen::AlignedBox3d& robot, const Painter& painter, Still& still) const;
  double joint_radius(std::size_t joint) const;

  const nlohmann::ordered_json& scene_;
  Camera camera_;
  std::vector<Body> bodies_;
  double size_ = 1, floor_ = 0, step_ = 1;
  double set_metres_ = 0, force_metres_ = 0, thrust_metres_ = 0;
  double most_force_ = 0, most_torque_ = 0;
  std::string shown_set_;
};

}  // namespace maxwrench
