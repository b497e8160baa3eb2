#include "lib/search/scenario_rows.h"

#include <algorithm>

namespace maxwrench {
namespace {

/// Bounds within this share of half the width of their pair are equal but for rounding.
constexpr double kTied = 1e-9;

}  // namespace

ScenarioRows::ScenarioRows(const Problem& problem)
    : problem_(problem), set_(problem.robot.actuation), at_(problem), facets_(problem) {
  const Eigen::Index pairs = set_.facet_pairs();
  Eigen::VectorXd high = Eigen::VectorXd::Constant(pairs, kInfinity), low = -high;
  for (const ScenarioLimits& limits : problem.scenarios.limits) {
    high = high.cwiseMin(limits.actuation.b_max);
    low = low.cwiseMax(limits.actuation.b_min);
  }
  const auto wrenches = static_cast<Eigen::Index>(problem.scenarios.wrenches.size());
  Eigen::VectorXd sides(2 * pairs), widths(2 * pairs);
  sides << high, -low;
  widths << (high - low) / 2, (high - low) / 2;
  for (double& width : widths) width = width > 0 && width < kInfinity ? width : 1;
  bound_ = sides.replicate(wrenches, 1);
  unit_ = widths.replicate(wrenches, 1);
  load_.resize(bound_.size());
  slope_.resize(bound_.size());
  seed_.w.setZero(1);
}

Eigen::Index ScenarioRows::count(const Problem& problem, Wrench wrench) {
  const ScenarioList& list = problem.scenarios;
  const bool one_column = wrench == Wrench::kPure || list.F.cols() == 0;
  if (list.empty() || !one_column || !ScenarioFacets::supports(problem)) return 0;
  return 2 * problem.robot.actuation.facet_pairs() *
         static_cast<Eigen::Index>(list.wrenches.size());
}

FacetSide ScenarioRows::facet(Eigen::Index row) const {
  const Eigen::Index pairs = set_.facet_pairs();
  FacetSide facet{row % pairs, row % (2 * pairs) < pairs ? 1.0 : -1.0, {}};
  int index = 0;
  for (const ScenarioLimits& limits : problem_.scenarios.limits) {
    const double bound =
        facet.sign > 0 ? limits.actuation.b_max[facet.pair] : -limits.actuation.b_min[facet.pair];
    if (bound - bound_[row] <= kTied * unit_[row]) facet.limits.push_back(index);
    ++index;
  }
  return facet;
}

void ScenarioRows::set(const Posture& posture) {
  at_.set(posture);
  facets_.fill_rows(at_, load_, slope_);
}

void ScenarioRows::fill(double t, Eigen::Ref<Eigen::VectorXd> rows) const {
  rows = load_ + t * slope_;
}

void ScenarioRows::differentiate(PostureEvaluator& model, double t,
                                 Eigen::Ref<Eigen::MatrixXd> by_theta_r,
                                 Eigen::Ref<Eigen::MatrixXd> by_t) {
  const Eigen::Index pairs = set_.facet_pairs();
  const Eigen::VectorXd& theta_r = at_.posture().theta_r;
  by_t = slope_;
  seed_.beta = t;
  seed_.w[0] = t;
  for (Eigen::Index row = 0; row < bound_.size(); ++row) {
    const Eigen::Index side = row % (2 * pairs);
    facets_.worst(at_, static_cast<int>(row / (2 * pairs)), side, seed_.decides);
    seed_.lambda = (side < pairs ? 1.0 : -1.0) * set_.N.col(side % pairs);
    seed_.h = t * seed_.decides.c;
    seed_.beta_J.noalias() = seed_.h * seed_.lambda.transpose();
    model.pull_back(theta_r, seed_, gradient_);
    by_theta_r.row(row) = gradient_.transpose();
  }
}

}  // namespace maxwrench
