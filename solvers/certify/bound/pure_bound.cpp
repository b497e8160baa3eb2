#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "lib/measure/closed_form.h"
#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/bound/box_support.h"
#include "solvers/certify/bound/ellipsoid_support.h"
#include "solvers/certify/bound/exact_posture.h"
#include "solvers/certify/bound/multiplier_program.h"

namespace maxwrench {
namespace {

/// The data that all boxes of W = c share: the rows, the magnitudes of their terms, and the
/// ceiling.
struct PureModel {
  MultiAffine f;           ///< [tau; a], 2n
  Eigen::VectorXd tau, a;  ///< magnitudes, n
  double ceiling;
};

/// J'c and tau_d on the six axes of the base, free or not: [tau; a], 12.
MultiAffine base_rows(Problem problem) {
  problem.robot.base_axes = {0, 1, 2, 3, 4, 5};
  return pure_rows(problem, Eigen::MatrixXd::Identity(6, problem.robot.velocities()));
}

/// t <= (sum_k max |u_k| |B_k| + |tau_d|) / |J'c|, with all norms on the base's free axes: linear
/// axes for a force, angular axes for a torque. On the three axes of that kind, free or not, |J'c|
/// is the length of the force or torque of c. What the axes that are not free can take is
/// subtracted from its square.
double pure_ceiling(const Problem& problem) {
  constexpr double kLeastLength2 = 1e-6;
  const Zonotope& set = problem.robot.actuation;
  const bool pushes = !problem.c.head<3>().isZero(0);
  const Eigen::Index kind = pushes ? 0 : 3;
  const Eigen::VectorXd sizes = base_rows(problem).magnitudes(
      problem.theta_r_min.array() - kCeilingMargin, problem.theta_r_max.array() + kCeilingMargin);
  std::vector<int> rows;
  Eigen::Array3d taken = sizes.segment<3>(6 + kind).array().square();
  double load2 = 0;
  for (std::size_t i = 0; i < problem.robot.base_axes.size(); ++i) {
    const Eigen::Index axis = problem.robot.base_axes[i] - kind;
    if (axis < 0 || axis >= 3) continue;
    rows.push_back(static_cast<int>(i));
    taken[axis] = 0;
    load2 += sizes[kind + axis] * sizes[kind + axis];
  }
  const double length2 = problem.c.segment<3>(kind).squaredNorm() - taken.sum();
  if (rows.empty() || !(length2 > kLeastLength2)) {
    throw std::invalid_argument(problem.name +
                                ": wrench.c: got a direction that the base's free axes do not "
                                "limit, expected one that they limit in all postures, for a proof");
  }
  double force = std::sqrt(load2);
  for (Eigen::Index k = 0; k < set.actuators(); ++k) {
    force += std::max(std::abs(set.u_min[k]), std::abs(set.u_max[k])) * set.B.col(k)(rows).norm();
  }
  return force / std::sqrt(length2) * (1 + kCeilingRounding);
}

std::shared_ptr<const PureModel> make_pure_model(const Problem& problem, const Eigen::MatrixXd& K) {
  require_few_control_points(problem.name, all_coordinates(problem));
  const double ceiling = pure_ceiling(problem);
  MultiAffine f = pure_rows(problem, K);
  const Eigen::VectorXd S = f.magnitudes(problem.theta_r_min, problem.theta_r_max);
  return std::make_shared<PureModel>(
      PureModel{std::move(f), S.head(K.rows()), S.tail(K.rows()), ceiling});
}

/// The control points of one box, and U without the support.
class PureBox {
 public:
  explicit PureBox(const PureModel& model)
      : model_(model), corners_(model.f), tau_(model.f.size(), model.tau.size()), a_(tau_) {}

  /// Returns false if the box is too large for control points.
  bool set(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
    if (!(spread(model_.f.coordinates(), lower, upper) <= kMostSpread)) return false;
    const Eigen::MatrixXd& P = corners_.over(lower, upper);
    tau_ = P.topRows(tau_.cols()).transpose();
    a_ = P.bottomRows(a_.cols()).transpose();
    return true;
  }

  /// The bound that lambda proves for t in [low, high], without the support, rounding included.
  double most(const Eigen::VectorXd& lambda, double low, double high) {
    g_.noalias() = tau_ * lambda;
    h_.noalias() = a_ * lambda;
    const double at_low = (low * (1 - h_.array()) - g_.array()).maxCoeff();
    const double at_high = (high * (1 - h_.array()) - g_.array()).maxCoeff();
    const double T = std::max(std::abs(low), std::abs(high));
    const double off = lambda.cwiseAbs().dot(model_.tau + T * model_.a) + T;
    return std::max(at_low, at_high) + kBoundRounding * kMostSpread * off;
  }

  const Eigen::MatrixXd& tau() const { return tau_; }  ///< N×n
  const Eigen::MatrixXd& a() const { return a_; }

 private:
  const PureModel& model_;
  ControlPoints corners_;
  Eigen::MatrixXd tau_, a_;
  Eigen::VectorXd g_, h_;
};

class PolytopeBound final : public Bound {
 public:
  PolytopeBound(std::shared_ptr<const PureModel> model, const Zonotope& set, bool l2)
      : model_(std::move(model)),
        set_(set),
        l2_(l2),
        support_(set, l2),
        box_(*model_),
        program_(support_.B(), set.u_min, set.u_max, 2 * model_->f.size()) {}

  double ceiling() const override { return model_->ceiling; }

  void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low, double high,
                BoxProof& proof) override {
    proof.forget(high);
    if (!box_.set(lower, upper)) return;
    if (proof.multiplier.size() == support_.B().rows()) {
      lambda_ = proof.multiplier;
      proof.improve(value(low, high), lambda_);
      if (proof.high <= low) return;
    }
    const Eigen::Index corners = model_->f.size();
    program_.set_points(2 * corners);
    for (Eigen::Index j = 0; j < support_.B().rows(); ++j) {
      program_.row(j).head(corners) = box_.tau().col(j) + low * box_.a().col(j);
      program_.row(j).tail(corners) = box_.tau().col(j) + high * box_.a().col(j);
    }
    program_.costs().head(corners).setConstant(low);
    program_.costs().tail(corners).setConstant(high);
    program_.solve(low - kSlack * std::abs(low), kMostSteps, proof.basis, lambda_);
    proof.improve(value(low, high), lambda_);
  }

  std::unique_ptr<Bound> clone() const override {
    return std::make_unique<PolytopeBound>(model_, set_, l2_);
  }

 private:
  static constexpr int kMostSteps = 100;
  static constexpr double kSlack = 1e-9;  ///< more than rounding can add to U

  double value(double low, double high) {
    const double s = support_.of(lambda_);
    return s + support_.rounding() + box_.most(lambda_, low, high);
  }

  std::shared_ptr<const PureModel> model_;
  const Zonotope& set_;
  bool l2_;
  BoxSupport support_;
  PureBox box_;
  MultiplierProgram program_;
  Eigen::VectorXd lambda_;
};

/// Sets weights of control points whose weighted sum is the centre of the box.
void weigh_centre(const Coordinates& coordinates, const Eigen::VectorXd& lower,
                  const Eigen::VectorXd& upper, Eigen::VectorXd& weights) {
  Eigen::Index size = 1;
  weights[0] = 1;
  for (std::size_t i = 0; i < coordinates.index.size(); ++i) {
    const int at = coordinates.index[i];
    const double w = std::cos((upper[at] - lower[at]) / 2);
    const double end = coordinates.turns[i] ? 0.5 / (1 + w) : 0.5;
    const double part[3] = {end, 1 - 2 * end, end};
    const Eigen::Index n = coordinates.turns[i] ? 3 : 2;
    for (Eigen::Index k = size; k-- > 0;) {
      for (Eigen::Index corner = n; corner-- > 0;) {
        weights[k * n + corner] = weights[k] * (n == 2 ? end : part[corner]);
      }
    }
    size *= n;
  }
}

class EllipsoidBound final : public Bound {
 public:
  EllipsoidBound(std::shared_ptr<const PureModel> model, const Eigen::MatrixXd& K)
      : model_(std::move(model)), K_(K), set_(K), box_(*model_), weights_(model_->f.size()) {}

  double ceiling() const override { return model_->ceiling; }

  void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low, double high,
                BoxProof& proof) override {
    proof.forget(high);
    if (!box_.set(lower, upper)) return;
    weigh_centre(model_->f.coordinates(), lower, upper, weights_);
    tau_.noalias() = box_.tau().transpose() * weights_;
    a_.noalias() = box_.a().transpose() * weights_;
    set_.aim(tau_, a_, low, lambda_);
    const double s = set_.of(lambda_);
    proof.improve(s + set_.rounding() + box_.most(lambda_, low, high), lambda_);
  }

  std::unique_ptr<Bound> clone() const override {
    return std::make_unique<EllipsoidBound>(model_, K_);
  }

 private:
  std::shared_ptr<const PureModel> model_;
  Eigen::MatrixXd K_;
  EllipsoidSupport set_;
  PureBox box_;
  Eigen::VectorXd weights_, tau_, a_, lambda_;
};

}  // namespace

std::unique_ptr<Bound> make_polytope_bound(const Problem& problem, bool l2) {
  const Zonotope& set = problem.robot.actuation;
  if (l2) require_full_row_rank(problem.robot, "l2_polytope");
  const Eigen::MatrixXd K =
      l2 ? set.B_pinv : Eigen::MatrixXd::Identity(set.dimension(), set.dimension());
  return std::make_unique<PolytopeBound>(make_pure_model(problem, K), set, l2);
}

std::unique_ptr<Bound> make_ellipsoid_bound(const Problem& problem) {
  const Eigen::MatrixXd K = weighted_inverse(problem.robot, "ellipsoid");
  const Eigen::Index n = K.cols();
  return std::make_unique<EllipsoidBound>(make_pure_model(problem, Eigen::MatrixXd::Identity(n, n)),
                                          K);
}

}  // namespace maxwrench
