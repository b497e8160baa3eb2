#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "maxwrench/trajectory.h"
#include "maxwrench/types.h"

/// @file
/// Motions from anywhere: tables of coordinates over time.

namespace maxwrench {

struct Problem;

/// The largest number of instants of a motion.
inline constexpr long kMostMotionInstants = 1'000'000;

/// A motion of a robot as a table of N rows of d coordinates.
///
/// A coordinate is a joint by its name [rad or m], or one of the base: `base_x`, `base_y`, `base_z`
/// [m], `base_roll`, `base_pitch`, `base_yaw` [rad], which give its pose in the world with
/// R = Rz(yaw) Ry(pitch) Rx(roll).
struct MotionTable {
  std::vector<std::string> names;  ///< the coordinates (d)
  std::vector<double> t;           ///< increasing times [s] (N), two or more
  Eigen::MatrixXd values;          ///< the coordinates (N×d)
  /// Their time derivatives (N×d); empty: those of a spline.
  ///
  /// The spline is cubic through all rows. Its slopes at the ends are those of the cubics through
  /// the first and the last four rows.
  Eigen::MatrixXd rates;
  /// Their second derivatives (N×d), beside `rates` only; empty: those of the spline through the
  /// rates or, without these, through the coordinates.
  Eigen::MatrixXd accelerations;
  /// How many instants there are for each row but the last; more than one without `rates` only.
  int instants_per_interval = 1;
  std::vector<int> lines;  ///< for messages: the line of each row in its file; empty: no file
};

/// Returns in words where velocities and accelerations come from.
std::string describe_rates(const MotionTable& table);

/// Makes a table of named columns.
///
/// @param columns  in any order `t` and coordinates and, for all of these or for none, `NAME_dot`
///                 and `NAME_ddot`, their first and second derivatives
/// @param numbers  the columns (N×number of columns)
/// @throws std::invalid_argument with one line if the columns are others.
MotionTable make_motion_table(const std::vector<std::string>& columns,
                              const Eigen::MatrixXd& numbers);

/// Reads a table from a CSV file, whose first line has the names of the columns of
/// `make_motion_table`.
///
/// @throws std::invalid_argument with one line that names the file, the key, the value and what was
///         expected.
MotionTable read_motion_table(const std::filesystem::path& file);

/// Computes what a motion needs at each instant: pose, velocity, acceleration, tau_d and J.
///
/// If the base is fixed, or the table has its pose, the joints of the table move the robot, and the
/// end effector goes where they put it. Joints beyond the end effector that are not in the table
/// rest. Otherwise the end effector keeps the pose of the task or follows its path, t being the
/// time along the path. The table then has the joints of theta_r, and the base and the dependent
/// joints follow from them. Joints that a gear moves follow their leader.
///
/// c of an instant is that of the task: turned with the end effector if the task says so; of a
/// payload or a table of wrenches, the wrench per unit of their factor. u and h are empty or zero.
///
/// @param problem  the task, with one contact
/// @param table    the motion
/// @return N, or (N - 1) `instants_per_interval` + 1 instants
/// @throws std::invalid_argument with one line that names the row, the value and what was expected:
///         a time that does not increase, a number that is not finite, an unknown or a missing
///         coordinate, a base beside its free axes, a dependent joint or a gear that is not where
///         the others put it, or a posture that cannot be reached.
std::vector<Instant> motion_instants(const Problem& problem, const MotionTable& table);

/// `motion_instants` of a table in a file, whose errors name the file.
///
/// @param file                   as of `read_motion_table`
/// @param problem                the task
/// @param instants_per_interval  as in `MotionTable`
/// @param rates                  if not null, receives what `describe_rates` returns
std::vector<Instant> load_motion(const std::filesystem::path& file, const Problem& problem,
                                 int instants_per_interval = 1, std::string* rates = nullptr);

}  // namespace maxwrench
