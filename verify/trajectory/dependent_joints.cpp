#include <Eigen/LU>
#include <algorithm>

#include "verify/coordinates.h"
#include "verify/trajectory/trajectory_model.h"

// The dependent joints of a moving robot, enclosed in time.

namespace maxwrench {
namespace {

/// A part between two given places is cut in halves this often at most.
constexpr int kMostCellCuts = 12;
/// [rad or m] Boxes begin with this half width, and no wider ones are tried than the second one.
constexpr double kFirstWidth = 1e-9, kMostWidth = 0.5;
constexpr int kMostGrowths = 40, kNewtonSteps = 20, kRefinements = 3;
/// A box is contracted until that leaves more than a share of its width.
constexpr int kMostContractions = 8;
constexpr double kWorthContracting = 0.8;
/// Larger numbers stand for joints that are not enclosed: no limit holds then, and slices are cut.
constexpr double kUnknown = 1e20;

using NarrowBox = std::vector<Narrow>;

double middle_of(const Narrow& x) { return (x.low + x.high) / 2; }

Eigen::VectorXd middles(const NarrowBox& box) {
  Eigen::VectorXd q(static_cast<Eigen::Index>(box.size()));
  for (std::size_t i = 0; i < box.size(); ++i) q[static_cast<Eigen::Index>(i)] = middle_of(box[i]);
  return q;
}

double width_of(const NarrowBox& box) {
  double width = 0;
  for (const Narrow& x : box) width = std::max(width, x.high - x.low);
  return width;
}

bool lies_in(const NarrowBox& inner, const NarrowBox& outer) {
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (!(inner[i].low > outer[i].low && inner[i].high < outer[i].high)) return false;
  }
  return true;
}

std::vector<Jet<1>> constants(const NarrowBox& box) { return {box.begin(), box.end()}; }

/// An approximate inverse of the middles of M; empty if there is none.
Eigen::MatrixXd inverse_of_middles(const std::vector<NarrowBox>& M) {
  const auto n = static_cast<Eigen::Index>(M.size());
  Eigen::MatrixXd middle(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    middle.row(i) = middles(M[static_cast<std::size_t>(i)]).transpose();
  }
  Eigen::MatrixXd inverse = middle.inverse();
  if (!inverse.allFinite()) return {};
  return inverse;
}

/// Y x, for numbers Y.
NarrowBox product(const Eigen::MatrixXd& Y, const NarrowBox& x) {
  NarrowBox y(x.size());
  for (std::size_t i = 0; i < y.size(); ++i) {
    for (std::size_t j = 0; j < x.size(); ++j) {
      y[i] += Y(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * x[j];
    }
  }
  return y;
}

/// 1 - Y A.
std::vector<NarrowBox> deviation(const Eigen::MatrixXd& Y, const std::vector<NarrowBox>& A) {
  const std::size_t n = A.size();
  std::vector<NarrowBox> off(n, NarrowBox(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      Narrow sum(i == j ? 1.0 : 0.0);
      for (std::size_t k = 0; k < n; ++k) {
        sum -= Y(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) * A[k][j];
      }
      off[i][j] = sum;
    }
  }
  return off;
}

/// b + off x.
NarrowBox affine(const NarrowBox& b, const std::vector<NarrowBox>& off, const NarrowBox& x) {
  NarrowBox y = b;
  for (std::size_t i = 0; i < y.size(); ++i) {
    for (std::size_t j = 0; j < x.size(); ++j) y[i] += off[i][j] * x[j];
  }
  return y;
}

/// Encloses the solutions of x = b + off x; empty if the norm of `off` is not well below one.
NarrowBox solve_near_one(const NarrowBox& b, const std::vector<NarrowBox>& off) {
  double norm = 0, size = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    Narrow sum;
    for (const Narrow& entry : off[i]) sum += Narrow(entry.magnitude());
    norm = std::max(norm, sum.high);
    size = std::max(size, b[i].magnitude());
  }
  if (!(norm < 0.9) || !(size < kUnknown)) return {};
  const double most = (Narrow(size) / (Narrow(1.0) - Narrow(norm))).high;
  NarrowBox x(b.size(), Narrow(-most, most));
  for (int i = 0; i < kRefinements; ++i) x = affine(b, off, x);
  return x;
}

}  // namespace

int dependent_equations(const Problem& problem) {
  const Robot& robot = problem.robot;
  // A base that turns about another axis would have other equations.
  if (is_free(robot, 3) || is_free(robot, 4)) return 0;
  int count = is_free(robot, 5) ? 2 : 3;
  for (int axis = 0; axis < 3; ++axis) count += is_free(robot, axis) ? 0 : 1;
  return count;
}

/// Where the base's pose is that of its free axes: no displacement along the others, and a rotation
/// about the yaw alone, or none. A half turn about another axis satisfies the latter, too
/// (`is_upright`).
template <int N>
std::vector<Jet<N>> TrajectoryModel::equations(const Frame<N>& tool, std::vector<Jet<N>> q,
                                               const std::vector<Jet<N>>& dependent) const {
  for (std::size_t k = 0; k < dependent.size(); ++k) {
    q[static_cast<std::size_t>(problem_.dependent[k])] = dependent[k];
  }
  const auto [R, p] = from_mount(base_of(tool, q));
  std::vector<Jet<N>> F;
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_free(problem_.robot, axis)) F.push_back(p[static_cast<std::size_t>(axis)]);
  }
  if (is_free(problem_.robot, 5)) {
    F.push_back(R[0][2]);
    F.push_back(R[1][2]);
  } else {
    F.push_back(R[2][1] - R[1][2]);
    F.push_back(R[0][2] - R[2][0]);
    F.push_back(R[1][0] - R[0][1]);
  }
  return F;
}

auto TrajectoryModel::place_at(int interval, const Narrow& x) const -> Place {
  Motion<3> motion;
  move_tool(interval, x, motion);
  Place at;
  for (std::size_t i = 0; i < 3; ++i) {
    at.tool.p[i] = motion.tool.p[i].c[0];
    for (std::size_t j = 0; j < 3; ++j) at.tool.R[i][j] = motion.tool.R[i][j].c[0];
  }
  for (const Jet<3>& q : joints_of_theta_r<3>(interval, x)) at.q.emplace_back(q.c[0]);
  return at;
}

bool TrajectoryModel::is_upright(const Place& at, const NarrowBox& X) const {
  std::vector<Jet<1>> q = at.q;
  for (std::size_t k = 0; k < X.size(); ++k) {
    q[static_cast<std::size_t>(problem_.dependent[k])] = X[k];
  }
  const JetMatrix<1> R = from_mount(base_of(at.tool, q)).R;
  if (is_free(problem_.robot, 5)) return R[2][2].c[0].low > 0;
  return (R[0][0].c[0] + R[1][1].c[0] + R[2][2].c[0]).low > 0;
}

/// The derivatives of the equations by the dependent joints, row by row.
auto TrajectoryModel::equation_slopes(const Place& at, const NarrowBox& X) const
    -> std::vector<NarrowBox> {
  std::vector<NarrowBox> A(X.size(), NarrowBox(X.size()));
  for (std::size_t j = 0; j < X.size(); ++j) {
    std::vector<Jet<1>> dependent = constants(X);
    dependent[j].c[1] = 1.0;
    const std::vector<Jet<1>> F = equations(at.tool, at.q, dependent);
    for (std::size_t i = 0; i < F.size(); ++i) A[i][j] = F[i].c[1];
  }
  return A;
}

/// Krawczyk's operator: with m the middle of X and Y an inverse of the slopes,
///
///     K(X) = m - Y F(m) + (1 - Y F'(X)) (X - m).
///
/// It contains each solution in X. If it lies inside X, there is exactly one in X for each instant.
auto TrajectoryModel::krawczyk(const Place& at, const NarrowBox& X) const
    -> std::optional<NarrowBox> {
  const std::vector<NarrowBox> A = equation_slopes(at, X);
  const Eigen::MatrixXd Y = inverse_of_middles(A);
  if (Y.size() == 0) return std::nullopt;
  NarrowBox m, F, offset, b;
  for (const Narrow& x : X) {
    m.emplace_back(middle_of(x));
    offset.push_back(x - m.back());
  }
  for (const Jet<1>& f : equations(at.tool, at.q, constants(m))) F.push_back(f.c[0]);
  const NarrowBox step = product(Y, F);
  for (std::size_t i = 0; i < m.size(); ++i) b.push_back(m[i] - step[i]);
  return affine(b, deviation(Y, A), offset);
}

/// A box with exactly one solution at each instant of a stretch of time.
auto TrajectoryModel::enclose(const Place& at, const Eigen::VectorXd& near) const
    -> std::optional<NarrowBox> {
  NarrowBox X;
  for (const double q : near) X.emplace_back(q - kFirstWidth, q + kFirstWidth);
  for (int growth = 0; growth < kMostGrowths; ++growth) {
    const std::optional<NarrowBox> K = krawczyk(at, X);
    if (!K) return std::nullopt;
    if (lies_in(*K, X)) return X;
    for (std::size_t i = 0; i < X.size(); ++i) {
      const double low = std::min(X[i].low, (*K)[i].low), high = std::max(X[i].high, (*K)[i].high);
      const double more = 0.1 * (high - low);
      if (!(high - low < kMostWidth)) return std::nullopt;
      X[i] = {low - more, high + more};
    }
  }
  return std::nullopt;
}

/// Newton's method in ordinary arithmetic. Nothing relies on its result.
Eigen::VectorXd TrajectoryModel::newton(const Place& at, Eigen::VectorXd q) const {
  for (int i = 0; i < kNewtonSteps; ++i) {
    NarrowBox point(q.begin(), q.end()), F;
    for (const Jet<1>& f : equations(at.tool, at.q, constants(point))) F.push_back(f.c[0]);
    const Eigen::MatrixXd Y = inverse_of_middles(equation_slopes(at, point));
    if (Y.size() == 0) break;
    const Eigen::VectorXd step = Y * middles(F);
    q -= step;
    if (!(step.lpNorm<Eigen::Infinity>() > 1e-13)) break;
  }
  return q;
}

void TrajectoryModel::make_tube(const Eigen::MatrixXd& dependent) {
  const Eigen::Index intervals = curve_.intervals(), parts = (dependent.cols() - 1) / intervals;
  if (dependent.rows() != static_cast<Eigen::Index>(problem_.dependent.size()) || parts < 1 ||
      dependent.cols() != parts * intervals + 1 || !dependent.allFinite()) {
    lost_ = {"the dependent joints are not given at equal parts of each interval", 0};
    return;
  }
  tube_.resize(static_cast<std::size_t>(intervals));
  const auto whole = static_cast<double>(parts);
  for (int i = 0; i < curve_.intervals(); ++i) {
    for (Eigen::Index j = 0; j < parts; ++j) {
      const Eigen::Index column = i * parts + j;
      const Eigen::VectorXd near = (dependent.col(column) + dependent.col(column + 1)) / 2;
      const double from = static_cast<double>(j) / whole, to = static_cast<double>(j + 1) / whole;
      if (make_cells(i, from, to, near, 0)) continue;
      if (lost_.reason.empty()) {
        lost_ = {"the dependent joints may have no solution or several", time(i, from)};
      }
      return;
    }
  }
  join_cells();
}

bool TrajectoryModel::make_cells(int interval, double from, double to, const Eigen::VectorXd& near,
                                 int halvings) {
  const double middle = (from + to) / 2;
  const Eigen::VectorXd q = newton(place_at(interval, Narrow(middle)), near);
  const Place at = place_at(interval, {from, to});
  std::optional<NarrowBox> X = q.allFinite() ? enclose(at, q) : std::nullopt;
  if (X && is_upright(at, *X)) {
    tube_[static_cast<std::size_t>(interval)].push_back({from, to, std::move(*X)});
    return true;
  }
  if (halvings == kMostCellCuts) {
    lost_ = {"the dependent joints may have no solution or several", time(interval, middle)};
    return false;
  }
  const Eigen::VectorXd next = q.allFinite() ? q : near;
  return make_cells(interval, from, middle, next, halvings + 1) &&
         make_cells(interval, middle, to, next, halvings + 1);
}

/// Checks that the solutions of neighbours are one at the instant that they share: a small box
/// about it with one solution lies in both, which have one each.
void TrajectoryModel::join_cells() {
  const TubeCell* before = nullptr;
  int interval_before = 0;
  for (int i = 0; i < curve_.intervals(); ++i) {
    for (const TubeCell& cell : tube_[static_cast<std::size_t>(i)]) {
      if (before) {
        const Place at = place_at(interval_before, Narrow(before->to));
        const std::optional<NarrowBox> Z = enclose(at, newton(at, middles(before->q)));
        if (!Z || !lies_in(*Z, before->q) || !lies_in(*Z, cell.q)) {
          lost_ = {"the dependent joints may jump", time(interval_before, before->to)};
          return;
        }
      }
      before = &cell;
      interval_before = i;
    }
  }
}

/// The equations F(q(t), t) = 0 hold at all times. With the coefficients of q up to k - 1 and a
/// zero in place of the k-th, the k-th one of F is a_k, and the true one is a_k + F' q_k = 0.
template <int N>
std::vector<Jet<N>> TrajectoryModel::dependent_jets(int interval, const Narrow& x) const {
  const std::size_t count = problem_.dependent.size();
  std::vector<Jet<N>> jets(count);
  const auto forget_from = [&jets](std::size_t k) {
    for (Jet<N>& jet : jets) {
      std::fill(jet.c.begin() + static_cast<std::ptrdiff_t>(k), jet.c.end(),
                Narrow(-kUnknown, kUnknown));
    }
    return jets;
  };
  if (!lost_.reason.empty()) return forget_from(0);
  NarrowBox X;
  for (const TubeCell& cell : tube_[static_cast<std::size_t>(interval)]) {
    if (cell.to < x.low || cell.from > x.high) continue;
    if (X.empty()) X = cell.q;
    for (std::size_t i = 0; i < count; ++i) {
      X[i] = {std::min(X[i].low, cell.q[i].low), std::max(X[i].high, cell.q[i].high)};
    }
  }
  const Place at = place_at(interval, x);
  for (int i = 0; i < kMostContractions; ++i) {
    const std::optional<NarrowBox> K = krawczyk(at, X);
    if (!K) break;
    const double before = width_of(X);
    for (std::size_t j = 0; j < count; ++j) {
      const double low = std::max(X[j].low, (*K)[j].low), high = std::min(X[j].high, (*K)[j].high);
      if (low <= high) X[j] = {low, high};  // false for NaN
    }
    if (!(width_of(X) < kWorthContracting * before)) break;
  }
  for (std::size_t j = 0; j < count; ++j) jets[j].c[0] = X[j];
  const std::vector<NarrowBox> A = equation_slopes(at, X);
  const Eigen::MatrixXd Y = inverse_of_middles(A);
  if (Y.size() == 0) return forget_from(1);
  const std::vector<NarrowBox> off = deviation(Y, A);
  Motion<N> motion;
  move_tool(interval, x, motion);
  const std::vector<Jet<N>> q = joints_of_theta_r<N>(interval, x);
  for (std::size_t k = 1; k <= N; ++k) {
    NarrowBox a;
    for (const Jet<N>& f : equations(motion.tool, q, jets)) a.push_back(-f.c[k]);
    const NarrowBox next = solve_near_one(product(Y, a), off);
    if (next.empty()) return forget_from(k);
    for (std::size_t j = 0; j < count; ++j) jets[j].c[k] = next[j];
  }
  return jets;
}

template std::vector<Jet<3>> TrajectoryModel::dependent_jets<3>(int, const Narrow&) const;
template std::vector<Jet<4>> TrajectoryModel::dependent_jets<4>(int, const Narrow&) const;

}  // namespace maxwrench
