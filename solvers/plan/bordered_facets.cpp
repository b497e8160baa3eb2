#include "solvers/plan/bordered_facets.h"

#include <algorithm>
#include <cmath>

namespace maxwrench {
namespace {

constexpr double kFlat = 1e-12;  // a slope below this part of the wrench's size is rounding
constexpr int kRowsAtOnce = 64;  // the tableau grows by so many rows, the last ones without limits

}  // namespace

bool BorderedFacets::solve(const PlanProgram& program, PlanSolution& solution) {
  collect(program);
  if (!std::isfinite(most_)) return false;
  load(program);
  if (tableau_.solve() != Tableau::Outcome::kOptimal) return false;
  read(program, solution);
  return true;
}

/// All facets with what y can do to them.
void BorderedFacets::collect(const PlanProgram& program) {
  const Zonotope& set = *program.instants.front().actuation;
  const Eigen::VectorXd range = program.y_min.cwiseAbs().cwiseMax(program.y_max.cwiseAbs());
  facets_.clear();
  pulls_.resize(program.border(), static_cast<Eigen::Index>(set.facet_pairs()) * program.size());
  most_ = kInfinity;
  for (int i = 0; i < program.size(); ++i) {
    const WrenchProgram& at = program.instants[i];
    auto pulls =
        pulls_.middleCols(static_cast<Eigen::Index>(i) * set.facet_pairs(), set.facet_pairs());
    pulls.noalias() = program.G[i].transpose() * set.N;
    const double flat = kFlat * at.JtW.norm() / std::abs(at.c_w[0]);
    for (int j = 0; j < set.facet_pairs(); ++j) {
      Facet facet{.instant = i, .pair = j};
      const double s = set.N.col(j).dot(at.JtW.col(0)) / at.c_w[0];
      const double load = set.N.col(j).dot(at.tau_d);
      facet.reach = range.dot(pulls.col(j).cwiseAbs());
      facet.low = -kInfinity;
      facet.high = set.b_max[j] - load;
      if (std::abs(s) > flat) {
        facet.side = s > 0 ? 1 : -1;
        facet.slope = std::abs(s);
        if (s < 0) facet.high = load - set.b_min[j];
        most_ = std::min(most_, (facet.high + facet.reach) / facet.slope);
      } else {
        facet.low = set.b_min[j] - load;
      }
      facets_.push_back(facet);
    }
  }
}

void BorderedFacets::load(const PlanProgram& program) {
  std::erase_if(facets_, [&](const Facet& facet) {
    if (facet.side == 0) {
      return facet.high - facet.reach >= 0 && facet.low + facet.reach <= 0;
    }
    return facet.high - facet.reach > facet.slope * most_;
  });
  const int p = program.border(), extra = static_cast<int>(program.R.rows());
  rows_ = static_cast<int>(facets_.size()) + extra;
  const int height = (rows_ + kRowsAtOnce - 1) / kRowsAtOnce * kRowsAtOnce;
  tableau_.resize(height, 1 + p);
  const int pairs = program.instants.front().actuation->facet_pairs();
  int row = 0;
  for (const Facet& facet : facets_) {
    const double sign = facet.side == 0 ? 1 : facet.side;
    tableau_.entry(row, 0) = facet.slope;
    const auto pull = pulls_.col(static_cast<Eigen::Index>(facet.instant) * pairs + facet.pair);
    for (int k = 0; k < p; ++k) tableau_.entry(row, 1 + k) = -sign * pull[k];
    tableau_.low[row] = facet.low;
    tableau_.high[row] = facet.high;
    ++row;
  }
  for (int other = row; other < height; ++other) {
    std::fill(tableau_.row(other), tableau_.row(other) + tableau_.stride(), 0.0);
  }
  for (int column = 0; column < program.R.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(program.R, column); it; ++it) {
      tableau_.entry(row + static_cast<int>(it.row()), 1 + column) = it.value();
    }
  }
  tableau_.low.segment(row, extra) = program.r_min;
  tableau_.high.segment(row, extra) = program.r_max;
  tableau_.low.segment(rows_, height - rows_).setConstant(-kInfinity);
  tableau_.high.segment(rows_, height - rows_).setConstant(kInfinity);
  tableau_.low[height] = -kInfinity;
  tableau_.high[height] = most_;
  tableau_.low.tail(p) = program.y_min;
  tableau_.high.tail(p) = program.y_max;
  tableau_.c.setZero();
  tableau_.c[0] = 1;
}

/// Multiplier m of a facet's row: d t/d tau_d,i = -sigma m n_j, and it carries m |s| of the t.
void BorderedFacets::read(const PlanProgram& program, PlanSolution& solution) const {
  const Zonotope& set = *program.instants.front().actuation;
  solution.value = tableau_.x[0];
  solution.y = tableau_.x.tail(program.border());
  solution.iterations = tableau_.iterations;
  solution.lambda.setZero(set.dimension(), program.size());
  solution.pi.setZero(program.size());
  int row = 0;
  for (const Facet& facet : facets_) {
    const double m = tableau_.multipliers[row++];
    if (m == 0) continue;
    const double sign = facet.side == 0 ? 1 : facet.side;
    solution.lambda.col(facet.instant) -= sign * m * set.N.col(facet.pair);
    solution.pi[facet.instant] += m * facet.slope;
  }
  solution.nu = tableau_.multipliers.segment(row, program.R.rows());
}

}  // namespace maxwrench
