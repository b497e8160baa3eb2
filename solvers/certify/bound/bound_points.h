#pragma once

#include <functional>
#include <vector>

#include "solvers/certify/bound/multi_affine.h"

namespace maxwrench {

/// The values t (1 - h_v) - g_v of a multiplier at all control points v, for t = least_t and t =
/// most_t, and the bound that they prove.
class PointValues {
 public:
  /// For values in [low, high], which may be infinite: numbers that the program can use in place of
  /// infinite ones, and of a `high` that is not useful.
  void set_ends(double low, double high);
  double least_t() const { return least_t_; }
  double most_t() const { return most_t_; }
  /// Whether a limit of the values is in proportion to the known ones, of which the scale is at
  /// least 1 and, without a `low`, 1000. A larger limit may follow from rounding alone. It spoils
  /// programs, and an exact check does not find it again.
  bool is_useful(double limit) const;

  /// U = s + the largest value, rounding included, if `low` is finite and `high` useful; else, and
  /// where it is less, the largest (s - g_v)/h_v. The rounding errors of s, g and h are at most
  /// `off` and `off_a`.
  double bound(double s, const Eigen::VectorXd& g, const Eigen::VectorXd& h, double off,
               double off_a);
  /// The values, first all with least_t.
  const Eigen::VectorXd& at() const { return at_; }

 private:
  double low_ = 0, least_t_ = 0, most_t_ = 0, scale_ = 1;
  bool most_is_limit_ = false;
  Eigen::VectorXd at_;
};

/// The control points of a linear program. Point v with least_t is number v, and with most_t number
/// v + size.
class ProgramPoints {
 public:
  static constexpr Eigen::Index kMost = 1024;

  /// The numbers, in the order of the program's columns.
  const std::vector<int>& ids() const { return ids_; }
  Eigen::Index count() const { return static_cast<Eigen::Index>(ids_.size()); }
  void clear() { ids_.clear(); }
  void add(int id) { ids_.push_back(id); }
  /// Begins with the points of the basis of a larger box. `first` is the first point's column in a
  /// basis of the program. Returns the columns of that basis in a program with these points.
  std::vector<int> begin(const std::vector<int>& basis, int first);
  /// The same basis with the numbers of points, for the program of a part of the box.
  std::vector<int> numbered(std::vector<int> columns, int first) const;
  /// Adds the corners of a box, if there are not too many.
  void add_corners(const Coordinates& chain, Eigen::Index size);
  /// Adds the numbers of some of the largest values above a limit, which are their places, or
  /// those that `number` makes of them. Returns false if there are none that are new, or no room
  /// for them.
  bool add_largest(const Eigen::VectorXd& values, double above,
                   const std::function<int(int)>& number = {});

 private:
  std::vector<int> ids_, order_;
};

}  // namespace maxwrench
