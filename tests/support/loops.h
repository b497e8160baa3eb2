#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/wrench_program.h"
#include "solvers/certify/bound/loop_posture.h"
#include "tests/support/support.h"

// Postures whose dependent joints satisfy equations.

namespace maxwrench {

inline const std::vector<const char*> kLoopProblems = {
    "mobile/push",        "fixed/push",       "mobile/push_any_height",
    "dual_arm/bar_alone", "random, fixed",    "random, x",
    "random, yaw",        "random, x y yaw",  "random, x y z yaw",
    "random, free tool",  "random, parked",   "planar/two_arms",
    "dual_arm/bar_wall",  "dual_arm/two_arms"};

/// The number of the last ones, whose second contact bears forces.
constexpr std::ptrdiff_t kLoopProblemsWithForces = 3;

/// A shipped problem, or a random one with these free axes of the base.
Problem loop_problem(const std::string& name);

/// An arm of five joints on a parked base that moves along x, y and yaw. The first joint turns
/// about the base's yaw axis, downwards; it and the last one are redundant.
Problem parked_problem(Random& random);

/// The name of a parameter of kLoopProblems as the name of a test.
std::string loop_name(const testing::TestParamInfo<const char*>& of);

/// The coordinates x of a posture, with w of the second contact at the value t. Angles are shifted
/// by whole turns into the limits of x where possible. If the coordinate about the yaw is left out,
/// the yaw is that of the base after it has turned in place of this joint.
Eigen::VectorXd loop_coordinates(const Problem& problem, const LoopCoordinates& coordinates,
                                 const Posture& posture, const Eigen::VectorXd& w, double t);

/// A valid posture with its coordinates and its value.
struct ValuedPosture {
  Eigen::VectorXd x;
  double value = -kInfinity;
};

/// The coordinates that the bound of a measure takes.
ContactForces forces_in_bound(const Problem& problem, const std::string& measure);

/// Draws postures of a problem, which must outlive it, with all IK solutions.
class PostureSource {
 public:
  PostureSource(const Problem& problem, const std::string& measure,
                ContactForces forces = ContactForces::kShares, Wrench wrench = Wrench::kPure);

  /// Null if a random theta_r has no posture, or the posture has no value.
  const ValuedPosture* draw(Random& random);
  const LoopCoordinates& coordinates() const { return coordinates_; }
  /// The program of the last draw.
  const WrenchProgram& program() const { return program_; }
  const Capability& capability() const { return capability_; }

 private:
  const Problem& problem_;
  LoopCoordinates coordinates_;
  PostureEvaluator model_;
  WrenchProgram program_;
  std::unique_ptr<Measure> measure_;
  Capability capability_;
  ValuedPosture posture_;
};

}  // namespace maxwrench
