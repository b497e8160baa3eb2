#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <Eigen/Eigenvalues>
#include <fstream>
#include <memory>

#include "lib/robot/dynamics.h"
#include "tests/support/mechanics.h"
#include "tests/support/support.h"

// An independent code for dry trees on a floating base: MuJoCo.

namespace maxwrench {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kTreeJoints = 6;

std::string mjcf_numbers(const Vector3d& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v.x(), v.y(), v.z());
}

std::string mjcf_numbers(const Matrix3d& R) {
  const Quaterniond q(R);
  return fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}", q.w(), q.x(), q.y(), q.z());
}

std::string mjcf_inertial(const Link& link) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(link.inertia);
  Matrix3d R = principal.eigenvectors();
  if (R.determinant() < 0) R.col(0) *= -1;
  return fmt::format("<inertial mass='{:.17g}' pos='{}' quat='{}' diaginertia='{}'/>", link.mass,
                     mjcf_numbers(link.com), mjcf_numbers(R),
                     mjcf_numbers(principal.eigenvalues()));
}

/// What a link carries, as MJCF.
std::string mjcf_children(const Robot& robot, int link) {
  std::string all;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const Joint& joint = robot.joints[i];
    if (joint.parent != link) continue;
    all += fmt::format("<body pos='{}' quat='{}'><joint name='{}' type='{}' axis='{}'/>{}{}</body>",
                       mjcf_numbers(joint.placement.p), mjcf_numbers(joint.placement.R), i,
                       joint.type == JointType::kRevolute ? "hinge" : "slide",
                       mjcf_numbers(joint.axis), mjcf_inertial(robot.links[i + 1]),
                       mjcf_children(robot, static_cast<int>(i) + 1));
  }
  return all;
}

std::string mjcf(const Robot& robot) {
  return fmt::format(
      "<mujoco><compiler angle='radian'/><option gravity='0 0 {:.17g}'/><worldbody>"
      "<body><freejoint/>{}{}</body></worldbody></mujoco>",
      -robot.gravity, mjcf_inertial(robot.links[0]), mjcf_children(robot, 0));
}

/// What MuJoCo says about one motion, in our velocities. Its free joint moves the base with the
/// linear velocity in world axes and the angular one in body axes: with G its velocities from ours,
/// M = G'M_mj G and tau = G'tau_mj.
class MuJoCo {
 public:
  explicit MuJoCo(const Robot& robot) {
    const TemporaryFolder folder;
    const std::string file = (folder.path() / "tree.xml").string();
    std::ofstream(file) << mjcf(robot);
    char error[1000] = "";
    model_.reset(mj_loadXML(file.c_str(), nullptr, error, sizeof error));
    EXPECT_TRUE(model_) << error;
    data_.reset(mj_makeData(model_.get()));
  }

  void move(const Pose<double>& base, const VectorXd& q, const VectorXd& v, const VectorXd& v_d) {
    G = MatrixXd::Zero(model_->nv, v.size());
    G.topLeftCorner<3, 3>() = base.R;
    G.block<3, 3>(3, 3).setIdentity();
    const Quaterniond turn(base.R);
    const double free[] = {base.p.x(), base.p.y(), base.p.z(), turn.w(),
                           turn.x(),   turn.y(),   turn.z()};
    std::copy(std::begin(free), std::end(free), data_->qpos);
    for (int i = 0; i < q.size(); ++i) {
      const int joint = mj_name2id(model_.get(), mjOBJ_JOINT, fmt::format("{}", i).c_str());
      data_->qpos[model_->jnt_qposadr[joint]] = q[i];
      G(model_->jnt_dofadr[joint], 6 + i) = 1;
    }
    VectorXd acceleration = G * v_d;
    acceleration.head<3>() += base.R * v.segment<3>(3).cross(v.head<3>());
    VectorXd::Map(data_->qvel, model_->nv) = G * v;
    VectorXd::Map(data_->qacc, model_->nv) = acceleration;
    mj_inverse(model_.get(), data_.get());
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> full(model_->nv,
                                                                                model_->nv);
    mj_fullM(model_.get(), full.data(), data_->qM);
    M = G.transpose() * full * G;
    tau = G.transpose() * VectorXd::Map(data_->qfrc_inverse, model_->nv);
  }

  MatrixXd G, M;
  VectorXd tau;

 private:
  struct Delete {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };
  std::unique_ptr<mjModel, Delete> model_;
  std::unique_ptr<mjData, Delete> data_;
};

void expect_as_mujoco(const MatrixXd& ours, const MatrixXd& theirs) {
  EXPECT_LT((ours - theirs).cwiseAbs().maxCoeff(), 1e-11 * theirs.cwiseAbs().maxCoeff());
}

TEST(DynamicsMuJoCo, TreeOnAFloatingBase) {
  Random random(23);
  const int n = 6 + kTreeJoints;
  for (int tree = 0; tree < 20; ++tree) {
    const Robot robot = random_dry_robot(random, kTreeJoints);
    MuJoCo mujoco(robot);
    Dynamics dynamics(robot);
    for (int sample = 0; sample < 50; ++sample) {
      const Pose<double> base{random_rotation(random), random_vector(random)};
      const VectorXd q = random_numbers(random, kTreeJoints);
      const VectorXd v = random_numbers(random, n), v_d = random_numbers(random, n);
      mujoco.move(base, q, v, v_d);
      dynamics.set_configuration(base.R, q);
      MatrixXd M;
      VectorXd tau_d(n);
      dynamics.mass_matrix(M);
      dynamics.inverse(v, v_d, tau_d);
      expect_as_mujoco(M, mujoco.M);
      expect_as_mujoco(tau_d, mujoco.tau);
    }
  }
}

}  // namespace
}  // namespace maxwrench
