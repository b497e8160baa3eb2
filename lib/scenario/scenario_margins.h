#pragma once

#include <optional>
#include <vector>

#include "lib/scenario/current_cases.h"
#include "lib/scenario/scenario_forces.h"
#include "maxwrench/capability.h"
#include "maxwrench/problem.h"
#include "maxwrench/zonotope.h"

namespace maxwrench {

/// N'tau (f), by rows of the normals N.
using FacetNormals = decltype(Zonotope::N);
void project(const FacetNormals& N, const Eigen::VectorXd& tau, Eigen::Ref<Eigen::ArrayXd> onto);

/// What the loads of a list of scenarios leave of the rows of the facets.
///
/// The rows are the upper sides of all pairs of facets, then the lower ones. The margin of an upper
/// side is -n_j'tau, that of a lower side n_j'tau. Loads are independent, so each row takes the
/// worst case of each load: combinations of cases need not be listed. Of a load with many currents,
/// each row first takes a bound of the worst case, then a closer one, then the case itself.
class ScenarioMargins {
 public:
  explicit ScenarioMargins(const Problem& problem);
  explicit ScenarioMargins(const Problem&& problem) = delete;

  /// Computes the margins. Allocates nothing after the first call.
  void set(ScenarioForces& at);
  /// The margins (2f); where a load has currents, bounds from below until they are refined.
  const Eigen::ArrayXd& values() const { return values_; }
  /// Whether all margins are those of the worst cases at once.
  bool exact() const { return of_.empty(); }
  /// Brings the margin of a row nearer to that of the worst cases; false if it is that already.
  bool refine(Eigen::Index row);
  /// Makes all margins those of the worst cases.
  void refine_all();
  /// Writes the cases that are worst for a row.
  void choose(Eigen::Index row, ScenarioChoice& choice);

 private:
  /// The cases of a load as combinations of few loads, whose projections on the normals suffice; or
  /// the currents of all.
  struct Load {
    const LoadGroup* cases = nullptr;
    std::optional<CurrentCases> currents;  ///< if a case has a current
    std::vector<LoadCase> basis;           ///< the loads; with `currents` none
    Eigen::MatrixXd coefficients;          ///< of the basis, for each case (basis×cases)
    Eigen::ArrayXXd projections;           ///< N' of the generalised forces of the basis (f×basis)
    Eigen::ArrayXd bound;                  ///< with `currents`: of |n_j'tau| over all cases (f)
    bool anywhere = false;                 ///< whether `bound` holds at all postures
    std::vector<int> worst;  ///< with `currents`: of each row, its worst case, if known
    Eigen::Index count() const { return static_cast<Eigen::Index>(cases->size()); }
  };
  /// What the margin of a row is of: a bound, a closer one, or the worst cases.
  enum class Margin : char { kBounded, kBoundedClosely, kOfCases };

  static Load make_load(const Robot& robot, const LoadGroup& cases);
  void combine(const Load& load, Eigen::Index which);
  void aim(Eigen::Index pair);
  double worst_case(Load& load, Eigen::Index row, int& which);
  void set_bounds(ScenarioForces& at);

  const FacetNormals& N_;
  Eigen::Index pairs_;
  std::vector<Load> loads_;
  Eigen::ArrayXd nominal_, most_, least_, value_, values_;
  std::vector<Margin> of_;  ///< of each row, if a load has currents
  Eigen::ArrayXd still_;    ///< the margins without currents
  Eigen::Index aimed_ = 0;  ///< the pair of the currents' normal; -1: none
  Eigen::VectorXd tau_, normal_;
};

}  // namespace maxwrench
