#include <Eigen/Dense>
#include <algorithm>
#include <stdexcept>

#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/bound/exact_posture.h"
#include "solvers/certify/bound/multiplier_program.h"

namespace maxwrench {
namespace {

/// With b base axes, j joints, y = (J_b'W)^-T c_w and K = J_j'W (J_b'W)^-1, the rows are [o_0;
/// tau_0; y; K column by column], 1 + j + b + jb: o = B_b'y, o_0 = -y'tau_b, A = K B_b and tau_0 =
/// tau_j - K tau_b.
struct AnyModel {
  MultiAffine f;
  Eigen::VectorXd sizes;         ///< of the rows
  Eigen::MatrixXd B_b;           ///< b×thrusters
  Eigen::VectorXd u_min, u_max;  ///< of thrusters,
  Eigen::VectorXd j_min, j_max;  ///< and of joints
  Eigen::Index b, j;
};

MultiAffine any_rows(const Problem& problem, Eigen::Index b, Eigen::Index j) {
  ExactPosture posture(problem);
  const ExtendedVector c_w =
      problem.W_any.cast<Extended>().transpose() * problem.c.cast<Extended>();
  return {
      all_coordinates(problem), problem.theta_r_default, [&](const ExtendedVector& theta_r) {
        posture.set(theta_r);
        const MatrixX<Extended> JtW = posture.J().transpose() * posture.turned(problem.W_any);
        const Eigen::FullPivLU<MatrixX<Extended>> lu(MatrixX<Extended>(JtW.topRows(b).transpose()));
        const ExtendedVector y = lu.solve(c_w);
        const MatrixX<Extended> K =
            MatrixX<Extended>(lu.solve(JtW.bottomRows(j).transpose())).transpose();
        const ExtendedVector tau_b = posture.tau_d().head(b);
        ExtendedVector rows(1 + j + b + j * b);
        rows << -y.dot(tau_b), posture.tau_d().tail(j) - K * tau_b, y, K.reshaped();
        return rows;
      }};
}

/// Whether the rows agree with the model at other postures, too.
bool reproduces(const Problem& problem, const MultiAffine& f, Eigen::Index b, Eigen::Index j) {
  if (j == 0) return true;
  Eigen::VectorXd theta_r = problem.theta_r_default;
  ExactPosture posture(problem);
  for (int sample = 0; sample < 16; ++sample) {
    for (Eigen::Index i = 0; i < theta_r.size(); ++i) {
      theta_r[i] += 0.37 + 0.19 * static_cast<double>(i);
    }
    posture.set(theta_r.cast<Extended>());
    const Eigen::MatrixXd JtW =
        (posture.J().transpose() * posture.turned(problem.W_any)).cast<double>();
    const Eigen::VectorXd rows = f.evaluate(theta_r);
    const Eigen::MatrixXd K = rows.tail(j * b).reshaped(j, b);
    const double off = (K * JtW.topRows(b) - JtW.bottomRows(j)).cwiseAbs().maxCoeff();
    if (!(off < 1e-10 * (1 + JtW.cwiseAbs().maxCoeff()))) return false;
  }
  return true;
}

class AnyWrenchBound final : public Bound {
 public:
  explicit AnyWrenchBound(std::shared_ptr<const AnyModel> model)
      : model_(std::move(model)),
        box_(model_->f),
        program_(Eigen::MatrixXd::Identity(model_->j, model_->j), model_->j_min, model_->j_max,
                 model_->f.size() + kMostRounds * static_cast<Eigen::Index>(kMostAdded)),
        P_(model_->f.size(), model_->f.rows()),
        d_(model_->f.size(), model_->B_b.cols()),
        u_(model_->B_b.cols()) {
    const Eigen::VectorXd& S = model_->sizes;
    const Eigen::VectorXd u = model_->u_min.cwiseAbs().cwiseMax(model_->u_max.cwiseAbs());
    const Eigen::VectorXd force = model_->B_b.cwiseAbs() * u;
    const Eigen::Index j = model_->j, b = model_->b;
    fixed_ = S[0] + S.segment(1 + j, b).dot(force);
    by_mu_ = S.segment(1, j) + S.tail(j * b).reshaped(j, b) * force +
             model_->j_min.cwiseAbs().cwiseMax(model_->j_max.cwiseAbs());
  }

  /// The most that the thrusters exert along c, with the largest lever that a posture can have.
  double ceiling() const override { return fixed_ * (1 + kCeilingRounding); }

  void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low, double high,
                BoxProof& proof) override {
    proof.forget(high);
    if (!(spread(model_->f.coordinates(), lower, upper) <= kMostSpread)) return;
    P_ = box_.over(lower, upper).transpose();
    mu_ = proof.multiplier;
    if (mu_.size() != model_->j) mu_.setZero(model_->j);
    points_ = 0;
    double least = -kInfinity;
    for (int round = 0;; ++round) {
      proof.improve(value(), mu_);
      if (proof.high <= low || round == kMostRounds) return;
      if (proof.high - least <= kClose * (proof.high - low)) return;
      add_points(least, round == 0);
      least = program_.solve(low - kBelow * std::abs(low), kMostSteps, proof.basis, mu_);
    }
  }

  std::unique_ptr<Bound> clone() const override { return std::make_unique<AnyWrenchBound>(model_); }

 private:
  static constexpr int kMostRounds = 30;
  static constexpr std::size_t kMostAdded = 16;
  static constexpr int kMostSteps = 60;
  static constexpr double kBelow = 1e-9;  ///< more than rounding can add to U
  /// A share of U's excess over `low`: another round is not useful if U is nearer than this to the
  /// least U of the points so far.
  static constexpr double kClose = 0.01;

  /// U(mu), rounding included; leaves o - A'mu of all control points in d_.
  double value() {
    const Eigen::Index j = model_->j, b = model_->b;
    most_ = P_.col(0);
    most_.noalias() -= P_.middleCols(1, j) * mu_;
    g_ = P_.middleCols(1 + j, b);
    for (Eigen::Index axis = 0; axis < b; ++axis) {
      g_.col(axis).noalias() -= P_.middleCols(1 + j + b + axis * j, j) * mu_;
    }
    d_.noalias() = g_ * model_->B_b;
    for (Eigen::Index k = 0; k < d_.cols(); ++k) {
      most_.array() +=
          (d_.col(k).array() * model_->u_min[k]).max(d_.col(k).array() * model_->u_max[k]);
    }
    support_ = 0;
    for (Eigen::Index i = 0; i < j; ++i) {
      support_ += std::max(mu_[i] * model_->j_min[i], mu_[i] * model_->j_max[i]);
    }
    const double off = fixed_ + mu_.cwiseAbs().dot(by_mu_);
    return support_ + most_.maxCoeff() + kBoundRounding * kMostSpread * off;
  }

  /// At the control points with the largest U(mu) above `least`, adds the best efforts for mu; with
  /// `all`, in the first round, at all control points.
  void add_points(double least, bool all) {
    const auto count = all ? static_cast<std::size_t>(P_.rows()) : kMostAdded;
    list_largest(most_, least - support_, count, order_);
    program_.set_points(points_ + static_cast<Eigen::Index>(order_.size()));
    for (const int v : order_) add_point(v);
  }

  void add_point(Eigen::Index v) {
    const Eigen::Index j = model_->j, b = model_->b;
    for (Eigen::Index k = 0; k < u_.size(); ++k) {
      u_[k] = d_(v, k) > 0 ? model_->u_max[k] : model_->u_min[k];
    }
    force_.noalias() = model_->B_b * u_;
    const auto at = P_.row(v);
    program_.costs()[points_] = at[0] + at.segment(1 + j, b).dot(force_);
    for (Eigen::Index i = 0; i < j; ++i) {
      double torque = at[1 + i];
      for (Eigen::Index axis = 0; axis < b; ++axis) {
        torque += at[1 + j + b + axis * j + i] * force_[axis];
      }
      program_.row(i)[points_] = torque;
    }
    ++points_;
  }

  std::shared_ptr<const AnyModel> model_;
  ControlPoints box_;
  MultiplierProgram program_;
  Eigen::MatrixXd P_, d_, g_;
  Eigen::VectorXd u_, force_, mu_, most_, by_mu_;
  std::vector<int> order_;
  double fixed_ = 0, support_ = 0;
  Eigen::Index points_ = 0;
};

}  // namespace

std::unique_ptr<Bound> make_any_wrench_bound(const Problem& problem) {
  const Robot& robot = problem.robot;
  const auto b = static_cast<Eigen::Index>(robot.base_axes.size());
  const auto j = static_cast<Eigen::Index>(robot.joints.size());
  const auto thrusters = static_cast<Eigen::Index>(robot.thrusters.size());
  const auto reject = [&] {
    throw std::invalid_argument(problem.name +
                                ": wrench: got 'any', expected pure for a proof: any needs a base "
                                "whose free axes are as many as the wrenches");
  };
  if (problem.W_any.cols() != b) reject();
  require_few_control_points(problem.name, all_coordinates(problem));
  MultiAffine f = any_rows(problem, b, j);
  if (!f.coefficients().allFinite() || !reproduces(problem, f, b, j)) reject();
  const Eigen::VectorXd sizes = f.magnitudes(problem.theta_r_min.array() - kCeilingMargin,
                                             problem.theta_r_max.array() + kCeilingMargin);
  const Zonotope& set = robot.actuation;
  return std::make_unique<AnyWrenchBound>(std::make_shared<AnyModel>(
      AnyModel{std::move(f), sizes, set.B.topLeftCorner(b, thrusters), set.u_min.head(thrusters),
               set.u_max.head(thrusters), set.u_min.tail(j), set.u_max.tail(j), b, j}));
}

}  // namespace maxwrench
