#pragma once

#include "lib/math/random.h"
#include "maxwrench/robot.h"

namespace maxwrench {

/// A tree of `joints` joints (every third one prismatic) on six base axes with random numbers
/// throughout: full inertias, buoyancy, trim, and bodies with added mass and drag in frames of
/// their own, two on the base and none on link 1.
Robot random_wet_robot(Random& random, int joints);

/// The same without water.
Robot random_dry_robot(Random& random, int joints);

/// Normally distributed numbers.
Eigen::VectorXd random_numbers(Random& random, int size);

/// Moves the base by `step` along velocity number i, in base axes, or a joint likewise.
void move(const Robot& robot, int i, double step, Pose<double>& base, Eigen::VectorXd& q);

/// Potential energy [J] of weights, buoyancy and trim, body by body.
double potential_energy(const Robot& robot, const Pose<double>& base, const Eigen::VectorXd& q);

/// The derivative of the potential energy along each velocity, by central differences; tau_d at
/// rest must equal it.
Eigen::VectorXd potential_energy_slopes(const Robot& robot, const Pose<double>& base,
                                        const Eigen::VectorXd& q, double step);

/// Kinetic energy [J] at the velocity v, body by body: masses at their centres, inertias about
/// them, and added mass in each body's own frame.
double kinetic_energy(const Robot& robot, const Eigen::VectorXd& q, const Eigen::VectorXd& v);

/// The power [W] that the drag of all bodies, each in its own frame, takes at the velocity v from a
/// motion along `u`.
double drag_power(const Robot& robot, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                  const Eigen::VectorXd& u);

}  // namespace maxwrench
