#pragma once

#include "lib/scenario/scenario_facets.h"
#include "lib/scenario/scenario_program.h"
#include "lib/search/facet_side.h"
#include "maxwrench/posture.h"

namespace maxwrench {

/// The rows of the smooth program of a list of scenarios, for pure wrenches. With the facet normals
/// n_j of {B u}, the wrenches c_i and the factor t, each wrench has a row for each side s = 1, -1
/// of each pair:
///
///     s n_j'tau_d + max over cases of s n_j'tau + t (s n_j'J'c_i + r |E'J n_j|) <= least s b_j,
///
/// where the least is that over all limits: no row depends on which of them holds. A t that keeps
/// all rows is a factor of every scenario. Where the worst case changes, a row has a kink; its
/// derivative is that of one of the cases.
class ScenarioRows {
 public:
  /// Keeps a reference to the problem.
  explicit ScenarioRows(const Problem& problem);
  explicit ScenarioRows(const Problem&& problem) = delete;

  /// Whether the task has a list with these rows, and how many; 0: it has not.
  static Eigen::Index count(const Problem& problem, Wrench wrench);

  const Eigen::VectorXd& bound() const { return bound_; }  ///< rows <= bound [N, N m]
  const Eigen::VectorXd& unit() const { return unit_; }    ///< half the width of the pair
  /// The facet of a row, with all limits that have its least bound.
  FacetSide facet(Eigen::Index row) const;

  /// Computes what the rows need of a posture, which must stay as it is.
  void set(const Posture& posture);
  /// The rows at the factor t.
  void fill(double t, Eigen::Ref<Eigen::VectorXd> rows) const;
  /// Their derivatives by theta_r, at constant t, and by t. `model` is at the posture.
  void differentiate(PostureEvaluator& model, double t, Eigen::Ref<Eigen::MatrixXd> by_theta_r,
                     Eigen::Ref<Eigen::MatrixXd> by_t);

 private:
  const Problem& problem_;
  const Zonotope& set_;
  ScenarioPosture at_;
  ScenarioFacets facets_;
  Eigen::VectorXd bound_, unit_, load_, slope_;
  Capability seed_;
  Eigen::VectorXd gradient_;
};

}  // namespace maxwrench
