#pragma once

#include <optional>

#include "lib/scenario/current_load.h"
#include "lib/scenario/scenario_forces.h"
#include "lib/scenario/scenario_list.h"
#include "maxwrench/problem.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {

struct Posture;

/// The wrenches and loads of a list of scenarios at one posture, in world axes.
class ScenarioPosture final : public ScenarioForces {
 public:
  explicit ScenarioPosture(const Problem& problem);
  explicit ScenarioPosture(const Problem&& problem) = delete;

  /// The posture must stay as it is until the next call.
  void set(const Posture& posture);

  const Posture& posture() const override { return *posture_; }
  const Eigen::VectorXd& tau_d() const override;
  void add_load(const LoadCase& load, Eigen::VectorXd& tau) override;
  void exert(const Vector6d& c, Eigen::VectorXd& tau) const override;
  Vector6d wrench(int i) const override;
  Vector6d ball_axis(Eigen::Index i) const override;

 private:
  const Problem& problem_;
  const Posture* posture_ = nullptr;
  std::optional<CurrentLoad> water_;  ///< if a case has a current
  bool in_water_ = false;             ///< whether `water_` is at the posture
  Eigen::VectorXd added_;
};

/// The wrench program of one scenario: W = [c_s] or [c_s, F], where the first coordinate is beta.
/// Or W = [r E, F] with the axes of a ball of radius r, whose coordinates z are then the first
/// ones. The columns C_2 of a second contact follow W, with their limits.
class ScenarioProgram {
 public:
  /// `axes` is the number of axes of the ball; 0: one wrench.
  ScenarioProgram(const Problem& problem, Wrench wrench, int axes = 0);
  ScenarioProgram(const Problem&& problem, Wrench wrench, int axes = 0) = delete;

  /// Sets the program to a scenario, whose wrench is `choice.c` unless it has axes, at a posture.
  /// Returns it.
  const WrenchProgram& write(ScenarioPosture& at, const ScenarioChoice& choice);
  /// The same program, to be maximised (1) or minimised (-1), with beta at most `most`.
  const WrenchProgram& aim(double sign, double most = kInfinity);
  /// The same program with axes, to be maximised along d'z.
  const WrenchProgram& aim_along(const Eigen::Vector2d& d);
  /// Limits the coordinates of the axes to [-most, most], until `write` is called again.
  void cut(double most);

 private:
  const Problem& problem_;
  Eigen::Index first_;  ///< number of columns before F
  bool axes_;           ///< whether these are the axes of the ball
  WrenchProgram program_;
  Matrix6Xd F_;
};

}  // namespace maxwrench
