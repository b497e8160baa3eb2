#include "solvers/trajectory/normal_matrix.h"

#include <algorithm>

#include "solvers/trajectory/forms.h"
#include "solvers/trajectory/small_blocks.h"

namespace maxwrench {

void NormalMatrix::reserve(const Forms& forms) {
  const int b = forms.t + forms.p;
  int K = 0, S = 0, E = 0, most = 0;
  K0_.resize(forms.N);
  S0_.resize(forms.N);
  E0_.resize(forms.N);
  for (int i = 0; i < forms.N; ++i) {
    const int d = forms.stages[i].d;
    K0_[i] = K;
    S0_[i] = S;
    E0_[i] = E;
    K += d * d;
    E += d * b;
    if (i + 1 < forms.N) S += d * forms.stages[i + 1].d;
    most = std::max(most, forms.stages[i].count);
  }
  K_.resize(K);
  S_.resize(S);
  E_.resize(E);
  H_.resize(b, b);
  weight_.resize(forms.size);
  weighted_.resize(most);
  stack_.resize(forms.border0, forms.p);
}

void NormalMatrix::factor(const Forms& forms, const Eigen::VectorXd& theta, double least_pivot) {
  least_pivot_ = least_pivot;
  assemble(forms, theta);
  for (int i = 0; i < forms.N; ++i) {
    with_dimension(forms.stages[i].d, [&]<int D>() { factor_stage<D>(forms, i); });
  }
  const int b = forms.t + forms.p;
  if (b == 1) {
    H_(0, 0) -= E_.squaredNorm();
  } else if (b > 0) {
    const Eigen::Map<const RowMatrix> E(E_.data(), E_.size() / b, b);
    H_.selfadjointView<Eigen::Lower>().rankUpdate(E.transpose(), -1);
  }
  cholesky(H_, least_pivot_);
}

void NormalMatrix::assemble(const Forms& forms, const Eigen::VectorXd& theta) {
  weight_ = theta;
  for (int i = 0; i + 1 < forms.N; ++i) {
    const auto rate = theta.segment(forms.rates0 + forms.rated * i, forms.rated);
    weight_.segment(forms.stages[i].f0, forms.rated) += rate;
    weight_.segment(forms.stages[i + 1].f0, forms.rated) += rate;
  }
  if (forms.lagged) add_commands(forms, theta);
  H_.setZero();
  if (forms.p > 0) E_.setZero();
  for (int i = 0; i < forms.N; ++i) {
    with_dimension(forms.stages[i].d, [&]<int D>() {
      assemble_stage<D>(forms, theta, i);
      if (i + 1 < forms.N && forms.rated > 0) couple<D>(forms, theta, i);
    });
  }
  if (forms.p > 0) border(forms, theta);
  if (forms.p > 0) border_limits(forms, theta);
}

/// (1 + lag) phi_i+1 - lag phi_i of the commands, beside phi_i+1 - phi_i of the rates.
void NormalMatrix::add_commands(const Forms& forms, const Eigen::VectorXd& theta) {
  coupling_.resize(forms.rated, forms.N - 1);
  for (int i = 0; i + 1 < forms.N; ++i) {
    for (int r = 0; r < forms.rated; ++r) {
      const double lag = forms.lag(r, i);
      const double command = theta[forms.commands0 + forms.rated * i + r];
      weight_[forms.stages[i].f0 + r] += lag * lag * command;
      weight_[forms.stages[i + 1].f0 + r] += (1 + lag) * (1 + lag) * command;
      coupling_(r, i) = theta[forms.rates0 + forms.rated * i + r] + lag * (1 + lag) * command;
    }
  }
}

template <int D>
void NormalMatrix::assemble_stage(const Forms& forms, const Eigen::VectorXd& theta, int i) {
  const Forms::Stage& at = forms.stages[i];
  const double* const F = forms.F.data() + at.F0;
  double* const K = K_.data() + K0_[i];
  const auto weight = weight_.segment(at.f0, at.count);
  if constexpr (D == Eigen::Dynamic) {
    const Eigen::Map<const Eigen::MatrixXd> F_i = forms.F_of(at);
    for (int c = 0; c < at.d; ++c) {
      auto column = weighted_.head(at.count);
      column = weight.cwiseProduct(F_i.col(c));
      for (int r = c; r < at.d; ++r) K[c * at.d + r] = F_i.col(r).dot(column);
    }
  } else {
    product<D>(F, at.count, F, at.count, weight.data(), at.count, 1, K);
  }
  if (forms.t == 0) return;
  const int b = forms.t + forms.p;
  double* const E = E_.data() + E0_[i];
  if (!at.has_t) {
    for (int r = 0; r < at.d; ++r) E[r * b] = 0;
    return;
  }
  const int last = at.count - 1;
  const double theta_t = theta[at.f0 + last];
  for (int r = 0; r < at.d; ++r) E[r * b] = -theta_t * F[r * at.count + last];
  H_(0, 0) += theta_t;
}

/// K_i+1,i = -C_i+1' Theta C_i of the rates and commands between them.
template <int D>
void NormalMatrix::couple(const Forms& forms, const Eigen::VectorXd& theta, int i) {
  const Forms::Stage& at = forms.stages[i];
  const Forms::Stage& next = forms.stages[i + 1];
  double* const S = S_.data() + S0_[i];
  const Eigen::Map<const Eigen::VectorXd> rate(
      forms.lagged ? coupling_.col(i).data() : theta.data() + forms.rates0 + forms.rated * i,
      forms.rated);
  if (D == Eigen::Dynamic || next.d != at.d) {
    const auto C = forms.F_of(at).topRows(forms.rated);
    const auto C_next = forms.F_of(next).topRows(forms.rated);
    for (int c = 0; c < at.d; ++c) {
      auto column = weighted_.head(forms.rated);
      column = -rate.cwiseProduct(C.col(c));
      for (int r = 0; r < next.d; ++r) S[c * next.d + r] = C_next.col(r).dot(column);
    }
  } else if constexpr (D != Eigen::Dynamic) {
    product<D>(forms.F.data() + next.F0, next.count, forms.F.data() + at.F0, at.count, rate.data(),
               forms.rated, -1, S);
  }
}

/// Adds the border's columns: E = F'theta D of the stages and their rates, H += D'theta D.
void NormalMatrix::border(const Forms& forms, const Eigen::VectorXd& theta) {
  const int p = forms.p, b = forms.t + p;
  stack_ = theta.head(forms.border0).asDiagonal() * forms.D;
  const auto add = [&](int stage, int from, int count, double sign) {
    const Forms::Stage& at = forms.stages[stage];
    Eigen::Map<RowMatrix> E(E_.data() + E0_[stage], at.d, b);
    const auto F = forms.F_of(at);
    for (int c = 0; c < at.d; ++c) {
      for (int r = 0; r < count; ++r) {
        E.row(c).tail(p) += (sign * F(r, c)) * stack_.row(from + r);
      }
    }
  };
  for (int i = 0; i < forms.N; ++i) {
    add(i, forms.stages[i].f0, forms.stages[i].count, 1);
    if (i + 1 == forms.N || forms.rated == 0) continue;
    add(i, forms.rates0 + forms.rated * i, forms.rated, -1);
    add(i + 1, forms.rates0 + forms.rated * i, forms.rated, 1);
    if (forms.lagged) border_commands(forms, i);
  }
  stack_ = theta.head(forms.border0).cwiseSqrt().asDiagonal() * forms.D;
  H_.bottomRightCorner(p, p).selfadjointView<Eigen::Lower>().rankUpdate(stack_.transpose());
}

/// Adds the border's columns of the commands from instant i to the next one: E += F'theta D.
void NormalMatrix::border_commands(const Forms& forms, int i) {
  const int p = forms.p, b = forms.t + p, first = forms.commands0 + forms.rated * i;
  for (const int to : {0, 1}) {
    const Forms::Stage& at = forms.stages[i + to];
    Eigen::Map<RowMatrix> E(E_.data() + E0_[i + to], at.d, b);
    const auto F = forms.F_of(at);
    for (int c = 0; c < at.d; ++c) {
      for (int r = 0; r < forms.rated; ++r) {
        const double factor = to == 1 ? 1 + forms.lag(r, i) : -forms.lag(r, i);
        E.row(c).tail(p) += (factor * F(r, c)) * stack_.row(first + r);
      }
    }
  }
}

void NormalMatrix::border_limits(const Forms& forms, const Eigen::VectorXd& theta) {
  const int p = forms.p;
  auto H = H_.bottomRightCorner(p, p);
  H.diagonal() += theta.segment(forms.border0, p);
  const Eigen::SparseMatrix<double>& R = *forms.R;
  if (R.rows() == 0) return;
  using Entry = Eigen::SparseMatrix<double>::InnerIterator;
  const double* const weight = theta.data() + forms.border0 + p;
  for (int c = 0; c < p; ++c) {
    row_.setZero(R.rows());
    for (Entry at(R, c); at; ++at) row_[at.row()] = weight[at.row()] * at.value();
    for (int r = c; r < p; ++r) {
      for (Entry at(R, r); at; ++at) H(r, c) += at.value() * row_[at.row()];
    }
  }
}

template <int D>
void NormalMatrix::factor_stage(const Forms& forms, int i) {
  const int d = forms.stages[i].d;
  const int b = forms.t + forms.p;
  StageBlock<D> L(K_.data() + K0_[i], d, d);
  cholesky(L, least_pivot_);
  double* const E = E_.data() + E0_[i];
  if (b == 1) {
    StageColumn<D> e(E, d);
    solve_lower(L, e);
  } else {
    Eigen::Map<RowMatrix> rows(E, d, b);
    for (int c = 0; c < d; ++c) {
      rows.row(c) *= L(c, c);
      for (int r = c + 1; r < d; ++r) rows.row(r) -= L(r, c) * rows.row(c);
    }
  }
  if (i + 1 == forms.N || forms.rated == 0) return;
  const int next = forms.stages[i + 1].d;
  if (next == d) return factor_coupling<D, D>(forms, i);
  factor_coupling<D, Eigen::Dynamic>(forms, i);
}

/// S = K_i+1,i L^-T, and subtracts its contribution from the next stage.
template <int D, int Next>
void NormalMatrix::factor_coupling(const Forms& forms, int i) {
  const int d = forms.stages[i].d, next = forms.stages[i + 1].d;
  const int b = forms.t + forms.p;
  const StageBlock<D> L(K_.data() + K0_[i], d, d);
  Eigen::Map<Eigen::Matrix<double, Next, D>> S(S_.data() + S0_[i], next, d);
  for (int c = 0; c < d; ++c) {
    S.col(c) *= L(c, c);
    for (int r = c + 1; r < d; ++r) S.col(r) -= L(r, c) * S.col(c);
  }
  StageBlock<Next> K(K_.data() + K0_[i + 1], next, next);
  if constexpr (Next > 4) {
    constexpr int kLate = Next - 4;  // nothing above the last columns is needed
    K.template leftCols<4>() -= S.lazyProduct(S.template topRows<4>().transpose());
    const auto late = S.template bottomRows<kLate>();
    K.template bottomRightCorner<kLate, kLate>() -= late.lazyProduct(late.transpose());
  } else {
    K.noalias() -= S.lazyProduct(S.transpose());
  }
  if (b == 0) return;
  double* const E = E_.data();
  if (b == 1) {
    StageColumn<Next>(E + E0_[i + 1], next).noalias() -=
        S.lazyProduct(ConstStageColumn<D>(E + E0_[i], d));
  } else {
    Eigen::Map<RowMatrix>(E + E0_[i + 1], next, b).noalias() -=
        S.lazyProduct(Eigen::Map<const RowMatrix>(E + E0_[i], d, b));
  }
}

void NormalMatrix::solve(const Forms& forms, Columns X) const {
  const int b = forms.t + forms.p;
  for (int i = 0; i < forms.N; ++i) {
    with_dimension(forms.stages[i].d, [&]<int D>() { forward<D>(forms, X, i); });
  }
  for (Eigen::Index c = 0; c < X.cols(); ++c) {
    solve_lower(H_, X.col(c).tail(b));
    solve_upper(H_, X.col(c).tail(b));
  }
  for (int i = forms.N - 1; i >= 0; --i) {
    with_dimension(forms.stages[i].d, [&]<int D>() { backward<D>(forms, X, i); });
  }
}

template <int D>
void NormalMatrix::forward(const Forms& forms, Columns X, int i) const {
  const Forms::Stage& at = forms.stages[i];
  const int b = forms.t + forms.p;
  const ConstStageBlock<D> L(K_.data() + K0_[i], at.d, at.d);
  const Eigen::Map<const RowMatrix> E(E_.data() + E0_[i], at.d, b);
  const int next = i + 1 < forms.N && forms.rated > 0 ? forms.stages[i + 1].d : 0;
  for (Eigen::Index c = 0; c < X.cols(); ++c) {
    double* const place = X.col(c).data() + at.x0;
    StageVector<D> x(place, at.d);
    solve_lower(L, x);
    if (b == 1) {
      double sum = 0;
      for (int r = 0; r < x.size(); ++r) sum += E(r, 0) * x[r];
      X(forms.z0(), c) -= sum;
    } else {
      for (int r = 0; r < x.size() && b > 0; ++r) X.col(c).tail(b) -= x[r] * E.row(r).transpose();
    }
    x.store(place);
    if (next == at.d) {
      subtract_product<D>(S_.data() + S0_[i], next, x, place + at.d);
    } else if (next > 0) {
      subtract_product<Eigen::Dynamic>(S_.data() + S0_[i], next, x, place + at.d);
    }
  }
}

template <int D>
void NormalMatrix::backward(const Forms& forms, Columns X, int i) const {
  const Forms::Stage& at = forms.stages[i];
  const int b = forms.t + forms.p;
  const ConstStageBlock<D> L(K_.data() + K0_[i], at.d, at.d);
  const Eigen::Map<const RowMatrix> E(E_.data() + E0_[i], at.d, b);
  const int next = i + 1 < forms.N && forms.rated > 0 ? forms.stages[i + 1].d : 0;
  for (Eigen::Index c = 0; c < X.cols(); ++c) {
    double* const place = X.col(c).data() + at.x0;
    StageVector<D> x(place, at.d);
    if (b == 1) {
      const double t = X(forms.z0(), c);
      for (int r = 0; r < x.size(); ++r) x[r] -= E(r, 0) * t;
    } else {
      for (int r = 0; r < x.size() && b > 0; ++r) x[r] -= E.row(r).dot(X.col(c).tail(b));
    }
    if (next == at.d) {
      subtract_transposed<D>(S_.data() + S0_[i], next, place + at.d, x);
    } else if (next > 0) {
      subtract_transposed<Eigen::Dynamic>(S_.data() + S0_[i], next, place + at.d, x);
    }
    solve_upper(L, x);
    x.store(place);
  }
}

}  // namespace maxwrench
