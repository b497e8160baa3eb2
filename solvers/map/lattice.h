#pragma once

#include <utility>
#include <vector>

#include "maxwrench/map.h"

namespace maxwrench {

/// The places of a map and their levels.
///
/// A place has a whole number i for each coordinate, 0 <= i <= last, on the finest lattice: that of
/// the grid after all halvings. At level l the lines of a coordinate are the multiples of a step
/// that halves from level to level, and `last`. The grid is complete from `grid_level` on. A
/// coordinate that counts things ("wrench") has all of its values at each level.
class Lattice {
 public:
  using Index = std::vector<long>;

  /// Takes a plan that was checked.
  explicit Lattice(const MapPlan& plan);

  int grid_level() const { return kCoarse; }
  int last_level() const { return kCoarse + refine_; }
  /// The coordinates of a place.
  Eigen::VectorXd at(const Index& index) const;
  /// The first level whose lines all meet in the place.
  int level_of(const Index& index) const;
  /// The corners of the smallest cell of level - 1 around a place of this level.
  std::vector<Index> parents(const Index& index, int level) const;

  /// The lower corners of the cells of a level, those of a shard only.
  std::vector<Index> shard_cells(int level) const;
  /// The corners of the cell of a level with this lower corner.
  std::vector<Index> corners(const Index& lower, int level) const;
  /// All places of level + 1 on the closed cell of `level`.
  std::vector<Index> halved(const Index& lower, int level) const;
  /// The lower corners of the cells of level + 1 in a cell of `level`.
  std::vector<Index> children(const Index& lower, int level) const;

 private:
  static constexpr int kCoarse = 2;  // halvings from level 0 to the grid

  long step(std::size_t axis, int level) const;
  /// The next line at or below, and the next one above; the last line is its own next one.
  std::pair<long, long> around(std::size_t axis, long i, int level) const;
  std::vector<Index> product(const std::vector<std::vector<long>>& lists) const;
  std::vector<std::vector<long>> lines_within(const Index& lower, int level, int finer,
                                              bool closed) const;

  std::vector<MapAxis> over_;
  std::vector<long> last_;
  std::vector<bool> counts_;  ///< whether a coordinate is never divided
  int refine_, shard_, shards_;
};

}  // namespace maxwrench
