#include "solvers/pontryagin/least_effort_motion.h"

#include <cmath>

#include "lib/trajectory/canonical_equations.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

constexpr int kRounds = 60;
constexpr double kFirstDamping = 1e-2, kMostDamping = 1e8;
constexpr double kSmallGain = 1e-7;  // relative

/// The sum of squares r'r and, where asked, J'J and J'r by the inner knots, all of one coordinate
/// after the other.
class EffortSum {
 public:
  EffortSum(const Problem& problem, double m, double stiffness, const Eigen::MatrixXd& wanted)
      : problem_(problem),
        dynamics_(problem),
        m_(m),
        root_(std::sqrt(stiffness)),
        wanted_(wanted),
        weights_(effort_weights(problem).cwiseInverse()),
        weighted_(weights_.asDiagonal() * problem.robot.actuation.B_pinv) {}

  double evaluate(const SplineMotion& motion, Eigen::MatrixXd* JtJ, Eigen::VectorXd* Jtr) {
    const SchemeMaps& maps = motion.maps;
    const Eigen::Index n = motion.Q.cols(), inner = motion.Q.rows() - 2;
    if (JtJ) {
      JtJ->setZero(n * inner, n * inner);
      Jtr->setZero(n * inner);
    }
    double sum = 0;
    Eigen::MatrixXd J(weighted_.rows(), n * inner);
    for (int i = 0; i < maps.instants(); ++i) {
      dynamics_.set(motion.q(i), motion.v(i), motion.a(i), m_);
      Eigen::VectorXd r = weighted_ * dynamics_.f();
      if (wanted_.size() > 0) r -= weights_.cwiseProduct(wanted_.col(i));
      sum += r.squaredNorm();
      if (!JtJ) continue;
      const Eigen::MatrixXd by_q = weighted_ * dynamics_.by_q(),
                            by_v = weighted_ * dynamics_.by_v(), by_a = weighted_ * dynamics_.M();
      for (Eigen::Index j = 0; j < n; ++j) {
        J.middleCols(j * inner, inner) = by_q.col(j) * maps.P.row(i).segment(1, inner) +
                                         by_v.col(j) * maps.V.row(i).segment(1, inner) +
                                         by_a.col(j) * maps.A.row(i).segment(1, inner);
      }
      JtJ->noalias() += J.transpose() * J;
      Jtr->noalias() += J.transpose() * r;
    }
    for (int i = 0; i < maps.instants(); ++i) sum += add_excess(motion, i, JtJ, Jtr);
    return sum;
  }

 private:
  /// What exceeds the limits of joints and speeds at an instant.
  double add_excess(const SplineMotion& motion, int i, Eigen::MatrixXd* JtJ, Eigen::VectorXd* Jtr) {
    const Eigen::Index inner = motion.Q.rows() - 2;
    const Eigen::VectorXd q = motion.q(i), v = motion.v(i);
    double sum = 0;
    const auto add = [&](Eigen::Index j, double excess, const Eigen::RowVectorXd& row) {
      if (excess == 0) return;
      sum += root_ * root_ * excess * excess;
      if (!JtJ) return;
      const Eigen::VectorXd by = root_ * row.segment(1, inner);
      JtJ->block(j * inner, j * inner, inner, inner).noalias() += by * by.transpose();
      Jtr->segment(j * inner, inner).noalias() += root_ * excess * by;
    };
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      add(j, excess_of(q[j], problem_.theta_r_min[j], problem_.theta_r_max[j]),
          motion.maps.P.row(i));
      const int joint = problem_.redundant[static_cast<std::size_t>(j)];
      const double fastest = problem_.robot.joints[static_cast<std::size_t>(joint)].velocity_max;
      if (std::isinf(fastest)) continue;
      add(j, excess_of(v[j] / fastest, -1, 1), motion.maps.V.row(i) / fastest);
    }
    return sum;
  }

  const Problem& problem_;
  TransferDynamics dynamics_;
  double m_, root_;
  const Eigen::MatrixXd& wanted_;
  Eigen::VectorXd weights_;
  Eigen::MatrixXd weighted_;
};

}  // namespace

SplineMotion resampled(const MotionTask& task, const Eigen::MatrixXd& knots, int intervals,
                       int per_interval) {
  const Eigen::MatrixXd given = all_knots(task, knots);
  MotionTask finer = task;
  finer.k = intervals + 1;
  SplineMotion motion{make_dense_spline(finer, per_interval), {}};
  // On the common refinement of both grids every new knot is an instant of the given spline.
  const SchemeMaps dense = make_dense_spline(task, intervals);
  motion.Q.resize(intervals + 1, given.cols());
  for (int k = 0; k <= intervals; ++k) motion.Q.row(k) = dense.P.row(k * (task.k - 1)) * given;
  return motion;
}

void follow_efforts(const Problem& problem, double m, double stiffness,
                    const Eigen::MatrixXd& efforts, SplineMotion& motion) {
  EffortSum sum_of(problem, m, stiffness, efforts);
  const Eigen::Index inner = motion.Q.rows() - 2;
  Eigen::MatrixXd JtJ;
  Eigen::VectorXd Jtr;
  double damping = kFirstDamping, sum = sum_of.evaluate(motion, &JtJ, &Jtr);
  for (int round = 0; round < kRounds && damping < kMostDamping; ++round) {
    Eigen::MatrixXd damped = JtJ;
    damped.diagonal() *= 1 + damping;
    const Eigen::VectorXd step = -damped.ldlt().solve(Jtr);
    const Eigen::MatrixXd before = motion.Q;
    motion.Q.middleRows(1, inner) += step.reshaped(inner, motion.Q.cols());
    const double risen = sum_of.evaluate(motion, nullptr, nullptr) - sum;
    if (!(risen < 0)) {
      motion.Q = before;
      damping *= 10;
      continue;
    }
    damping /= 5;
    if (-risen < kSmallGain * sum) return;
    sum = sum_of.evaluate(motion, &JtJ, &Jtr);
  }
}

void minimise_effort(const Problem& problem, double m, double stiffness, SplineMotion& motion) {
  follow_efforts(problem, m, stiffness, {}, motion);
}

}  // namespace maxwrench
