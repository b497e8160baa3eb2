#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <array>
#include <fstream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "lib/robot/kinematics.h"
#include "maxwrench/load.h"
#include "tests/support/support.h"

// Joints beside the way to the tool without an effort: they stay where positions put them.

namespace maxwrench {
namespace {

using Eigen::Vector3d;
using testing::Contains;
using testing::HasSubstr;

/// Two driven joints carry the tool. Beside the tool hang a wrist (slides) and on it a flap (turns
/// about a skew axis), with eccentric masses and no motors, and a leaf that mimics the flap.
constexpr const char* kArmWithFlap = R"(<robot name='r'>
  <link name='base'/>
  <link name='rod'><inertial><origin xyz='0.4 0.02 0'/><mass value='2'/>
    <inertia ixx='0.1' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/></inertial></link>
  <link name='fore'><inertial><origin xyz='0.2 0 0.05'/><mass value='1.5'/>
    <inertia ixx='0.1' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/></inertial></link>
  <link name='tool'/>
  <link name='wrist'><inertial><origin xyz='0 0.1 0'/><mass value='0.7'/>
    <inertia ixx='0.1' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/></inertial></link>
  <link name='flap'><inertial><origin xyz='0.3 0.1 0.2'/><mass value='3'/>
    <inertia ixx='0.1' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/></inertial>
    <collision><origin xyz='0.3 0.1 0.2'/><geometry><sphere radius='0.05'/></geometry></collision></link>
  <link name='leaf'><inertial><origin xyz='0.2 0 0'/><mass value='0.9'/>
    <inertia ixx='0.1' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/></inertial>
    <collision><origin xyz='0.2 0 0'/><geometry><sphere radius='0.02'/></geometry></collision></link>
  <joint name='a' type='revolute'><parent link='base'/><child link='rod'/><origin xyz='0 0 0.5'/>
    <axis xyz='0 1 0'/><limit lower='-2' upper='2' effort='100' velocity='1'/></joint>
  <joint name='b' type='revolute'><parent link='rod'/><child link='fore'/><origin xyz='0.8 0 0' rpy='0.3 0 0.2'/>
    <axis xyz='0 1 0'/><limit lower='-2' upper='2' effort='80' velocity='1'/></joint>
  <joint name='t' type='fixed'><parent link='fore'/><child link='tool'/><origin xyz='0.5 0 0'/></joint>
  <joint name='slide' type='prismatic'><parent link='fore'/><child link='wrist'/><origin xyz='0.4 0 0'/>
    <axis xyz='0 1 0'/><limit lower='0.1' upper='0.6' velocity='1'/></joint>
  <joint name='turn' type='revolute'><parent link='wrist'/><child link='flap'/><origin xyz='0 0.1 0.1'/>
    <axis xyz='1 2 -1'/><limit lower='-2' upper='2' effort='0' velocity='1'/></joint>
  <joint name='follow' type='revolute'><parent link='wrist'/><child link='leaf'/><origin xyz='0 -0.1 0'/>
    <axis xyz='0 0 1'/><limit lower='-3' upper='3' effort='0' velocity='1'/>
    <mimic joint='turn' multiplier='-0.5' offset='0.1'/></joint>
</robot>)";

class Undriven : public testing::Test {
 protected:
  Undriven() : file_(folder_.path() / "robot.urdf") {
    std::ofstream(file_) << kArmWithFlap;
    std::ofstream(folder_.path() / "robot.srdf")
        << "<robot name='r'><group name='all'><joint name='a'/></group><group_state "
           "name='open' group='all'><joint name='a' value='0.4'/><joint name='turn' "
           "value='0.9'/></group_state></robot>";
  }
  Robot load(const std::map<std::string, double>& positions) const {
    return load_urdf(file_, {.tool = "tool", .positions = positions});
  }
  std::string error_of(const std::map<std::string, double>& positions) const {
    try {
      load(positions);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  }
  TemporaryFolder folder_;
  std::filesystem::path file_;
};

/// The same file as MuJoCo reads it, in which every joint moves.
class Peer {
 public:
  explicit Peer(const std::filesystem::path& file) {
    std::array<char, 1000> error{};
    model_.reset(mj_loadXML(file.c_str(), nullptr, error.data(), error.size()));
    EXPECT_TRUE(model_) << error.data();
    data_.reset(mj_makeData(model_.get()));
  }
  void place(const std::map<std::string, double>& positions) {
    for (const auto& [name, position] : positions) {
      data_->qpos[model_->jnt_qposadr[joint(name)]] = position;
    }
    mj_forward(model_.get(), data_.get());
  }
  /// The load of a joint at rest.
  double load(const std::string& name) const {
    return data_->qfrc_bias[model_->jnt_dofadr[joint(name)]];
  }
  /// The centre of the ball of this radius.
  Vector3d ball(double radius) const {
    for (int i = 0; i < model_->ngeom; ++i) {
      if (model_->geom_size[3 * i] == radius) return Vector3d(data_->geom_xpos + 3 * i);
    }
    ADD_FAILURE() << "no ball of " << radius;
    return {};
  }

 private:
  int joint(const std::string& name) const {
    return mj_name2id(model_.get(), mjOBJ_JOINT, name.c_str());
  }
  struct Free {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };
  std::unique_ptr<mjModel, Free> model_;
  std::unique_ptr<mjData, Free> data_;
};

/// Loads and shapes at these positions, of which slide and turn are those of joints without effort.
void expect_as_peer(const std::filesystem::path& file, const Robot& robot, double a, double b,
                    double slide, double turn) {
  ASSERT_EQ(robot.joints.size(), 2u);
  Peer peer(file);
  peer.place({{"a", a}, {"b", b}, {"slide", slide}, {"turn", turn}, {"follow", 0.1 - turn / 2}});
  Kinematics<double> kinematics(robot);
  kinematics.set_joints(Eigen::Vector2d(a, b));
  Eigen::VectorXd tau;
  kinematics.gravity_and_buoyancy(Eigen::Matrix3d::Identity(), tau);
  EXPECT_NEAR(tau[0], peer.load("a"), 1e-9);
  EXPECT_NEAR(tau[1], peer.load("b"), 1e-9);
  int balls = 0;
  for (const ConvexBody& body : robot.convex_bodies) {
    const Pose<double>& link = kinematics.links()[static_cast<std::size_t>(body.link)];
    for (const Vector3d& point : body.points) {  // the ends of a capsule without length
      EXPECT_LT((link.R * point + link.p - peer.ball(body.radius)).norm(), 1e-12);
    }
    ++balls;
  }
  EXPECT_EQ(balls, 2);
}

TEST_F(Undriven, StayWhereThePositionsPutMassAndShape) {
  const Robot moved = load({{"a", 0.3}, {"slide", 0.45}, {"turn", -1.1}});
  expect_as_peer(file_, moved, 0.3, -0.7, 0.45, -1.1);
  EXPECT_THAT(moved.warnings, Contains(HasSubstr("missing: the joint is locked at 0.45")));
}

TEST_F(Undriven, RestWithoutPositions) { expect_as_peer(file_, load({}), 0.3, -0.7, 0.1, 0); }

TEST_F(Undriven, StayInTheNamedPosture) {
  UrdfOptions options{.tool = "tool", .srdf = folder_.path() / "robot.srdf", .posture = "open"};
  expect_as_peer(file_, load_urdf(file_, options), 0.4, 0, 0.1, 0.9);
  options.positions = {{"turn", 0.2}};
  expect_as_peer(file_, load_urdf(file_, options), 0.4, 0, 0.1, 0.2);
}

TEST_F(Undriven, PositionsOutsideOfLimitsAndOfNoJointAreRejected) {
  EXPECT_THAT(error_of({{"turn", 2.5}}),
              HasSubstr("got turn = 2.5, expected a position within its limits -2 .. 2"));
  EXPECT_THAT(error_of({{"turn", std::numeric_limits<double>::quiet_NaN()}}),
              HasSubstr("got turn = nan, expected a position within its limits -2 .. 2"));
  EXPECT_THAT(error_of({{"hinge", 0}}), HasSubstr("expected a joint that moves: a, b"));
  EXPECT_THAT(error_of({{"follow", 0}}), HasSubstr("expected a joint that moves: a, b"));
}

/// Where the joint is counts for the value, and two positions are two tasks.
TEST_F(Undriven, TasksTakeThem) {
  const auto task_at = [&](double turn) {
    TaskSpec task;
    task.c = Vector6d::Unit(2);
    task.posture = {{"a", 0.3}, {"b", 0.7}, {"turn", turn}};
    return make_urdf_problem(file_, {.tool = "tool", .positions = *task.posture}, task);
  };
  EXPECT_NE(task_at(0.5).digest, task_at(0.6).digest);
}

/// The lift of one joint: (100 - tau_a) / x, x the tool's distance from the joint's axis.
TEST_F(Undriven, EvalTakesThem) {
  const CommandResult result = run_maxwrench(
      "eval robot.urdf --tool tool --joints a=0.3,b=0.7,slide=0.2,turn=1.3 --json", folder_.path());
  ASSERT_EQ(result.exit_status, 0) << result.err;
  Peer peer(file_);
  peer.place({{"a", 0.3}, {"b", 0.7}, {"slide", 0.2}, {"turn", 1.3}, {"follow", 0.1 - 0.65}});
  const nlohmann::json answer = nlohmann::json::parse(result.out);
  // tau_d + J'h = u, so that with F upwards at the tool both motors bear tau + F J_z.
  const Robot robot = load({});
  Kinematics<double> kinematics(robot);
  kinematics.set_joints(Eigen::Vector2d(0.3, 0.7));
  Matrix6Xd J(6, 2);
  kinematics.jacobian(robot.end_effectors[0], Eigen::Matrix3d::Identity(), J);
  double most = kInfinity;
  const std::array<double, 2> efforts = {100, 80};
  for (int i = 0; i < 2; ++i) {
    const double tau = peer.load(i == 0 ? "a" : "b"), slope = J(2, i);
    most = std::min(most, ((slope > 0 ? efforts[i] : -efforts[i]) - tau) / slope);
  }
  EXPECT_NEAR(answer["beta"], most, 1e-9 * most);
}

}  // namespace
}  // namespace maxwrench
