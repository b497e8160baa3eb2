#include "tests/support/completeness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/math/decompositions.h"
#include "lib/posture/ik/ik_solver.h"
#include "lib/posture/ik/ik_start_system.h"
#include "lib/robot/chain.h"
#include "lib/robot/kinematics.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// An independent way to find a posture at theta_r: damped Gauss-Newton steps on base and joints,
/// with the kinematics of the whole robot.
class RandomNewton {
 public:
  explicit RandomNewton(const Problem& problem)
      : problem_(problem), kinematics_(problem.robot), J_(6, problem.robot.velocities()) {
    const int axes = static_cast<int>(problem.robot.base_axes.size());
    for (int i = 0; i < axes; ++i) columns_.push_back(i);
    for (const int joint : problem.dependent) columns_.push_back(axes + joint);
  }

  /// Starts from random dependent joints and a random place of the base. Returns whether it
  /// converges.
  bool run(const Eigen::VectorXd& theta_r, Random& random) {
    q = resting_joints(problem_.robot);
    base.setZero();
    for (std::size_t k = 0; k < problem_.redundant.size(); ++k) {
      q[problem_.redundant[k]] = theta_r[static_cast<Eigen::Index>(k)];
    }
    for (const int joint : problem_.dependent) q[joint] = random.uniform(-M_PI, M_PI);
    for (const int axis : problem_.robot.base_axes) {
      base[std::min(axis, 3)] = axis < 3 ? random.uniform(-1, 1) : random.uniform(-M_PI, M_PI);
    }
    double damping = 1e-3;
    for (int step = 0; step < 60; ++step) {
      const double before = linearise();
      if (before < 1e-12) return true;
      const Vector6N dy = damped_step(J_d_, error_, damping * before);
      if (dy.lpNorm<Eigen::Infinity>() > 3) return false;
      move(dy);
      if (linearise() < before) {
        damping /= 4;
      } else {
        move(-dy);
        damping = std::max(1e-6, 10 * damping);
      }
    }
    return linearise() < 1e-10;
  }

  Eigen::VectorXd q;
  Eigen::Vector4d base;

 private:
  double linearise() {
    const EndEffector& tool = problem_.robot.end_effectors[problem_.end_effector];
    const Pose<double> at = base_pose(problem_.robot, base);
    kinematics_.set_joints(q);
    kinematics_.jacobian(tool, at.R, J_);
    J_d_.resize(6, static_cast<Eigen::Index>(columns_.size()));
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      J_d_.col(static_cast<Eigen::Index>(i)) = J_.col(columns_[i]);
    }
    // Translations of the base are coordinates along the mount's axes.
    for (std::size_t i = 0; i < problem_.robot.base_axes.size(); ++i) {
      const int axis = problem_.robot.base_axes[i];
      if (axis < 3) {
        J_d_.col(static_cast<Eigen::Index>(i)).head<3>() = problem_.robot.mount.R.col(axis);
      }
    }
    const Pose<double> pose = at * kinematics_.end_effector(tool);
    error_.resize(6);
    error_.head<3>() = problem_.pose.p - pose.p;
    error_.tail<3>() = logarithm(problem_.pose.R * pose.R.transpose());
    return error_.norm();
  }

  void move(const Vector6N& dy) {
    const std::size_t axes = problem_.robot.base_axes.size();
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      double& value = i < axes ? base[std::min(problem_.robot.base_axes[i], 3)]
                               : q[problem_.dependent[i - axes]];
      value += dy[static_cast<Eigen::Index>(i)];
    }
  }

  const Problem& problem_;
  Kinematics<double> kinematics_;
  std::vector<int> columns_;
  Matrix6Xd J_;
  Matrix6N J_d_;
  Vector6N error_;
};

/// Whether base and joints are those of one of the IK solutions, up to whole turns.
bool is_listed(const Problem& problem, const IkSolver& ik_solutions, const Eigen::Vector4d& base,
               const Eigen::VectorXd& q) {
  const ToolChain& chain = ik_solutions.start_system().chain();
  Six<double> y{};
  for (int i = 0; i < chain.unknowns(); ++i) {
    const int z = chain.place_in_z(i);
    y[static_cast<std::size_t>(i)] = z < 4 ? base[z] : q[z - 4];
  }
  for (int i = 0; i < ik_solutions.count(); ++i) {
    if (apart(chain, ik_solutions.y(i), y) < 1e-4) return true;
  }
  return problem.dependent.empty();
}

}  // namespace

void expect_complete(const Problem& problem, int places, int starts, int least_found) {
  const auto start_system = std::make_shared<const IkStartSystem>(problem);
  ASSERT_TRUE(start_system->reaches());
  IkSolver ik_solutions(start_system);
  RandomNewton newton(problem);
  Random random(1);
  int found = 0;
  for (int place = 0; place < places; ++place) {
    const Eigen::VectorXd theta_r = random_theta_r(problem, random);
    ik_solutions.solve(theta_r);
    ASSERT_TRUE(ik_solutions.complete()) << theta_r.transpose();
    for (int start = 0; start < starts; ++start) {
      if (!newton.run(theta_r, random)) continue;
      ++found;
      ASSERT_TRUE(is_listed(problem, ik_solutions, newton.base, newton.q))
          << theta_r.transpose() << " has " << newton.q.transpose();
    }
  }
  EXPECT_GT(found, least_found);
}

}  // namespace maxwrench
