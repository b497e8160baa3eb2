#include "solvers/trajectory/bordered_facets.h"

#include <algorithm>
#include <cmath>

#include "solvers/trajectory/by_facets.h"

namespace maxwrench {
namespace {

constexpr int kMostColumns = 64;   // of y: with more columns, a dense tableau is slower than `ipm`
constexpr double kFlat = 1e-12;    // a slope below this part of the wrench's size is rounding
constexpr double kLikely = 0.1;    // share of its reach by which y is expected to move a row
constexpr double kMissed = 1e-10;  // relative violation of an omitted row
constexpr int kLazyRounds = 20;
constexpr int kRowsAtOnce = 32;  // the tableau grows by these; the last ones have no limits

}  // namespace

bool BorderedFacets::suits(const TrajectoryProgram& program) {
  return program.border() > 0 && program.border() <= kMostColumns && bounded_by_facets(program);
}

bool BorderedFacets::solve(const TrajectoryProgram& program, TrajectorySolution& solution) {
  collect(program);
  if (!std::isfinite(most_)) return false;
  choose();
  solution.iterations = 0;
  for (int round = 0; round < kLazyRounds; ++round) {
    load(program);
    const bool solved = tableau_.solve() == Tableau::Outcome::kOptimal;
    solution.iterations += tableau_.iterations;
    if (!solved) return false;
    if (add_violated(tableau_.x)) continue;
    read(program, solution);
    return true;
  }
  return false;
}

void BorderedFacets::collect(const TrajectoryProgram& program) {
  const int pairs = program.instants.front().actuation->facet_pairs();
  const Eigen::Index facets = static_cast<Eigen::Index>(pairs) * program.size();
  rows_.clear();
  y_slopes_.resize(program.border(), facets + program.R.rows());
  for (int i = 0; i < program.size(); ++i) add_facets(program, i);
  y_slopes_.rightCols(program.R.rows()) = program.R.transpose();
  for (int i = 0; i < program.R.rows(); ++i) {
    rows_.push_back({.index = i, .low = program.r_min[i], .high = program.r_max[i]});
  }
  const Eigen::VectorXd range = program.y_min.cwiseAbs().cwiseMax(program.y_max.cwiseAbs());
  y_values_.noalias() = y_slopes_.cwiseAbs().transpose() * range;
  most_ = kInfinity;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Row& row = rows_[i];
    row.reach = y_values_[static_cast<Eigen::Index>(i)];
    if (row.side != 0) most_ = std::min(most_, (row.high + row.reach) / row.slope);
  }
}

void BorderedFacets::add_facets(const TrajectoryProgram& program, int instant) {
  const WrenchProgram& at = program.instants[instant];
  const Zonotope& set = *at.actuation;
  auto y_slopes = y_slopes_.middleCols(static_cast<Eigen::Index>(rows_.size()), set.facet_pairs());
  y_slopes.noalias() = -program.G[instant].transpose() * set.N;
  const double flat = kFlat * at.JtW.norm() / at.c_w[0];
  for (int j = 0; j < set.facet_pairs(); ++j) {
    const double s = set.N.col(j).dot(at.JtW.col(0)) / at.c_w[0];
    const double load = set.N.col(j).dot(at.tau_d);
    Row row{.instant = instant, .index = j};
    row.low = set.b_min[j] - load;
    row.high = set.b_max[j] - load;
    if (std::abs(s) > flat) {
      row.side = s > 0 ? 1 : -1;
      row.slope = std::abs(s);
      if (s < 0) {
        row.high = -row.low;
        y_slopes.col(j) *= -1;
      }
      row.low = -kInfinity;
    }
    rows_.push_back(row);
  }
}

/// Selects the rows that may become the tightest when y uses a share of its range.
void BorderedFacets::choose() {
  double tightest = kInfinity;
  for (const Row& row : rows_) {
    if (row.side == 0) continue;
    tightest = std::min(tightest, (row.high + kLikely * row.reach) / row.slope);
  }
  for (Row& row : rows_) {
    const double reach = kLikely * row.reach;
    row.used = row.side == 0 ? row.high < reach || row.low > -reach
                             : row.high - reach <= row.slope * tightest;
  }
}

/// Marks the rows violated at (t, y) as used. Returns whether there are any.
bool BorderedFacets::add_violated(const Eigen::VectorXd& x) {
  y_values_.noalias() = y_slopes_.transpose() * x.tail(y_slopes_.rows());
  bool any = false;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Row& row = rows_[i];
    if (row.used) continue;
    const double value = row.slope * x[0] + y_values_[static_cast<Eigen::Index>(i)];
    const double slack = kMissed * (1 + std::abs(value));
    row.used = value > row.high + slack || value < row.low - slack;
    any |= row.used;
  }
  return any;
}

void BorderedFacets::load(const TrajectoryProgram& program) {
  const int p = program.border();
  const auto used = static_cast<int>(
      std::count_if(rows_.begin(), rows_.end(), [](const Row& row) { return row.used; }));
  const int height = (used + kRowsAtOnce - 1) / kRowsAtOnce * kRowsAtOnce;
  tableau_.resize(height, 1 + p);
  int line = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    if (!row.used) continue;
    tableau_.entry(line, 0) = row.slope;
    const auto slopes = y_slopes_.col(static_cast<Eigen::Index>(i));
    std::copy(slopes.data(), slopes.data() + p, tableau_.row(line) + 1);
    tableau_.low[line] = row.low;
    tableau_.high[line] = row.high;
    ++line;
  }
  for (; line < height; ++line) {
    std::fill(tableau_.row(line), tableau_.row(line) + tableau_.stride(), 0.0);
    tableau_.low[line] = -kInfinity;
    tableau_.high[line] = kInfinity;
  }
  tableau_.low[height] = -kInfinity;
  tableau_.high[height] = most_ + 1 + std::abs(most_);  // too large to be active in the end
  tableau_.low.tail(p) = program.y_min;
  tableau_.high.tail(p) = program.y_max;
  tableau_.c.setZero();
  tableau_.c[0] = 1;
}

/// The multiplier m of a facet's row gives d t/d tau_d,i = -sigma m n_j, and m |s| of pi.
void BorderedFacets::read(const TrajectoryProgram& program, TrajectorySolution& solution) const {
  const Zonotope& set = *program.instants.front().actuation;
  solution.value = tableau_.x[0];
  solution.y = tableau_.x.tail(program.border());
  solution.lambda.setZero(set.dimension(), program.size());
  solution.pi.setZero(program.size());
  solution.nu.setZero(program.R.rows());
  int line = 0;
  for (const Row& row : rows_) {
    if (!row.used) continue;
    const double m = tableau_.multipliers[line++];
    if (row.instant < 0) {
      solution.nu[row.index] = m;
    } else if (m != 0) {
      const double sign = row.side == 0 ? 1 : row.side;
      solution.lambda.col(row.instant) -= sign * m * set.N.col(row.index);
      solution.pi[row.instant] += m * row.slope;
    }
  }
}

}  // namespace maxwrench
