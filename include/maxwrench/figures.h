#pragma once

#include <string>
#include <vector>

#include "maxwrench/tank.h"
#include "maxwrench/types.h"

/// @file
/// Figures as SVG: postures, wrench sets, trajectories and experiments.

namespace maxwrench {

struct CapabilityMap;
struct Front;
struct MotionMargin;
struct Trajectory;
struct Problem;

/// One posture of a figure.
struct Panel {
  std::string title;        ///< the title; "beta" in it is replaced by the Greek letter
  Eigen::VectorXd theta_r;  ///< the posture (r)
};

/// Draws a robot in one or several postures with its wrench sets.
///
/// It is the paper's fig:polytopes (one panel) or fig:optimalpolytopes (several panels). Each panel
/// shows the robot, the direction c and four sets of forces around the end effector:
///
/// * the ellipsoid, the L2 polytope and the L-infinity polytope of the forces without any other
///   wrench component;
/// * the L-infinity polytope of the forces that occur together with any allowed wrench.
///
/// If c is not a force along the plane seen from above or from the side, the result is that
/// of `posture_figure`.
///
/// @param problem  the task
/// @param panels   the postures
/// @return the SVG document
/// @throws std::invalid_argument if a theta_r has no posture.
std::string figure(const Problem& problem, const std::vector<Panel>& panels);

/// Draws postures from two sides, without wrench sets.
///
/// @param problem  the task
/// @param panels   the postures
/// @return the SVG document
/// @throws std::invalid_argument if a theta_r has no posture.
std::string posture_figure(const Problem& problem, const std::vector<Panel>& panels);

/// One curve of c'h_e over time; the planned wrench is dashed.
struct TankCurve {
  std::string name;    ///< the legend
  const TankRun* run;  ///< the experiment, which must outlive the curve
};
/// Draws static experiments in one picture, the paper's fig:staticTorque.
///
/// @param problem  the task
/// @param curves   the experiments
/// @return the SVG document
/// @throws std::invalid_argument if a run has no samples, or readings that are not finite.
std::string tank_figure(const Problem& problem, const std::vector<TankCurve>& curves);

/// Draws experiments of a task in time, all over time.
///
/// It shows the angle of the end effector (except for an impulse, where it rests), and the readings
/// along c with the planned wrench. For each run it shows the thruster forces with their limits,
/// and theta_r.
///
/// @param problem  the task
/// @param curves   the experiments
/// @return the SVG document
/// @throws std::invalid_argument if a run has no samples, or readings that are not finite.
std::string motion_figure(const Problem& problem, const std::vector<TankCurve>& curves);

/// Draws the robot along a trajectory, from two sides.
///
/// @param problem     the task
/// @param trajectory  an evaluated trajectory; it must have instants, so it must not be an invalid
///                    posture
/// @param times       times [s]; the figure shows the instants closest to them
/// @return the SVG document; its titles give the angle by which the end effector has turned, or the
///         time
std::string trajectory_figure(const Problem& problem, const Trajectory& trajectory,
                              const std::vector<double>& times);

/// Draws a capability map.
///
/// One coordinate gives a curve, or a rose of an azimuth. Two give a heat map, three give points in
/// space; the colour is the value. Cells without a value are crosses.
///
/// @param map  the map
/// @return the SVG document
/// @throws std::invalid_argument for more than three coordinates, one or two with a single value,
///         or if no cell has a value.
std::string map_figure(const CapabilityMap& map);

/// Draws the front of two tasks: the values of its postures, and what is proven beyond them.
///
/// @param front  the front
/// @return the SVG document
/// @throws std::invalid_argument if it has no points.
std::string front_figure(const Front& front);

/// Draws the margins of a motion over time. Instants without a finite margin are crosses, the least
/// margin is a dot.
///
/// @param margin  the margins
/// @return the SVG document
/// @throws std::invalid_argument if no margin is finite and different from zero, or for one
/// instant.
std::string margin_figure(const MotionMargin& margin);

}  // namespace maxwrench
