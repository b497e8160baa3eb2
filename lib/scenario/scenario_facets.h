#pragma once

#include <string>
#include <vector>

#include "lib/scenario/scenario_forces.h"
#include "lib/scenario/scenario_margins.h"
#include "maxwrench/capability.h"
#include "maxwrench/problem.h"

namespace maxwrench {

/// The interval of a list of scenarios of one wrench column, by the facets of {B u}.
///
/// With the normals n_j of the facets, which all limits share, scenario s holds beta exactly if
///
///     b_min,s,j <= n_j'tau_s + beta n_j'J'c_s <= b_max,s,j   for all j.
///
/// Each side of each pair is a row "slope beta <= limit + margin" (`ScenarioMargins`). Margins that
/// are only bounds are refined for rows that may be the end. A ball of radius r adds r |E'J n_j| to
/// the slope of both rows of a pair, which is its support function.
class ScenarioFacets {
 public:
  explicit ScenarioFacets(const Problem& problem);
  explicit ScenarioFacets(const Problem&& problem) = delete;

  /// Whether the actuators of the task have facets, and no second contact exerts forces.
  static bool supports(const Problem& problem);

  /// Computes both ends. Allocates nothing after the first call.
  void scan(ScenarioForces& at);

  /// min hi_s and max lo_s. With currents, a `low` that is not above `high` is only a bound of it.
  double high = 0, low = 0;
  /// Whether a row holds for no factor. Its scenario, `low_scenario`, is then infeasible by itself,
  /// and both ends are meaningless.
  bool missed = false;

  /// The rows "load + slope beta <= limit" of all wrenches, in turn: 2f of each, upper sides first.
  /// All loads count with their worst cases.
  void fill_rows(ScenarioForces& at, Eigen::VectorXd& load, Eigen::VectorXd& slope);
  /// The worst scenario of such a row of a wrench, after `fill_rows` at the same forces; it names
  /// no limits.
  void worst(ScenarioForces& at, int wrench, Eigen::Index row, ScenarioChoice& choice);

  /// The first scenario with the end `high`, after `scan`; false if there is none.
  bool high_scenario(ScenarioForces& at, ScenarioChoice& choice);
  /// Likewise of `low`; of the row that is missed, if one is.
  bool low_scenario(ScenarioForces& at, ScenarioChoice& choice);
  /// The pairs of facets of these two ends.
  int high_pair() const { return static_cast<int>(high_end_.row % pairs_); }
  int low_pair() const { return static_cast<int>(low_end_.row % pairs_); }
  /// d high/d tau_d (n), if `high` is finite.
  void fill_slope(Eigen::VectorXd& lambda) const;

 private:
  /// A wrench with its rows: upper sides, then lower ones.
  struct Wrench {
    Eigen::ArrayXd inverse;     ///< reciprocals of the slopes; 0 for rows parallel to beta
    std::vector<int> parallel;  ///< these rows
  };
  /// A row of a wrench with a set of limits; -1: none.
  struct End {
    int wrench = -1, limits = 0;
    Eigen::Index row = 0;
  };
  void set_slopes(ScenarioForces& at, int i);
  void set_wrench(ScenarioForces& at, int i);
  bool misses(const Eigen::ArrayXd& limits, const Wrench& wrench, Eigen::Index& row);
  bool scan_high(int wrench, int limits);
  void scan_low(int wrench, int limits);
  bool refine_end(const Wrench& rows, const Eigen::ArrayXd& limits, Eigen::Index row);
  void fill_ends(const Wrench& rows, const Eigen::ArrayXd& limits, double sign, double none);
  Eigen::Index row_of(double end) const;
  bool choose(ScenarioForces& at, const End& end, ScenarioChoice& choice);

  const Problem& problem_;
  const Zonotope& set_;
  Eigen::Index pairs_;
  std::vector<Eigen::ArrayXd> limits_;  ///< [b_max; -b_min] of each set of limits
  std::vector<Wrench> wrenches_;
  ScenarioMargins margins_;
  Eigen::ArrayXd slope_, widening_, ends_;
  End high_end_, low_end_;
  double high_inverse_ = 0;
  Eigen::VectorXd tau_;
  Eigen::ArrayXXd ball_;  ///< N'J' of the ball's axes (f×d)
  double size_ = 0;       ///< of the generalised forces of a wrench, with those of the ball
};

}  // namespace maxwrench
