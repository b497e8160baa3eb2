#include "tests/support/support.h"

#include <sys/wait.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>

namespace {
std::atomic<long> allocations{0};
}

#if !defined(MAXWRENCH_SANITIZED)
// Counts allocations in the whole test program, to check that the hot loop does not allocate. Eigen
// and operator new both call malloc. Sanitizers replace malloc, so nothing is counted with them.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
}
#endif

namespace maxwrench {

long allocation_count() { return allocations; }

Eigen::Vector3d random_vector(Random& random, double scale) {
  return {random.uniform(-scale, scale), random.uniform(-scale, scale),
          random.uniform(-scale, scale)};
}

Eigen::Matrix3d random_rotation(Random& random) {
  return Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
      .normalized()
      .toRotationMatrix();
}

Problem random_problem(Random& random, int joints) {
  Problem problem;
  problem.name = "random";
  Robot& robot = problem.robot;
  robot.name = "random";
  robot.base_axes = {0, 1, 2, 3, 4, 5};
  robot.water_density = 1000;
  for (int i = 0; i <= joints; ++i) {
    Link link;
    link.mass = random.uniform(0.5, 3);
    link.com = random_vector(random, 0.1);
    link.volume = random.uniform(0, 0.003);
    link.cob = random_vector(random, 0.1);
    robot.links.push_back(link);
  }
  for (int i = 0; i < joints; ++i) {
    Joint joint;
    joint.type = i % 3 == 2 ? JointType::kPrismatic : JointType::kRevolute;
    joint.parent = i;
    joint.placement = {random_rotation(random), random_vector(random, 0.3)};
    joint.axis = random_vector(random).normalized();
    joint.q_min = -1.5;
    joint.q_max = 1.5;
    joint.effort_max = random.uniform(5, 15);
    robot.joints.push_back(joint);
    problem.redundant.push_back(i);
  }
  for (int i = 0; i < 8; ++i) {
    Thruster thruster;
    thruster.position = random_vector(random, 0.4);
    thruster.direction = random_vector(random).normalized();
    thruster.force_min = random.uniform(-60, -30);
    thruster.force_max = random.uniform(30, 60);
    robot.thrusters.push_back(thruster);
  }
  robot.end_effectors = {{"tool", joints, {random_rotation(random), random_vector(random, 0.2)}}};
  complete_actuation(robot);
  problem.pose = {random_rotation(random), random_vector(random)};
  problem.c = Vector6d::NullaryExpr([&](Eigen::Index) { return random.normal(); }).normalized();
  problem.W_any = Matrix6Xd::Identity(6, 6);
  problem.theta_r_min = Eigen::VectorXd::Constant(joints, -1.5);
  problem.theta_r_max = Eigen::VectorXd::Constant(joints, 1.5);
  problem.theta_r_default = Eigen::VectorXd::Zero(joints);
  return problem;
}

Eigen::VectorXd random_theta_r(const Problem& problem, Random& random) {
  Eigen::VectorXd theta_r(problem.redundancy());
  for (int i = 0; i < problem.redundancy(); ++i) {
    theta_r[i] = random.uniform(problem.theta_r_min[i], problem.theta_r_max[i]);
  }
  return theta_r;
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

CommandResult run_maxwrench(const std::string& words, const std::filesystem::path& folder) {
  const TemporaryFolder capture;
  const std::string command = "cd '" + folder.string() + "' && '" MAXWRENCH_COMMAND "' " + words +
                              " > '" + (capture.path() / "out").string() + "' 2> '" +
                              (capture.path() / "err").string() + "' < /dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(capture.path() / "out"),
          read_text(capture.path() / "err")};
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "maxwrench.XXXXXX").string();
  path_ = mkdtemp(pattern.data());
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace maxwrench
