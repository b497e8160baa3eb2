#include "solvers/map/lattice.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace maxwrench {

Lattice::Lattice(const MapPlan& plan)
    : over_(plan.over), refine_(plan.refine), shard_(plan.shard), shards_(plan.shards) {
  for (const MapAxis& axis : over_) {
    counts_.push_back(axis.name == "wrench");
    last_.push_back(static_cast<long>(axis.count - 1) << (counts_.back() ? 0 : refine_));
  }
}

Eigen::VectorXd Lattice::at(const Index& index) const {
  Eigen::VectorXd at(static_cast<Eigen::Index>(over_.size()));
  for (std::size_t a = 0; a < over_.size(); ++a) {
    const double share =
        last_[a] == 0 ? 0 : static_cast<double>(index[a]) / static_cast<double>(last_[a]);
    // The last value is exactly `high`.
    at[static_cast<Eigen::Index>(a)] = (1 - share) * over_[a].low + share * over_[a].high;
  }
  return at;
}

long Lattice::step(std::size_t axis, int level) const {
  return counts_[axis] ? 1 : 1L << (kCoarse + refine_ - level);
}

std::pair<long, long> Lattice::around(std::size_t axis, long i, int level) const {
  const long size = step(axis, level), below = i == last_[axis] ? i : i / size * size;
  return {below, std::min(below + size, last_[axis])};
}

int Lattice::level_of(const Index& index) const {
  int level = 0;
  for (std::size_t a = 0; a < over_.size(); ++a) {
    while (around(a, index[a], level).first != index[a]) ++level;
  }
  return level;
}

std::vector<Lattice::Index> Lattice::product(const std::vector<std::vector<long>>& lists) const {
  std::vector<Index> all = {{}};
  for (const std::vector<long>& list : lists) {
    std::vector<Index> more;
    for (const Index& index : all) {
      for (const long i : list) {
        more.push_back(index);
        more.back().push_back(i);
      }
    }
    all = std::move(more);
  }
  return all;
}

std::vector<Lattice::Index> Lattice::parents(const Index& index, int level) const {
  std::vector<std::vector<long>> lists;
  for (std::size_t a = 0; a < over_.size(); ++a) {
    const auto [below, above] = around(a, index[a], level - 1);
    lists.push_back(below == index[a] ? std::vector{below} : std::vector{below, above});
  }
  return product(lists);
}

std::vector<Lattice::Index> Lattice::corners(const Index& lower, int level) const {
  return product(lines_within(lower, level, level, true));
}

std::vector<Lattice::Index> Lattice::halved(const Index& lower, int level) const {
  return product(lines_within(lower, level, level + 1, true));
}

std::vector<Lattice::Index> Lattice::children(const Index& lower, int level) const {
  return product(lines_within(lower, level, level + 1, false));
}

/// The lines of level `finer` within a cell of `level`, with its upper sides if `closed`.
std::vector<std::vector<long>> Lattice::lines_within(const Index& lower, int level, int finer,
                                                     bool closed) const {
  std::vector<std::vector<long>> lists;
  for (std::size_t a = 0; a < over_.size(); ++a) {
    // A coordinate that counts has no cells between its values.
    const long end = counts_[a] ? lower[a] : around(a, lower[a], level).second;
    std::vector<long> lines = {lower[a]};
    while (lines.back() < end) {
      const long next = around(a, lines.back(), finer).second;
      if (next == end && !closed) break;
      lines.push_back(next);
    }
    lists.push_back(std::move(lines));
  }
  return lists;
}

std::vector<Lattice::Index> Lattice::shard_cells(int level) const {
  std::vector<std::vector<long>> lists;
  for (std::size_t a = 0; a < over_.size(); ++a) {
    std::vector<long> lines = {0};
    for (long next = step(a, 0); counts_[a] ? next <= last_[a] : next < last_[a];) {
      lines.push_back(next);
      next += step(a, 0);
    }
    lists.push_back(std::move(lines));
  }
  std::vector<Index> cells = product(lists);
  const auto count = static_cast<long>(cells.size());
  if (count < shards_) {
    throw std::invalid_argument("shard: got " + std::to_string(shards_) +
                                " parts, expected at most " + std::to_string(count) +
                                ", the cells of the coarse grid");
  }
  const auto cut = [&](long part) { return cells.begin() + count * part / shards_; };
  cells = std::vector<Index>(cut(shard_ - 1), cut(shard_));
  for (int l = 0; l < level; ++l) {
    std::vector<Index> finer;
    for (const Index& cell : cells) {
      const std::vector<Index> within = children(cell, l);
      finer.insert(finer.end(), within.begin(), within.end());
    }
    cells = std::move(finer);
  }
  return cells;
}

}  // namespace maxwrench
