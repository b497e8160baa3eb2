#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "maxwrench/robot.h"
#include "problems/loader/srdf.h"
#include "problems/loader/urdf_choices.h"
#include "problems/loader/urdf_tree.h"

namespace maxwrench {

using LinkPairs = std::vector<std::pair<std::string, std::string>>;

/// What the SRDF of a robot adds to its URDF, if there is one.
class RobotSrdf {
 public:
  /// @param file  the SRDF; empty: none
  explicit RobotSrdf(const std::filesystem::path& file);

  /// Chooses the group whose joints alone move.
  ///
  /// @param key      the key of the name, for messages
  /// @param name     the name of the group; empty: all joints move
  /// @param key_rest the key of `rest`
  /// @param rest     a named posture of the SRDF in which the other joints stay; empty: at rest
  /// @param choices  receives the group
  /// @throws BadValue of one of the keys if the SRDF has no such group or posture, or `rest` has no
  ///         group
  void choose_group(std::string_view key, const std::string& name, std::string_view key_rest,
                    const std::string& rest, UrdfChoices& choices) const;

  /// The positions of a named posture, by joint [rad or m]; empty if it has none of that name.
  std::map<std::string, double> posture(const std::string& name) const;

  /// Adds its named postures, its file and what is to be said about it.
  void add_to(const UrdfTree& tree, Robot& robot) const;

  /// The pairs of links that it leaves out.
  LinkPairs ignored_pairs() const { return srdf_ ? srdf_->ignore : LinkPairs(); }

 private:
  std::string file_;
  std::optional<Srdf> srdf_;
};

}  // namespace maxwrench
