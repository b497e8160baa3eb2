#pragma once

#include <vector>

#include "lib/scenario/scenario_facets.h"
#include "solvers/certify/bound/list_model.h"

namespace maxwrench {

/// The generalised forces of a list at a point of its blocks, or averaged over points.
class ListForces final : public ScenarioForces {
 public:
  explicit ListForces(const ListModel& model);

  /// [T_0; T_1; ...; A_0; A_1; ...].
  void set(const Eigen::VectorXd& blocks);

  const Eigen::VectorXd& tau_d() const override { return tau_d_; }
  void add_load(const LoadCase& load, Eigen::VectorXd& tau) override;
  void exert(const Vector6d& c, Eigen::VectorXd& tau) const override;
  Vector6d wrench(int i) const override;
  Vector6d ball_axis(Eigen::Index i) const override;

 private:
  const ListModel& model_;
  Eigen::MatrixXd T_, A_;
  Eigen::VectorXd tau_d_, loads_;
};

/// The facets that a multiplier combines: each is one of a scenario.
class ListRows {
 public:
  static constexpr Eigen::Index kMost = 32;

  struct Row {
    int pair = 0;
    ScenarioKey key;
    double b_min = 0, b_max = 0;
    bool operator==(const Row& other) const { return pair == other.pair && key == other.key; }
  };

  explicit ListRows(const ListModel& model);

  const std::vector<Row>& rows() const { return rows_; }
  Eigen::Index count() const { return static_cast<Eigen::Index>(rows_.size()); }
  void clear() { rows_.clear(); }
  /// Adds a facet; false if it is known, or if there is no room.
  bool add(int pair, const ScenarioKey& key);
  /// Adds the first facets that a point of the blocks violates on its way from beta = 0 to 1, or
  /// beyond 1. False if there are none.
  bool add_violated(const Eigen::VectorXd& blocks);
  /// The numbers with which a row multiplies the blocks.
  auto coefficients(Eigen::Index row) const { return coefficients_.col(row); }
  /// The normal of a row.
  auto normal(const Row& row) const { return set_.N.col(row.pair); }

 private:
  const ListModel& model_;
  const Zonotope& set_;
  ScenarioFacets facets_;
  ListForces forces_;
  std::vector<Row> rows_;
  Eigen::MatrixXd coefficients_;
  ScenarioChoice choice_;
  Eigen::VectorXd loads_, axes_;
};

}  // namespace maxwrench
