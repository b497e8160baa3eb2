#include "lib/bound/loop_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

#include "lib/bound/bounds.h"

namespace maxwrench {
namespace {

/// More of them would take too long for a box.
constexpr Eigen::Index kMostControlPoints = 50'000;

int values_along(const Coordinates& chain, int axis) {
  return chain.turns[static_cast<std::size_t>(axis)] ? 3 : 2;
}

Coordinates stretch(const Coordinates& chain, int from, int to) {
  Coordinates some;
  some.index.assign(chain.index.begin() + from, chain.index.begin() + to);
  some.turns.assign(chain.turns.begin() + from, chain.turns.begin() + to);
  return some;
}

}  // namespace

LoopModel::LoopModel(const Problem& problem)
    : coordinates(problem), n(problem.robot.velocities()), problem_(problem) {
  for (int i = 0; i < coordinates.chain.count(); ++i) size *= values_along(coordinates.chain, i);
  if (size > kMostControlPoints) {
    throw std::invalid_argument(problem.name + ": got " +
                                std::to_string(coordinates.chain.count()) +
                                " coordinates with all that follows, expected fewer, for a proof");
  }
  tau = a = Eigen::VectorXd::Zero(n);
  LoopPosture posture(problem, coordinates);
  add_loads(posture);
  add_joints(posture);
  add_equations(posture);
}

void LoopModel::add_part(Kind kind, int from, int to, const std::vector<int>& rows,
                         const MultiAffine::Sample& sample) {
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(coordinates.lower.size());
  LoopPart part{kind, MultiAffine(stretch(coordinates.chain, from, to), rest, sample), from, to,
                rows};
  for (int i = to; i < coordinates.chain.count(); ++i) {
    part.repeat *= values_along(coordinates.chain, i);
  }
  const Eigen::VectorXd S = part.f.magnitudes(coordinates.lower, coordinates.upper);
  const auto count = static_cast<Eigen::Index>(rows.size());
  if (kind == Kind::kEquations) {
    f(rows) += S;
  } else {
    tau(rows) += S.head(count);
    if (kind == Kind::kLoads) a(rows) += S.tail(count);
  }
  parts.push_back(std::move(part));
}

/// The base and what is not of the chain depend on all.
void LoopModel::add_loads(LoopPosture& posture) {
  const Robot& robot = problem_.robot;
  const auto axes = static_cast<int>(robot.base_axes.size());
  std::vector<int> pushed, others;
  for (int i = 0; i < static_cast<int>(n); ++i) {
    const bool slides = i < axes && robot.base_axes[static_cast<std::size_t>(i)] < 3;
    if (slides && !coordinates.base_follows) {
      pushed.push_back(i);
    } else if (std::find(coordinates.joints.begin(), coordinates.joints.end(), i - axes) ==
               coordinates.joints.end()) {
      others.push_back(i);
    }
  }
  const auto add = [&](int from, int to, const std::vector<int>& rows) {
    if (rows.empty()) return;
    add_part(Kind::kLoads, from, to, rows, [&](const ExtendedVector& x) {
      posture.set(x);
      ExtendedVector values(2 * static_cast<Eigen::Index>(rows.size()));
      values << posture.loads().head(n)(rows), posture.loads().tail(n)(rows);
      return values;
    });
  };
  const auto& yaw = coordinates.yaw;
  add(yaw.from, problem_.free.wrench_turns ? coordinates.free.to : yaw.to, pushed);
  add(0, coordinates.free.to, others);
  if (coordinates.shares.count() == 0) return;
  pushed.insert(pushed.end(), others.begin(), others.end());
  add_part(Kind::kForces, 0, coordinates.shares.to, pushed, [&](const ExtendedVector& x) {
    posture.set(x);
    return ExtendedVector(posture.forces()(pushed));
  });
}

/// A joint of the chain depends on what is behind it.
void LoopModel::add_joints(LoopPosture& posture) {
  const auto axes = static_cast<int>(problem_.robot.base_axes.size());
  for (int i = coordinates.first.from; i < coordinates.first.to; ++i) {
    const int row = axes + coordinates.joints[static_cast<std::size_t>(i - coordinates.first.from)];
    add_part(Kind::kLoads, i + 1, coordinates.free.to, {row}, [&](const ExtendedVector& x) {
      posture.set(x);
      ExtendedVector values(2);
      values << posture.loads()[row], posture.loads()[n + row];
      return values;
    });
  }
}

std::vector<int> LoopModel::new_equations(Eigen::Index count) {
  std::vector<int> rows(static_cast<std::size_t>(count));
  std::iota(rows.begin(), rows.end(), static_cast<int>(m));
  m += count;
  f.conservativeResize(m);
  f.tail(count).setZero();
  return rows;
}

/// Left and right of the middle of the chain; the second arm and what it touches.
void LoopModel::add_equations(LoopPosture& posture) {
  using Side = std::function<ExtendedVector()>;
  posture.set(ExtendedVector::Zero(coordinates.lower.size()));
  const auto add = [&](int from, int to, const std::vector<int>& rows, const Side& side) {
    add_part(Kind::kEquations, from, to, rows, [&](const ExtendedVector& x) {
      posture.set(x);
      return side();
    });
  };
  if (!coordinates.base_follows) {
    const int from = coordinates.yaw.from, to = coordinates.free.to;
    const int k = std::max(0, (from + to) / 2 - coordinates.first.from);
    const int cut = coordinates.first.from + k;
    const std::vector<int> rows = new_equations(posture.left(k).size());
    add(from, cut, rows, [&] { return posture.left(k); });
    add(cut, to, rows, [&] { return ExtendedVector(-posture.right(k)); });
  }
  if (!problem_.contact) return;
  const std::vector<int> rows = new_equations(posture.touching().size());
  add(0, coordinates.second.to, rows, [&] { return posture.touching(); });
  add(coordinates.first.from, coordinates.regrasp.to, rows,
      [&] { return ExtendedVector(-posture.touched()); });
}

LoopLinear::LoopLinear(const LoopModel& model) : model_(model) {
  const auto d = static_cast<Eigen::Index>(model.coordinates.chain.count());
  f_0_ = rho_ = e_ = reduced_rho_ = Eigen::VectorXd::Zero(model.m);
  D_ = A_ = Eigen::MatrixXd::Zero(model.m, d);
  M_ = Eigen::MatrixXd::Identity(model.m, model.m);
  w_ = low_ = high_ = Eigen::VectorXd::Zero(d);
}

/// The coefficients of a part about the centre of the box; then their sums.
void LoopLinear::centre(const LoopPart& part, const Eigen::VectorXd& lower,
                        const Eigen::VectorXd& upper) {
  coefficients_ = part.f.coefficients();
  weights_.setOnes(coefficients_.cols());
  const Coordinates& along = part.f.coordinates();
  Eigen::Index step = coefficients_.cols();
  for (int i = 0; i < along.count(); ++i) {
    const int at = along.index[static_cast<std::size_t>(i)];
    const double mid = (lower[at] + upper[at]) / 2, r = (upper[at] - lower[at]) / 2;
    const bool turns = along.turns[static_cast<std::size_t>(i)] != 0;
    const int terms = turns ? 3 : 2;
    step /= terms;
    const double c = std::cos(mid), s = std::sin(mid), half = (1 - std::cos(r)) / 2;
    for (Eigen::Index first = 0; first < coefficients_.cols(); ++first) {
      if (first / step % terms != 0) continue;
      auto F_0 = coefficients_.col(first), F_1 = coefficients_.col(first + step);
      if (!turns) {
        F_0 += mid * F_1;
        weights_[first + step] *= r;
        continue;
      }
      auto F_2 = coefficients_.col(first + 2 * step);
      const Eigen::VectorXd P = c * F_1 + s * F_2, Q = c * F_2 - s * F_1;
      F_0 += (1 - half) * P;
      F_1 = P;
      F_2 = Q;
      weights_[first + step] *= half;
      weights_[first + 2 * step] *= r < std::numbers::pi / 2 ? std::sin(r) : 1;
    }
  }
  f_0_(part.rows) += coefficients_.col(0);
  weights_[0] = 0;
  step = coefficients_.cols();
  for (int i = 0; i < along.count(); ++i) {
    const int terms = along.turns[static_cast<std::size_t>(i)] != 0 ? 3 : 2;
    step /= terms;
    const Eigen::Index linear = (terms - 1) * step;
    D_.col(part.from + i)(part.rows) += coefficients_.col(linear);
    weights_[linear] = 0;
  }
  rho_(part.rows) += coefficients_.cwiseAbs() * weights_;
}

void LoopLinear::expand(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  f_0_.setZero();
  D_.setZero();
  rho_ = kBoundRounding * kMostSpread * model_.f;
  for (const LoopPart& part : model_.parts) {
    if (part.kind == LoopPart::Kind::kEquations) centre(part, lower, upper);
  }
  const Coordinates& chain = model_.coordinates.chain;
  for (int i = 0; i < chain.count(); ++i) {
    const int at = chain.index[static_cast<std::size_t>(i)];
    const double r = (upper[at] - lower[at]) / 2;
    const bool turns = chain.turns[static_cast<std::size_t>(i)] != 0;
    w_[i] = !turns ? r : r < std::numbers::pi / 2 ? std::sin(r) : 1;
    D_.col(i) *= w_[i];
  }
}

/// Gauss and Jordan with complete pivoting, of D in units of w.
void LoopLinear::eliminate() {
  constexpr double kLeastPivot = 1e-7;
  A_ = D_;
  M_.setIdentity();
  rank_ = 0;
  const Eigen::Index most = std::min(A_.rows(), A_.cols());
  double first = 0;
  while (rank_ < most) {
    Eigen::Index row = 0, column = 0;
    const double pivot = A_.bottomRows(A_.rows() - rank_).cwiseAbs().maxCoeff(&row, &column);
    if (rank_ == 0) first = pivot;
    if (!(pivot > kLeastPivot * first)) break;
    row += rank_;
    if (row != rank_) {
      A_.row(row).swap(A_.row(rank_));
      M_.row(row).swap(M_.row(rank_));
    }
    const double scale = 1 / A_(rank_, column);
    A_.row(rank_) *= scale;
    M_.row(rank_) *= scale;
    for (Eigen::Index i = 0; i < A_.rows(); ++i) {
      const double factor = A_(i, column);
      if (i == rank_ || factor == 0) continue;
      A_.row(i) -= factor * A_.row(rank_);
      M_.row(i) -= factor * M_.row(rank_);
    }
    ++rank_;
  }
  A_.noalias() = M_ * D_;
}

void LoopLinear::precondition(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  expand(lower, upper);
  eliminate();
}

/// Each row e + A u + rest = 0, |rest| <= rho, limits each u_j, within [low, high]; false: it
/// cannot be.
bool LoopLinear::propagate(const Eigen::MatrixXd& A, const Eigen::VectorXd& e,
                           const Eigen::VectorXd& rho) {
  constexpr double kLeast = 1e-6;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    double least = e[i] - rho[i], most = e[i] + rho[i];
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      const double at_low = A(i, j) * low_[j], at_high = A(i, j) * high_[j];
      least += std::min(at_low, at_high);
      most += std::max(at_low, at_high);
    }
    if (least > 0 || most < 0) return false;
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      const double slope = A(i, j);
      if (std::abs(slope) < kLeast) continue;
      const double at_low = slope * low_[j], at_high = slope * high_[j];
      // slope u_j in [-(most - its part), -(least - its part)]
      const double from = std::max(at_low, at_high) - most, to = std::min(at_low, at_high) - least;
      const double old_low = low_[j], old_high = high_[j];
      low_[j] = std::max(old_low, std::min(from / slope, to / slope) - 1e-12);
      high_[j] = std::min(old_high, std::max(from / slope, to / slope) + 1e-12);
      if (low_[j] > high_[j]) return false;
      const double new_low = slope * low_[j], new_high = slope * high_[j];
      least += std::min(new_low, new_high) - std::min(at_low, at_high);
      most += std::max(new_low, new_high) - std::max(at_low, at_high);
    }
  }
  return true;
}

/// The box of what is left of u; remembers the largest gain.
bool LoopLinear::narrow(Eigen::VectorXd& lower, Eigen::VectorXd& upper) {
  constexpr double kOutward = 1e-12;
  constexpr double kSteep = 0.999;  ///< sines near 1 tell little of their angles
  gain_ = 0;
  const Coordinates& chain = model_.coordinates.chain;
  for (int i = 0; i < chain.count(); ++i) {
    const int at = chain.index[static_cast<std::size_t>(i)];
    const double mid = (lower[at] + upper[at]) / 2, r = (upper[at] - lower[at]) / 2;
    const bool turns = chain.turns[static_cast<std::size_t>(i)] != 0;
    if (turns && r >= std::numbers::pi / 2) continue;
    const auto offset = [&](double u) {
      const double s = u * w_[i];
      if (std::abs(u) >= 1 || (turns && std::abs(s) > kSteep)) return u > 0 ? r : -r;
      return turns ? std::asin(s) : s;
    };
    const double from = mid + offset(low_[i]) - kOutward, to = mid + offset(high_[i]) + kOutward;
    if (from > upper[at] || to < lower[at]) return false;
    const double kept = std::min(to, upper[at]) - std::max(from, lower[at]);
    if (r > 1e-7) gain_ = std::max(gain_, 1 - kept / (2 * r));
    lower[at] = std::max(from, lower[at]);
    upper[at] = std::min(to, upper[at]);
  }
  return true;
}

bool LoopLinear::shrink(Eigen::VectorXd& lower, Eigen::VectorXd& upper) {
  constexpr int kMostRounds = 8;
  constexpr double kWorthwhile = 0.1;
  for (int round = 0; round < kMostRounds; ++round) {
    expand(lower, upper);
    low_.setConstant(-1);
    high_.setConstant(1);
    if (!propagate(D_, f_0_, rho_)) return false;
    eliminate();
    e_.noalias() = M_ * f_0_;
    reduced_rho_.noalias() = M_.cwiseAbs() * rho_;
    // What is computed of M D is off by rounding, which rho_ holds many times.
    if (!propagate(A_, e_, reduced_rho_)) return false;
    if (!narrow(lower, upper)) return false;
    if (gain_ < kWorthwhile) break;
  }
  return true;
}

}  // namespace maxwrench
