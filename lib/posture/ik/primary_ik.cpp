#include "lib/posture/ik/primary_ik.h"

#include "lib/posture/ik/ik_start_system.h"
#include "maxwrench/problem.h"

namespace maxwrench {

PrimaryIk::PrimaryIk(const Problem& problem)
    : problem_(problem),
      ik_solutions_(serving_start_system(problem)),
      own_(static_cast<Eigen::Index>(problem.redundant.size()) + problem.free.count()),
      z_(4 + problem.guess_q.size()) {
  const int axes = static_cast<int>(problem.robot.base_axes.size());
  for (int i = 0; i < axes; ++i) columns_.push_back(i);
  for (const int joint : problem.dependent) columns_.push_back(axes + joint);
  const auto d = static_cast<Eigen::Index>(columns_.size());
  J_d_.resize(6, d);
  seed_.setZero(d);
  own_ = problem.theta_r_default.head(own_.size());
  place_guess();
}

int PrimaryIk::solve(const Eigen::VectorXd& theta_r) {
  own_ = theta_r.head(own_.size());
  return ik_solutions_.solve(own_);
}

void PrimaryIk::place_guess() {
  z_ << problem_.guess_base, problem_.guess_q;
  for (std::size_t k = 0; k < problem_.redundant.size(); ++k) {
    z_[4 + problem_.redundant[k]] = own_[static_cast<Eigen::Index>(k)];
  }
}

bool PrimaryIk::place(int i) {
  place_guess();
  const ToolChain& chain = ik_solutions_.start_system().chain();
  bool inside = true;
  for (int k = 0; k < chain.unknowns(); ++k) {
    const int place = chain.place_in_z(k);
    double& value = z_[place];
    value = ik_solutions_.y(i)[static_cast<std::size_t>(k)];
    if (place < 4) continue;
    const Joint& joint = problem_.robot.joints[static_cast<std::size_t>(place - 4)];
    value = turned_into_limits(joint, value);
    inside &= value >= joint.q_min - kLimitTolerance && value <= joint.q_max + kLimitTolerance;
  }
  return inside;
}

void PrimaryIk::decompose(const Matrix6Xd& J) {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    J_d_.col(static_cast<Eigen::Index>(i)) = J.col(columns_[i]);
  }
  qr_.compute(J_d_);
}

bool PrimaryIk::is_singular(const Matrix6Xd& J) {
  decompose(J);
  return qr_.is_singular(kSingularShare);
}

void PrimaryIk::follow(const Matrix6Xd& J, const Eigen::VectorXd& q_gradient,
                       Eigen::VectorXd& gradient) {
  decompose(J);
  const auto axes = static_cast<Eigen::Index>(problem_.robot.base_axes.size());
  for (Eigen::Index i = axes; i < seed_.size(); ++i) {
    seed_[i] = q_gradient[problem_.dependent[static_cast<std::size_t>(i - axes)]];
  }
  lambda_ = qr_.solve_transposed(seed_);
  const std::vector<Joint>& joints = problem_.robot.joints;
  for (std::size_t k = 0; k < problem_.redundant.size(); ++k) {
    const int joint = problem_.redundant[k];
    double slope = q_gradient[joint] - J.col(axes + joint).dot(lambda_);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const std::optional<Gear>& gear = joints[i].gear;
      if (!gear || gear->leader != joint) continue;
      slope -= gear->ratio * J.col(axes + static_cast<Eigen::Index>(i)).dot(lambda_);
    }
    gradient[static_cast<Eigen::Index>(k)] = slope;
  }
}

}  // namespace maxwrench
