#include "solvers/plan/normal_matrix.h"

#include <algorithm>
#include <cmath>

#include "solvers/plan/forms.h"

namespace maxwrench {
namespace {

template <int D>
using StageBlock = Eigen::Map<Eigen::Matrix<double, D, D>>;
template <int D>
using ConstStageBlock = Eigen::Map<const Eigen::Matrix<double, D, D>>;
template <int D>
using ConstForms = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, D>>;

/// The lower triangle of A becomes L with A = L L', the inverse in the diagonal. A pivot below the
/// share `least` of its diagonal is none.
template <class Matrix>
void cholesky(Matrix& A, double least) {
  const Eigen::Index d = A.rows();
  for (Eigen::Index c = 0; c < d; ++c) {
    const double diagonal = A(c, c);
    double pivot = diagonal;
    for (Eigen::Index l = 0; l < c; ++l) pivot -= A(c, l) * A(c, l);
    const double inverse = pivot > least * diagonal ? 1 / std::sqrt(pivot) : 0;
    A(c, c) = inverse;
    for (Eigen::Index r = c + 1; r < d; ++r) {
      double sum = A(r, c);
      for (Eigen::Index l = 0; l < c; ++l) sum -= A(r, l) * A(c, l);
      A(r, c) = sum * inverse;
    }
  }
}

/// x = L^-1 x and x = L^-T x.
template <class Matrix, class Vector>
void solve_lower(const Matrix& L, Vector&& x) {
  for (Eigen::Index c = 0; c < L.rows(); ++c) {
    x[c] *= L(c, c);
    for (Eigen::Index r = c + 1; r < L.rows(); ++r) x[r] -= L(r, c) * x[c];
  }
}
template <class Matrix, class Vector>
void solve_upper(const Matrix& L, Vector&& x) {
  for (Eigen::Index c = L.rows() - 1; c >= 0; --c) {
    for (Eigen::Index r = c + 1; r < L.rows(); ++r) x[c] -= L(r, c) * x[r];
    x[c] *= L(c, c);
  }
}

}  // namespace

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

template <int D>
void NormalMatrix::assemble_stage(const Forms& forms, const Eigen::VectorXd& theta, int i) {
  const Forms::Stage& at = forms.stages[i];
  const ConstForms<D> F(forms.F.data() + at.F0, at.count, at.d);
  StageBlock<D> K(K_.data() + K0_[i], at.d, at.d);
  const auto weight = weight_.segment(at.f0, at.count);
  for (int c = 0; c < at.d; ++c) {
    auto column = weighted_.head(at.count);
    column = weight.cwiseProduct(F.col(c));
    for (int r = c; r < at.d; ++r) K(r, c) = F.col(r).dot(column);
  }
  if (forms.t == 0) return;
  const int last = at.count - 1;
  const double theta_t = theta[at.f0 + last];
  const int b = forms.t + forms.p;
  double* const E = E_.data() + E0_[i];
  for (int r = 0; r < at.d; ++r) E[r * b] = -theta_t * F(last, r);
  H_(0, 0) += theta_t;
}

/// K_i+1,i = -C_i+1' Theta C_i of the rates between them.
template <int D>
void NormalMatrix::couple(const Forms& forms, const Eigen::VectorXd& theta, int i) {
  const Forms::Stage& at = forms.stages[i];
  const Forms::Stage& next = forms.stages[i + 1];
  const ConstForms<D> F(forms.F.data() + at.F0, at.count, at.d);
  const Eigen::Map<const Eigen::MatrixXd> F_next = forms.F_of(next);
  double* const S = S_.data() + S0_[i];
  const auto rate = theta.segment(forms.rates0 + forms.rated * i, forms.rated);
  for (int c = 0; c < at.d; ++c) {
    auto column = weighted_.head(forms.rated);
    column = -rate.cwiseProduct(F.col(c).head(forms.rated));
    for (int r = 0; r < next.d; ++r) {
      S[c * next.d + r] = F_next.col(r).head(forms.rated).dot(column);
    }
  }
}

/// What the border's columns add: E = F'theta D of the stages and their rates, H += D'theta D.
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
  }
  stack_ = theta.head(forms.border0).cwiseSqrt().asDiagonal() * forms.D;
  H_.bottomRightCorner(p, p).selfadjointView<Eigen::Lower>().rankUpdate(stack_.transpose());
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
  Eigen::Map<RowMatrix> E(E_.data() + E0_[i], d, b);
  for (int c = 0; c < d; ++c) {
    E.row(c) *= L(c, c);
    for (int r = c + 1; r < d; ++r) E.row(r) -= L(r, c) * E.row(c);
  }
  if (i + 1 == forms.N || forms.rated == 0) return;
  const int next = forms.stages[i + 1].d;
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, D>> S(S_.data() + S0_[i], next, d);
  for (int c = 0; c < d; ++c) {
    S.col(c) *= L(c, c);
    for (int r = c + 1; r < d; ++r) S.col(r) -= L(r, c) * S.col(c);
  }
  StageBlock<Eigen::Dynamic> K_next(K_.data() + K0_[i + 1], next, next);
  for (int c = 0; c < next; ++c) {
    for (int l = 0; l < d; ++l) {
      const double factor = S(c, l);
      for (int r = c; r < next; ++r) K_next(r, c) -= S(r, l) * factor;
    }
  }
  Eigen::Map<RowMatrix> E_next(E_.data() + E0_[i + 1], next, b);
  if (b > 0) E_next.noalias() -= S.lazyProduct(E);
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
  for (Eigen::Index c = 0; c < X.cols(); ++c) {
    auto x = X.col(c).template segment<D>(at.x0, at.d);
    solve_lower(L, x);
    for (int r = 0; r < at.d && b > 0; ++r) X.col(c).tail(b) -= x[r] * E.row(r).transpose();
    if (i + 1 == forms.N || forms.rated == 0) continue;
    const int next = forms.stages[i + 1].d;
    const ConstForms<D> S(S_.data() + S0_[i], next, at.d);
    X.col(c).segment(at.x0 + at.d, next).noalias() -= S.lazyProduct(x);
  }
}

template <int D>
void NormalMatrix::backward(const Forms& forms, Columns X, int i) const {
  const Forms::Stage& at = forms.stages[i];
  const int b = forms.t + forms.p;
  const ConstStageBlock<D> L(K_.data() + K0_[i], at.d, at.d);
  const Eigen::Map<const RowMatrix> E(E_.data() + E0_[i], at.d, b);
  for (Eigen::Index c = 0; c < X.cols(); ++c) {
    auto x = X.col(c).template segment<D>(at.x0, at.d);
    for (int r = 0; r < at.d && b > 0; ++r) x[r] -= E.row(r).dot(X.col(c).tail(b));
    if (i + 1 < forms.N && forms.rated > 0) {
      const int next = forms.stages[i + 1].d;
      const ConstForms<D> S(S_.data() + S0_[i], next, at.d);
      x.noalias() -= S.transpose().lazyProduct(X.col(c).segment(at.x0 + at.d, next));
    }
    solve_upper(L, x);
  }
}

}  // namespace maxwrench
