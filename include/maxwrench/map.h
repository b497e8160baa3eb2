#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "maxwrench/solve.h"

/// @file
/// Capability maps: the best value over a grid of poses, directions and parameters.

namespace maxwrench {

/// The largest number of values of the grid of a map.
inline constexpr long kMostCells = 1'000'000;

/// One coordinate of a map, with `count` evenly spaced values from `low` to `high`.
///
/// * "x", "y", "z", "roll", "pitch", "yaw": an offset of the pose [m; rad]. Let X_0 be
///   `Problem::pose`. The pose is X_0 Trans(x, y, z) Rz(yaw) Ry(pitch) Rx(roll), as in `FreePose`.
///   Wrenches turn with it only if the task gives them in axes of the end effector.
/// * "azimuth", "elevation": the direction of c [rad], in the axes in which the task gives its
///   wrench: (cos el cos az, cos el sin az, sin el), a force or a torque as that of the task.
/// * "wrench": the number of one of several wrenches of a task, from 1.
/// * "thrust", "torque", or the name of an actuator: a factor [-] above 0. It multiplies the limits
///   of all thrusters, of the efforts of all joints, or of this actuator.
/// * "environment.gravity" [m/s^2], "environment.water_density" [kg/m^3],
///   "environment.current.x", ".y", ".z" [m/s], "trim.buoyancy_mass" [kg]: this value in place of
///   that of the robot or task.
/// * "links.NAME.mass" [kg]: the mass of the body NAME of `Robot::parts`, at its centre of mass.
/// * "payload.mass" [kg]: the mass of a point at the end effector's origin, which the robot
///   carries beside the wrench.
/// * "wrench.ball.radius" [N or N m]: the radius of the task's ball, unless the value is that of a
///   ball of radius 1.
/// * "uncertainty.trim", "uncertainty.mass.NAME", "uncertainty.payload.mass" [kg],
///   "uncertainty.volume.NAME" [m^3]: half the width of an interval that the task has, where the
///   centre of the same body is known.
struct MapAxis {
  std::string name;  ///< the name of the coordinate
  double low = 0,    ///< the first value
      high = 0;      ///< the last value
  long count = 1;    ///< number of values; with one value low = high
};

/// The coordinates that a map can have beside masses of bodies, widths of intervals and the names
/// of actuators.
const std::vector<std::string>& map_coordinates();

/// Returns the unit of a coordinate of a map, such as "m", "rad" or "kg"; "-": it has none.
const char* map_unit(const std::string& coordinate);

/// One place of a map: the best posture that was found there.
///
/// The status is kBestFound; kNoneFound, which proves nothing; or kBudgetExhausted if it was
/// interrupted.
struct MapCell : Verdict {
  /// The place on the finest lattice: `MapPlan::refine` halvings of each interval of the grid.
  std::vector<long> index;
  Eigen::VectorXd at;        ///< the coordinates
  int level = 0;             ///< the level in which it was computed, from 0
  double beta = 0;           ///< value [unit]; NaN: none
  std::string unit;          ///< of the value; it can differ from wrench to wrench
  Eigen::VectorXd theta_r,   ///< the posture (r); empty: none
      q,                     ///< all its joints [rad or m]
      base;                  ///< its base in the world: x, y, z, roll, pitch, yaw [m; rad]
  long evaluations = 0;      ///< number of evaluations
  double bound = kInfinity;  ///< no posture has a larger value there [unit]; infinite: not known
  /// What a search from scratch found there [unit]; nothing: none was made. -infinity: it found no
  /// value.
  std::optional<double> scratch;
};

/// The grid of a map and how it is computed.
struct MapPlan {
  std::vector<MapAxis> over;  ///< the coordinates, each once
  /// Number of times that intervals of the grid are halved where the map changes.
  int refine = 0;
  /// An interval is halved if the corners of its cell differ by more than this share of the largest
  /// of them, or in status.
  double tolerance = 0.05;
  double check = 0;  ///< share of the cells that a search from scratch checks [0, 1]
  /// Evaluations of such a search, which is `default_search`; 0: it is restarted until another
  /// optimum is unlikely, as that of `solve`.
  long check_budget = 0;
  bool bound = false;  ///< whether `certify` proves a bound in each cell
  double gap = 1e-3,   ///< the gap that ends this proof, as `ProofOptions::gap`
      seconds = 60;    ///< the time that ends it, as `ProofOptions::seconds`
  int shard = 1,       ///< only part `shard` of `shards`, from 1
      shards = 1;      ///< number of parts
  /// Returns a cell that an earlier run has computed. It may be called from any thread.
  std::function<std::optional<MapCell>(const std::vector<long>& index)> known = {};
  /// Gets each cell that was computed, one call at a time, from any thread.
  std::function<void(const MapCell& cell)> computed = {};
  /// Called from time to time with the number of finished cells, and of all that are known so far.
  std::function<void(long finished, long all)> progress = {};
};

/// A capability map.
///
/// The status is kBestFound if any cell has a value, kNoneFound if none has, or kBudgetExhausted if
/// it was interrupted.
struct CapabilityMap : Verdict {
  std::shared_ptr<const Problem> task;  ///< the task
  Case choice;                          ///< the case, with all defaults filled in
  MapPlan plan;                         ///< the plan
  std::string unit;                     ///< of the values
  std::vector<MapCell> cells;           ///< the cells in the order of `MapCell::index`
  /// The coordinates that have no effect on the values of any sampled posture.
  std::vector<std::string> unchanging;
  long computed = 0;  ///< number of cells that this run computed
  double wall_s = 0;  ///< wall time [s]

  /// Returns the number of cells that a search from scratch has checked.
  long checked() const;
  /// Returns the number of these that it improves by more than 0.1 %, or in status.
  long improved() const;
  /// Returns the number of cells whose bound is within `MapPlan::gap` of their value.
  long proven() const;
  /// Returns the largest gap of a cell that has a value, (bound - beta)/|beta|; infinite: a cell
  /// has no bound.
  double widest_gap() const;
  /// Returns the cell with the largest value, or null if none has a value.
  const MapCell* best() const;
};

/// Computes the best value over a grid of poses, directions and parameters.
///
/// Each cell is a task of its own, and its value is that of the best posture which the search of
/// `options` finds. Level 0 is every fourth value of each coordinate, and the last one; it has no
/// other starts than the search's own. Levels 1 and 2 are the rest of the grid. Each later level
/// halves cells of the grid whose corners differ. From level 1 on, a cell first evaluates the
/// postures of its corners, which belong to an earlier level, and the search begins at those that
/// have a value. So cells of one level do not depend on each other: the map is the same at any
/// number of threads, in any shard, and after an interruption.
///
/// @param task     a static task
/// @param plan     the coordinates, and what to compute
/// @param options  measure, wrench, solver, search, budget and others, of each cell. Without a
///                 search it is the first stage of `default_search`, or all of it where that is no
///                 search between facets; it is not restarted. The budget counts at level 0, the
///                 default is `kMapBudget`; later levels have a fifth of it
/// @return the map. An interruption leaves out the cells that it stops
/// @throws std::invalid_argument, which names the coordinate, its value and what was expected: for
///         a coordinate that does not exist, occurs twice, or does not suit the task, limits that
///         are not finite or not in order, a grid above `kMostCells`; also as `solve` and, for
///         bounds, as `certify`
CapabilityMap map(const Problem& task, const MapPlan& plan, const Options& options = {});

/// The evaluations of a cell of level 0 if no budget is given.
inline constexpr long kMapBudget = 3000;

/// Returns the case with the search and the budget that `map` uses if it names none.
Case with_map_search(const Problem& task, Case c);

/// Returns the task of one place of a map.
///
/// @param task  the task of the map
/// @param over  the coordinates
/// @param at    their values
/// @throws std::invalid_argument as `map`
Problem posed(const Problem& task, const std::vector<MapAxis>& over, const Eigen::VectorXd& at);

/// Returns a map as text of several lines.
std::string summary(const CapabilityMap& map);

/// Returns a map, without its cells, as a JSON object on one line.
std::string to_json(const CapabilityMap& map);

}  // namespace maxwrench
