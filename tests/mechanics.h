#pragma once

#include "lib/robot.h"

namespace maxwrench {

/// The base moved by `step` along velocity number i, in base axes, or the joint likewise.
void move(const Robot& robot, int i, double step, Pose<double>& base, Eigen::VectorXd& q);

/// [J] of weights, buoyancy and trim, body by body.
double potential_energy(const Robot& robot, const Pose<double>& base, const Eigen::VectorXd& q);

/// The derivative of the potential energy along each velocity, by central differences: what
/// tau_d at rest must be.
Eigen::VectorXd potential_energy_slopes(const Robot& robot, const Pose<double>& base,
                                        const Eigen::VectorXd& q, double step);

}  // namespace maxwrench
