#pragma once

#include "lib/scenario/scenario_facets.h"
#include "maxwrench/margin.h"

namespace maxwrench {

/// The generalised forces of a set of wrenches at an instant of a motion.
class InstantForces final : public ScenarioForces {
 public:
  /// `task` has the set as its list. It must outlive this object.
  InstantForces(const Problem& task, const MarginSet& set);
  InstantForces(const Problem&&, const MarginSet&) = delete;

  /// The instant must outlive what is computed from it.
  void set(const Instant& instant);

  const Eigen::VectorXd& tau_d() const override { return instant_->tau_d; }
  void add_load(const LoadCase& /*load*/, Eigen::VectorXd& /*tau*/) override {}  // there are none
  void exert(const Vector6d& c, Eigen::VectorXd& tau) const override {
    tau.noalias() = instant_->J.transpose().lazyProduct(c);
  }
  Vector6d wrench(int i) const override;
  Vector6d ball_axis(Eigen::Index i) const override;

 private:
  const Problem& task_;
  bool turns_, of_task_;
  Eigen::Matrix3d turn_ = Eigen::Matrix3d::Identity();
  const Instant* instant_ = nullptr;
};

/// The task whose list of scenarios is the set, with its own limits and losses. Rejects tasks and
/// sets as `motion_margin`.
Problem task_of_margins(const Problem& task, const MarginSet& set);

/// The margin of one instant by the facets of {B u}. Allocates nothing after the first call.
class InstantScan {
 public:
  /// `task` is one of `task_of_margins`. It must outlive this object.
  InstantScan(const Problem& task, const MarginSet& set);
  InstantScan(const Problem&&, const MarginSet&) = delete;

  /// The margin at an instant; infinity if no wrench of the set matters.
  double scan(const Instant& instant);

  // After `scan`.

  /// Whether the motion itself is feasible.
  bool feasible() const { return feasible_; }
  /// The pair of facets that binds; -1: none.
  int pair() const { return pair_; }
  /// Minus the normal of the facet, over the length of the worst wrench across it: d margin/d tau_d
  /// where it is finite.
  const Eigen::VectorXd& slope() const { return slope_; }
  /// The wrench and the limits that bind.
  const ScenarioChoice& choice() const { return choice_; }

 private:
  void bind_low(const Instant& instant);

  const Problem& task_;
  InstantForces forces_;
  ScenarioFacets facets_;
  ScenarioChoice choice_;
  Eigen::VectorXd slope_;
  bool feasible_ = false;
  int pair_ = -1;
};

}  // namespace maxwrench
