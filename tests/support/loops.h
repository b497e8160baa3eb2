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

// Postures whose joints follow by equations.

namespace maxwrench {

inline const std::vector<const char*> kLoopProblems = {
    "mobile/push",        "fixed/push",      "mobile/push_any_height",
    "dual_arm/bar_alone", "random, fixed",   "random, x",
    "random, yaw",        "random, x y yaw", "random, x y z yaw",
    "random, free tool",  "planar/two_arms", "dual_arm/bar_wall"};

/// The last, whose second contact bears forces.
constexpr std::ptrdiff_t kLoopProblemsWithForces = 2;

/// A shipped problem, or a random one with these free axes of the base.
Problem loop_problem(const std::string& name);

/// The name of a parameter of kLoopProblems as one of a test.
std::string loop_name(const testing::TestParamInfo<const char*>& of);

/// The coordinates x of a posture, with w of the second contact at the value t, within the limits
/// of x as far as whole turns bring them there.
Eigen::VectorXd loop_coordinates(const Problem& problem, const LoopCoordinates& coordinates,
                                 const Posture& posture, const Eigen::VectorXd& w, double t);

/// A posture that is valid, with its coordinates and its value.
struct ValuedPosture {
  Eigen::VectorXd x;
  double value = -kInfinity;
};

/// Draws postures of a problem, which outlives it, in all IK solutions.
class PostureSource {
 public:
  PostureSource(const Problem& problem, const std::string& measure);

  /// Null if there is none at a random theta_r, or it has no value.
  const ValuedPosture* draw(Random& random);
  const LoopCoordinates& coordinates() const { return coordinates_; }
  /// Of the last draw.
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
