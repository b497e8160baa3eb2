#include <algorithm>

#include "maxwrench/interruption.h"
#include "verify/coordinates.h"
#include "verify/trajectory/narrow_box.h"
#include "verify/trajectory/trajectory_model.h"

// The dependent joints of a moving robot, enclosed in time.

namespace maxwrench {
namespace {

/// A part between two given places is cut in halves this often at most.
constexpr int kMostCellCuts = 12;
/// [rad or m] Boxes begin with this half width, and no wider ones are tried than the second one.
constexpr double kFirstWidth = 1e-9, kMostWidth = 0.5;
constexpr int kMostGrowths = 40, kNewtonSteps = 20;
/// A box is contracted until that leaves more than a share of its width.
constexpr int kMostContractions = 8;
constexpr double kWorthContracting = 0.8;

std::vector<Jet<1>> constants(const NarrowBox& box) { return {box.begin(), box.end()}; }

}  // namespace

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
      if (!make_cells(i, from, to, near, 0)) return;
    }
  }
  join_cells();
}

bool TrajectoryModel::make_cells(int interval, double from, double to, const Eigen::VectorXd& near,
                                 int halvings) {
  end_if_interrupted();
  const double middle = (from + to) / 2;
  const Eigen::VectorXd q = newton(place_at(interval, Narrow(middle)), near);
  const Place at = place_at(interval, {from, to});
  std::optional<NarrowBox> X = q.allFinite() ? enclose(at, q) : std::nullopt;
  if (X && is_upright(at, *X)) {
    tube_[static_cast<std::size_t>(interval)].push_back({from, to, std::move(*X)});
    return true;
  }
  if (halvings == kMostCellCuts) {
    lost_ = {X ? "the base may be upside down" : kNotEnclosed, time(interval, middle)};
    return false;
  }
  const Eigen::VectorXd next = q.allFinite() ? q : near;
  return make_cells(interval, from, middle, next, halvings + 1) &&
         make_cells(interval, middle, to, next, halvings + 1);
}

/// Checks that the solutions of neighbours are one at the instant that they share. A small box Z
/// about it has one solution, which lies in K(Z). If both neighbours contain K(Z), it is theirs.
void TrajectoryModel::join_cells() {
  const TubeCell* before = nullptr;
  int interval_before = 0;
  for (int i = 0; i < curve_.intervals(); ++i) {
    for (const TubeCell& cell : tube_[static_cast<std::size_t>(i)]) {
      if (before) {
        const Place at = place_at(interval_before, Narrow(before->to));
        const std::optional<NarrowBox> Z = enclose(at, newton(at, middles(before->q)));
        const std::optional<NarrowBox> K = Z ? krawczyk(at, *Z) : std::nullopt;
        if (!K || !lies_in(*K, before->q) || !lies_in(*K, cell.q)) {
          lost_ = {"the dependent joints may jump", time(interval_before, before->to)};
          return;
        }
      }
      before = &cell;
      interval_before = i;
    }
  }
}

auto TrajectoryModel::dependent_box(int interval, const Narrow& x, const Place& at) const
    -> NarrowBox {
  const std::vector<TubeCell>& cells = tube_[static_cast<std::size_t>(interval)];
  auto cell = std::lower_bound(cells.begin(), cells.end(), x.low,
                               [](const TubeCell& each, double low) { return each.to < low; });
  NarrowBox X = cell->q;
  for (; cell != cells.end() && cell->from <= x.high; ++cell) {
    for (std::size_t i = 0; i < X.size(); ++i) {
      X[i] = {std::min(X[i].low, cell->q[i].low), std::max(X[i].high, cell->q[i].high)};
    }
  }
  for (int i = 0; i < kMostContractions; ++i) {
    const std::optional<NarrowBox> K = krawczyk(at, X);
    if (!K) break;
    const double before = width_of(X);
    for (std::size_t j = 0; j < X.size(); ++j) {
      const double low = std::max(X[j].low, (*K)[j].low), high = std::min(X[j].high, (*K)[j].high);
      if (low <= high) X[j] = {low, high};
    }
    if (!(width_of(X) < kWorthContracting * before)) break;
  }
  return X;
}

/// The equations F(q(t), t) = 0 hold at all times. With the coefficients of q up to k - 1 and a
/// zero in place of the k-th, the k-th one of F is a_k, and the true one is a_k + F' q_k = 0.
template <int N>
std::optional<std::vector<Jet<N>>> TrajectoryModel::dependent_jets(int interval,
                                                                   const Narrow& x) const {
  if (!lost_.reason.empty()) return std::nullopt;
  const Place at = place_at(interval, x);
  const NarrowBox X = dependent_box(interval, x, at);
  const std::vector<NarrowBox> A = equation_slopes(at, X);
  const Eigen::MatrixXd Y = inverse_of_middles(A);
  if (Y.size() == 0) return std::nullopt;
  const std::vector<NarrowBox> off = deviation(Y, A);
  Motion<N> motion;
  move_tool(interval, x, motion);
  const std::vector<Jet<N>> q = joints_of_theta_r<N>(interval, x);
  std::vector<Jet<N>> jets(X.begin(), X.end());
  for (std::size_t k = 1; k <= N; ++k) {
    NarrowBox a;
    for (const Jet<N>& f : equations(motion.tool, q, jets)) a.push_back(-f.c[k]);
    const NarrowBox next = solve_near_one(product(Y, a), off);
    if (next.empty()) return std::nullopt;
    for (std::size_t j = 0; j < jets.size(); ++j) jets[j].c[k] = next[j];
  }
  return jets;
}

template std::optional<std::vector<Jet<3>>> TrajectoryModel::dependent_jets<3>(int,
                                                                               const Narrow&) const;
template std::optional<std::vector<Jet<4>>> TrajectoryModel::dependent_jets<4>(int,
                                                                               const Narrow&) const;

}  // namespace maxwrench
