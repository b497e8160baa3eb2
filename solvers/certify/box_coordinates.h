#pragma once

#include <string>
#include <vector>

#include "maxwrench/objective.h"
#include "maxwrench/posture.h"
#include "solvers/certify/good_postures.h"

namespace maxwrench {

/// The coordinates of the boxes in which a static task is bounded (`LoopCoordinates`):
///
///     x = [theta_r; dependent joints; joints of a second arm; yaw of the base].
///
/// The yaw is a coordinate if it is free and the pose of the base has no closed form.
class BoxCoordinates {
 public:
  /// Keeps a reference to the problem.
  explicit BoxCoordinates(const Problem& problem);
  explicit BoxCoordinates(const Problem&&) = delete;

  int count() const { return static_cast<int>(joints_.size()); }
  std::string name(int i) const;
  const char* unit(int i) const;  ///< "rad" or "m"
  /// Whether the limits of a coordinate are the same place, a turn apart.
  std::vector<char> turns() const;
  double lower(int i) const { return lower_[i]; }
  double upper(int i) const { return upper_[i]; }

  /// The coordinates of a posture.
  Eigen::VectorXd of(const Posture& posture) const;
  /// The same place with angles within the limits of boxes, which are at most a turn apart.
  Eigen::VectorXd within_a_turn(Eigen::VectorXd x) const;

 private:
  const Problem& problem_;
  std::vector<int> joints_;  ///< that each coordinate moves; -1: none
  std::vector<char> angles_;
  Eigen::VectorXd lower_, upper_;  ///< of boxes
};

/// Makes the function of `GoodOptions::make_postures`: one posture for each IK solution at theta_r
/// that the measure has a verified value for. The problem must outlive it.
std::function<PosturesAt()> make_all_postures(const Problem& problem, Wrench wrench,
                                              const MeasureMaker& make_measure);

}  // namespace maxwrench
