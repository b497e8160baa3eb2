#include "solvers/plan/directions.h"

#include "solvers/plan/forms.h"
#include "solvers/plan/side.h"

namespace maxwrench {

void Directions::reserve(const Forms& forms, int columns) {
  const auto slacks = static_cast<Eigen::Index>(forms.slacks.size());
  split_ = slacks > 0;
  matrix_.reserve(forms);
  X.resize(forms.variables, columns);
  sigma.resize(slacks, columns);
  G.resize(forms.size, columns);
  if (split_) G_low.resize(forms.size, columns);
  weight.resize(forms.size);
  s_phi_.resize(slacks);
  s_diagonal_.resize(slacks);
}

void Directions::eliminate(const Forms& forms, const Side& low, const Side& high) {
  for (std::size_t i = 0; i < forms.slacks.size(); ++i) {
    const int f = forms.slacks[i];
    const double h = high.theta[f], l = low.theta[f];
    s_diagonal_[i] = h + l;
    s_phi_[i] = l - h;
    weight[f] = 4 * h * l / (h + l);
  }
}

void Directions::factor(const Forms& forms, double least_pivot) {
  matrix_.factor(forms, weight, least_pivot);
}

void Directions::solve(const Forms& forms, int first, int count) {
  for (int c = first; c < first + count; ++c) {
    for (std::size_t i = 0; i < forms.slacks.size(); ++i) {
      G(forms.slacks[i], c) -= s_phi_[i] / s_diagonal_[i] * sigma(i, c);
    }
  }
  auto X_c = X.middleCols(first, count);
  auto G_c = G.middleCols(first, count);
  forms.add_transposed(G_c, X_c);
  matrix_.solve(forms, X_c);
  forms.apply(X_c, G_c);
  if (!split_) return;
  G_low.middleCols(first, count) = G_c;
  for (int c = first; c < first + count; ++c) {
    for (std::size_t i = 0; i < forms.slacks.size(); ++i) {
      const int f = forms.slacks[i];
      double& moved = sigma(i, c);
      moved = (moved - s_phi_[i] * G(f, c)) / s_diagonal_[i];
      G(f, c) -= moved;
      G_low(f, c) += moved;
    }
  }
}

}  // namespace maxwrench
