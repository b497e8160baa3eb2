#include "solvers/trajectory/forms.h"

#include <algorithm>
#include <cmath>

#include "lib/math/decompositions.h"
#include "solvers/trajectory/small_blocks.h"

namespace maxwrench {
namespace {

/// An interval narrower than this, relative to 1 + its end, counts as an equation.
constexpr double kWidth = 1e-11;

}  // namespace

void Forms::build(const TrajectoryProgram& program, bool with_rates, bool with_slacks) {
  const Zonotope& set = *program.instants.front().actuation;
  actuation_ = &set;
  if (B_.rows() != set.B.rows() || B_.cols() != set.B.cols() || B_ != set.B) {
    B_ = set.B;
    const Svd parts = svd(set.B);
    Z_ = parts.V.rightCols(set.actuators() - set.rank);
    P_ = parts.U.rightCols(set.dimension() - set.rank);
  }
  R = &program.R;
  shape(program, with_rates, with_slacks);
  fill(program);
}

void Forms::shape(const TrajectoryProgram& program, bool with_rates, bool with_slacks) {
  const int m = actuation_->actuators();
  const int n = actuation_->dimension();
  N = program.size();
  t = program.peak < 0 ? 1 : 0;
  p = program.border();
  order_actuators(program, with_rates);
  offsets_.resize(m, N);
  slopes_.resize(m, N);
  stages.resize(N);
  Stage next;
  for (int i = 0; i < N; ++i) {
    const WrenchProgram& at = program.instants[i];
    const int k = at.columns();
    next.elastic = with_slacks && program.slackens(i);
    next.has_t = program.bounds_value(i);
    stages[i] = next;
    merge(program, i);
    next = stages[i];
    next.efforts = next.merged() ? m - lone : m;
    next.w0 = next.efforts + (next.merged() ? 1 : 0);
    next.w_count = 0;
    for (int j = 0; j < k; ++j) next.w_count += has_limits(at, j);
    next.w = next.elastic ? n : 0;
    next.d = next.w + k + static_cast<int>(Z_.cols());
    next.count =
        next.w0 + next.w_count + next.w + static_cast<int>(P_.cols()) + (next.has_t ? 1 : 0);
    stages[i] = next;
    next.x0 += next.d;
    next.f0 += next.count;
    next.F0 += next.d * next.count;
  }
  variables = next.x0 + t + p;
  rates0 = next.f0;
  commands0 = rates0 + rated * (N - 1);
  border0 = commands0 + (lagged ? rated * (N - 1) : 0);
  size = border0 + p + static_cast<int>(program.R.rows());
  F.setZero(next.F0);
  D.setZero(border0, p);
  for (Eigen::VectorXd* v : {&lo, &hi, &has_lo, &has_hi}) v->setZero(size);
  scale.setOnes(size);
  cost.setZero(variables);
}

void Forms::fill(const TrajectoryProgram& program) {
  slacks.clear();
  equations.clear();
  for (int i = 0; i < N; ++i) fill_stage(program, i);
  fill_rates(program);
  if (lagged) fill_commands(program);
  if (p > 0) fill_border(program);
  if (t > 0) cost[z0()] = 1;
  if (t == 0)
    cost.segment(stages[program.peak].x0 + stages[program.peak].w,
                 program.instants[program.peak].columns()) = program.instants[program.peak].c_w;
}

/// low <= phi + offset <= high.
void Forms::limit(int form, double low, double high, double offset) {
  if (std::abs(high) < kInfiniteBound && high - low <= kWidth * (1 + std::abs(high))) {
    hi[form] = 0.5 * (low + high) - offset;
    equations.push_back(form);
    return;
  }
  has_lo[form] = low > -kInfiniteBound;
  has_hi[form] = high < kInfiniteBound;
  if (has_lo[form] != 0) lo[form] = low - offset;
  if (has_hi[form] != 0) hi[form] = high - offset;
  if (has_lo[form] != 0 && has_hi[form] != 0) scale[form] = 0.5 * (high - low);
}

void Forms::fill_stage(const TrajectoryProgram& program, int i) {
  const Stage& at = stages[i];
  const WrenchProgram& data = program.instants[i];
  Eigen::Map<Eigen::MatrixXd> F_i(F.data() + at.F0, at.count, at.d);
  fill_efforts(program, i);
  if (P_.cols() > 0) fill_unreached(program, i);
  for (int r = 0; r < at.w; ++r) {
    const int form = at.w0 + at.w_count + r;
    F_i(form, r) = 1;
    has_lo[at.f0 + form] = has_hi[at.f0 + form] = 1;
    slacks.push_back(at.f0 + form);
  }
  for (int r = 0; r < at.efforts; ++r) {
    const int j = order[r];
    limit(at.f0 + r, program.u_min(j, i), program.u_max(j, i), offsets_(j, i));
  }
  if (at.merged()) {
    F_i(at.efforts, at.w) = 1;
    limit(at.f0 + at.efforts, end_of_w(program, i, at.lowest, false),
          end_of_w(program, i, at.highest, true), 0);
  }
  int row = at.w0;
  for (int j = 0; j < data.columns(); ++j) {
    if (!has_limits(data, j)) continue;
    F_i(row, at.w + j) = 1;
    limit(at.f0 + row++, data.w_min[j], data.w_max[j], 0);
  }
  if (!at.has_t) return;
  F_i.row(at.count - 1).segment(at.w, data.columns()) = data.c_w.transpose();
  if (program.common) {
    equations.push_back(at.f0 + at.count - 1);
  } else {
    has_lo[at.f0 + at.count - 1] = 1;
  }
}

/// u = B^+ (tau_d + J'W w - G y - s) + Z v.
void Forms::fill_efforts(const TrajectoryProgram& program, int i) {
  const Stage& at = stages[i];
  const WrenchProgram& data = program.instants[i];
  Eigen::Map<Eigen::MatrixXd> F_i(F.data() + at.F0, at.count, at.d);
  const int m = at.efforts;
  F_i.topLeftCorner(m, at.w) = -B_pinv_.topLeftCorner(m, at.w);
  if (data.columns() == 1) {
    F_i.col(at.w).head(m) = slopes_.col(i).head(m);
  } else {
    F_i.block(0, at.w, m, data.columns()).noalias() = B_pinv_.lazyProduct(data.JtW);
  }
  F_i.topRightCorner(m, Z_.cols()) = Z_ordered_.topRows(m);
  if (p > 0) D.middleRows(at.f0, m).noalias() = -B_pinv_ * program.G[i];
}

/// The directions that B does not reach: P'(J'W w - G y - s) = -P'tau_d.
void Forms::fill_unreached(const TrajectoryProgram& program, int i) {
  const Stage& at = stages[i];
  const WrenchProgram& data = program.instants[i];
  Eigen::Map<Eigen::MatrixXd> F_i(F.data() + at.F0, at.count, at.d);
  const int first = at.w0 + at.w_count + at.w;
  for (int q = 0; q < P_.cols(); ++q) {
    const auto row = P_.col(q).transpose();
    F_i.row(first + q).head(at.w) = -row.head(at.w);
    F_i.row(first + q).segment(at.w, data.columns()).noalias() = row.lazyProduct(data.JtW);
    if (p > 0) D.row(at.f0 + first + q).noalias() = -row.lazyProduct(program.G[i]);
    hi[at.f0 + first + q] = -row.dot(data.tau_d);
    equations.push_back(at.f0 + first + q);
  }
}

void Forms::fill_rates(const TrajectoryProgram& program) {
  for (int i = 0; i + 1 < N; ++i) {
    for (int r = 0; r < rated; ++r) {
      const int j = order[r];
      const double most = program.du_max(j, i);
      limit(rates0 + rated * i + r, -most, most, offsets_(j, i + 1) - offsets_(j, i));
    }
    D.middleRows(rates0 + rated * i, rated) =
        D.middleRows(stages[i + 1].f0, rated) - D.middleRows(stages[i].f0, rated);
  }
}

/// (1 + lag) u_i+1 - lag u_i; an effort without lag has no limits here.
void Forms::fill_commands(const TrajectoryProgram& program) {
  lag.resize(rated, N - 1);
  for (int i = 0; i + 1 < N; ++i) {
    const int first = commands0 + rated * i, from = stages[i].f0, to = stages[i + 1].f0;
    for (int r = 0; r < rated; ++r) {
      const int j = order[r];
      lag(r, i) = program.lag(j, i);
      if (p > 0) D.row(first + r) = (1 + lag(r, i)) * D.row(to + r) - lag(r, i) * D.row(from + r);
      if (!program.lags(j, i)) continue;
      limit(first + r, program.u_min(j, i + 1), program.u_max(j, i + 1),
            offsets_(j, i + 1) + lag(r, i) * (offsets_(j, i + 1) - offsets_(j, i)));
    }
  }
}

void Forms::fill_border(const TrajectoryProgram& program) {
  for (int j = 0; j < p; ++j) limit(border0 + j, program.y_min[j], program.y_max[j], 0);
  for (int r = 0; r < R->rows(); ++r) {
    limit(border0 + p + r, program.r_min[r], program.r_max[r], 0);
  }
}

void Forms::apply(const Columns& X, Columns phi) const {
  for (const Stage& at : stages) {
    with_dimension(at.d, [&]<int d>() {
      for (Eigen::Index c = 0; c < X.cols(); ++c) {
        map_stage<d>(F_of(at), X.col(c).data() + at.x0, phi.col(c).data() + at.f0);
        if (at.has_t) phi(at.f0 + at.count - 1, c) -= X(z0(), c);
      }
    });
  }
  for (Eigen::Index c = 0; c < X.cols(); ++c) {
    auto out = phi.col(c);
    const auto y = X.col(c).tail(p);
    if (p > 0) out.head(rates0).noalias() += D.topRows(rates0) * y;
    for (int i = 0; rated > 0 && i + 1 < N; ++i) {
      out.segment(rates0 + rated * i, rated) =
          out.segment(stages[i + 1].f0, rated) - out.segment(stages[i].f0, rated);
    }
    for (int i = 0; lagged && i + 1 < N; ++i) {
      out.segment(commands0 + rated * i, rated) =
          out.segment(stages[i + 1].f0, rated) +
          lag.col(i).cwiseProduct(out.segment(rates0 + rated * i, rated));
    }
    if (p > 0) out.segment(border0, p) = y;
    if (R->rows() > 0) out.tail(R->rows()).noalias() = *R * y;
  }
}

void Forms::add_transposed(Columns g, Columns X) const {
  for (Eigen::Index c = 0; c < X.cols(); ++c) {
    auto in = g.col(c);
    for (int i = 0; lagged && i + 1 < N; ++i) {
      const auto command = in.segment(commands0 + rated * i, rated);
      in.segment(stages[i + 1].f0, rated) += command;
      in.segment(rates0 + rated * i, rated) += lag.col(i).cwiseProduct(command);
    }
    for (int i = 0; rated > 0 && i + 1 < N; ++i) {
      const auto rate = in.segment(rates0 + rated * i, rated);
      in.segment(stages[i + 1].f0, rated) += rate;
      in.segment(stages[i].f0, rated) -= rate;
    }
    if (p > 0) X.col(c).tail(p).noalias() += D.topRows(rates0).transpose() * in.head(rates0);
    if (p > 0) X.col(c).tail(p) += in.segment(border0, p);
    if (R->rows() > 0) X.col(c).tail(p).noalias() += R->transpose() * in.tail(R->rows());
  }
  for (const Stage& at : stages) {
    with_dimension(at.d, [&]<int d>() {
      for (Eigen::Index c = 0; c < X.cols(); ++c) {
        const double* const in = g.col(c).data() + at.f0;
        add_transposed_stage<d>(F_of(at), in, X.col(c).data() + at.x0);
        if (at.has_t) X(z0(), c) -= in[at.count - 1];
      }
    });
  }
}

bool Forms::keeps_rates(const TrajectoryProgram& program, const Eigen::VectorXd& phi,
                        double tau) const {
  const int m = static_cast<int>(order.size()) - lone;
  for (int i = 0; i + 1 < N; ++i) {
    const int from = stages[i].f0, to = stages[i + 1].f0;
    for (int r = 0; r < m; ++r) {
      const int j = order[r];
      const double change = phi[to + r] - phi[from + r];
      const double constant = offsets_(j, i + 1) - offsets_(j, i);
      if (!(std::abs(change + tau * constant) <= tau * program.du_max(j, i))) return false;
      if (!program.lags(j, i)) continue;
      const double command =
          phi[to + r] + tau * offsets_(j, i + 1) + program.lag(j, i) * (change + tau * constant);
      const double low = program.u_min(j, i + 1), high = program.u_max(j, i + 1);
      if (!(tau * low <= command && command <= tau * high)) return false;
    }
  }
  return true;
}

}  // namespace maxwrench
