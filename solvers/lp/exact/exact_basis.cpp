#include "solvers/lp/exact/exact_basis.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

#include "lib/math/farkas.h"
#include "solvers/lp/exact/rational_elimination.h"

namespace maxwrench {
namespace {

constexpr int kMostPivots = 1000;

/// max c'x, A x + s = b. The logical variables s are fixed at zero and come after the columns.
class ExactSimplex {
 public:
  ExactSimplex(const LinearProgram& program, const LpSolution& solution)
      : p_(program), m_(program.rows()), n_(program.cols()), states_(solution.basis) {
    const auto basics = std::count(states_.begin(), states_.end(), VariableState::kBasic);
    if (states_.size() != static_cast<std::size_t>(m_ + n_) || basics != m_) start_cold();
    settle();
  }

  LpProof run() {
    for (int j = 0; j < n_; ++j) {
      if (p_.l[j] > p_.u[j]) return verdict(Status::kInfeasible, RationalVector(at(m_)));
    }
    for (int pivot = 0; pivot < kMostPivots; ++pivot) {
      if (!solve_basis() && !restart()) return {};
      const int violated = first_violated();
      const int improving = first_improving();
      if (violated < 0 && improving < 0) return verdict(Status::kOptimal, {});
      // If the reduced costs have the right signs, the dual method preserves them; otherwise any
      // basis that fits may follow.
      const std::optional<LpProof> end =
          violated >= 0 ? dual_step(violated, improving < 0) : primal_step(improving);
      if (end) return *end;
    }
    LpProof proof;
    proof.status = Status::kBudgetExhausted;
    return proof;
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  bool has_lower(int j) const { return j >= n_ || p_.l[j] > -kInfiniteBound; }
  bool has_upper(int j) const { return j >= n_ || p_.u[j] < kInfiniteBound; }
  double lower(int j) const { return j < n_ ? p_.l[j] : 0; }
  double upper(int j) const { return j < n_ ? p_.u[j] : 0; }
  bool is_fixed(int j) const { return j >= n_ || p_.l[j] == p_.u[j]; }
  double cost(int j) const { return j < n_ ? p_.c[j] : 0; }

  VariableState resting(int j) const {
    if (has_lower(j)) return VariableState::kAtLower;
    return has_upper(j) ? VariableState::kAtUpper : VariableState::kFree;
  }

  void start_cold() {
    states_.resize(at(n_ + m_));
    for (int j = 0; j < n_ + m_; ++j) states_[at(j)] = j < n_ ? resting(j) : VariableState::kBasic;
  }

  /// Determines which variables are basic, and at which bound the others are.
  void settle() {
    basis_.clear();
    for (int j = 0; j < n_ + m_; ++j) {
      VariableState& state = states_[at(j)];
      if (state == VariableState::kBasic) {
        basis_.push_back(j);
        continue;
      }
      if (state == VariableState::kAtUpper && !has_upper(j)) state = VariableState::kAtLower;
      if (state == VariableState::kAtLower && !has_lower(j)) {
        state = has_upper(j) ? VariableState::kAtUpper : VariableState::kFree;
      }
      if (state == VariableState::kFree) state = resting(j);
    }
  }

  /// A basis that is singular in rational numbers is replaced by the logical variables.
  bool restart() {
    start_cold();
    settle();
    return solve_basis();
  }

  /// A column of [A I].
  SparseRow column(int j) const {
    if (j >= n_) return {{j - n_, 1}};
    SparseRow entries;
    for (Eigen::SparseMatrix<double>::InnerIterator it(p_.A, j); it; ++it) {
      if (it.value() != 0) entries[static_cast<int>(it.row())] = it.value();
    }
    return entries;
  }

  mpq_class times(const RationalVector& y, int j) const {
    mpq_class sum;
    for (const auto& [row, value] : column(j)) sum += value * y[at(row)];
    return sum;
  }

  /// Solves B x = rhs; x is ordered by positions in the basis.
  std::optional<RationalVector> solve_columns(const RationalVector& rhs) const {
    std::vector<SparseRow> rows(at(m_));
    for (int k = 0; k < m_; ++k) {
      for (const auto& [row, value] : column(basis_[at(k)])) rows[at(row)][k] = value;
    }
    return solve_rational(std::move(rows), rhs);
  }

  /// Solves B'y = rhs.
  std::optional<RationalVector> solve_rows(const RationalVector& rhs) const {
    std::vector<SparseRow> rows;
    for (const int j : basis_) rows.push_back(column(j));
    return solve_rational(std::move(rows), rhs);
  }

  bool solve_basis() {
    x_.assign(at(n_ + m_), 0);
    RationalVector rhs(at(m_)), costs;
    for (int i = 0; i < m_; ++i) rhs[at(i)] = p_.b[i];
    for (int j = 0; j < n_; ++j) {
      const VariableState state = states_[at(j)];
      if (state == VariableState::kBasic || state == VariableState::kFree) continue;
      x_[at(j)] = state == VariableState::kAtLower ? lower(j) : upper(j);
      if (x_[at(j)] == 0) continue;
      for (const auto& [row, value] : column(j)) rhs[at(row)] -= value * x_[at(j)];
    }
    for (const int j : basis_) costs.emplace_back(cost(j));
    const auto basic = solve_columns(rhs);
    const auto y = solve_rows(costs);
    if (!basic || !y) return false;
    for (int k = 0; k < m_; ++k) x_[at(basis_[at(k)])] = (*basic)[at(k)];
    y_ = *y;
    return true;
  }

  /// The position in the basis of the first variable that violates its bounds; -1 if there is none.
  int first_violated() const {
    int first = -1;
    for (int k = 0; k < m_; ++k) {
      const int j = basis_[at(k)];
      const bool leaves =
          (has_lower(j) && x_[at(j)] < lower(j)) || (has_upper(j) && x_[at(j)] > upper(j));
      if (leaves && (first < 0 || j < basis_[at(first)])) first = k;
    }
    return first;
  }

  mpq_class reduced_cost(int j) const { return cost(j) - times(y_, j); }

  /// Whether x_j may go up or down from its bound.
  bool may_move(int j, bool up) const {
    const VariableState state = states_[at(j)];
    if (state == VariableState::kBasic || is_fixed(j)) return false;
    return state == VariableState::kFree || (state == VariableState::kAtLower) == up;
  }

  int first_improving() const {
    for (int j = 0; j < n_; ++j) {
      const mpq_class d = reduced_cost(j);
      if (d != 0 && may_move(j, d > 0)) return j;
    }
    return -1;
  }

  void exchange(int place, int entering, VariableState left) {
    states_[at(basis_[at(place)])] = left;
    states_[at(entering)] = VariableState::kBasic;
    basis_[at(place)] = entering;
  }

  /// Moves x_p to the bound that it violates. `keep_signs` preserves the signs of the reduced
  /// costs.
  std::optional<LpProof> dual_step(int place, bool keep_signs) {
    const int p = basis_[at(place)];
    const bool rises = has_lower(p) && x_[at(p)] < lower(p);
    RationalVector unit(at(m_));
    unit[at(place)] = 1;
    const auto z = solve_rows(unit);
    int entering = -1;
    mpq_class least;
    for (int j = 0; j < n_; ++j) {
      const mpq_class alpha = times(*z, j);
      if (alpha == 0 || !may_move(j, (alpha < 0) == rises)) continue;
      const mpq_class ratio = keep_signs ? mpq_class(abs(reduced_cost(j) / alpha)) : mpq_class(0);
      if (entering >= 0 && ratio >= least) continue;
      entering = j;
      least = ratio;
    }
    if (entering >= 0) {
      exchange(place, entering, rises ? VariableState::kAtLower : VariableState::kAtUpper);
      return {};
    }
    RationalVector farkas = *z;
    if (rises) {
      for (mpq_class& each : farkas) each = -each;
    }
    return verdict(Status::kInfeasible, farkas);
  }

  /// Moves x_j until it or a basic variable reaches a bound.
  std::optional<LpProof> primal_step(int entering) {
    const bool up = reduced_cost(entering) > 0;
    RationalVector rhs(at(m_));
    for (const auto& [row, value] : column(entering)) rhs[at(row)] = up ? mpq_class(-value) : value;
    const RationalVector move = *solve_columns(rhs);  // change of the basic variables per unit
    int place = -1;
    mpq_class least;
    for (int k = 0; k < m_; ++k) {
      const int j = basis_[at(k)];
      const int sign = sgn(move[at(k)]);
      if (sign == 0 || !(sign > 0 ? has_upper(j) : has_lower(j))) continue;
      const mpq_class bound = sign > 0 ? upper(j) : lower(j);
      const mpq_class step = (bound - x_[at(j)]) / move[at(k)];
      if (place >= 0 && (step > least || (step == least && j > basis_[at(place)]))) continue;
      place = k;
      least = step;
    }
    const bool flips = has_lower(entering) && has_upper(entering);
    const mpq_class width =
        flips ? mpq_class(mpq_class(upper(entering)) - lower(entering)) : mpq_class(0);
    if (flips && (place < 0 || width <= least)) {
      states_[at(entering)] = up ? VariableState::kAtUpper : VariableState::kAtLower;
      return {};
    }
    if (place >= 0) {
      const bool at_upper = sgn(move[at(place)]) > 0;
      exchange(place, entering, at_upper ? VariableState::kAtUpper : VariableState::kAtLower);
      return {};
    }
    RationalVector ray(at(n_));
    ray[at(entering)] = up ? 1 : -1;
    for (int k = 0; k < m_; ++k) {
      if (basis_[at(k)] < n_) ray[at(basis_[at(k)])] = move[at(k)];
    }
    return verdict(Status::kUnbounded, ray);
  }

  LpProof verdict(Status status, const RationalVector& certificate) const {
    LpProof proof;
    proof.status = status;
    proof.certificate = certificate;
    if (status == Status::kInfeasible) return proof;
    proof.x.assign(x_.begin(), x_.begin() + n_);
    if (status == Status::kOptimal) proof.lambda = y_;
    return proof;
  }

  const LinearProgram& p_;
  int m_, n_;
  std::vector<VariableState> states_;
  std::vector<int> basis_;
  RationalVector x_, y_;
};

}  // namespace

LpProof exact_proof(const LinearProgram& program, const LpSolution& solution) {
  if (program.rows() > kMostExactRows) {
    throw std::invalid_argument("rows: got " + std::to_string(program.rows()) +
                                ", expected at most " + std::to_string(kMostExactRows) +
                                " for a proof in rational numbers");
  }
  return ExactSimplex(program, solution).run();
}

}  // namespace maxwrench
