/// Reads all URDFs of a folder and compares each with what urdfdom, kdl_parser and KDL make of it.
///
/// usage: gallery FOLDER > TABLE.csv
///
/// A row has the file, whether it is read or why not, the numbers of warnings, links, joints and
/// hulls, the seconds of reading, whether the peer reads it, and the largest differences over five
/// random postures: of the poses of all links at the ends of chains [m or 1], of their Jacobians
/// [m or 1], and of the loads of gravity [N m or N], relative to 1 + the peer's.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <kdl/tree.hpp>
#include <kdl/treefksolverpos_recursive.hpp>
#include <kdl/treeidsolver_recursive_newton_euler.hpp>
#include <kdl/treejnttojacsolver.hpp>
#include <kdl_parser/kdl_parser.hpp>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "lib/math/random.h"
#include "lib/robot/chain.h"
#include "lib/robot/kinematics.h"
#include "maxwrench/load.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

/// The largest differences from the peer.
struct Differences {
  double pose = 0, jacobian = 0, gravity = 0;
};

/// Raises `largest`; a difference that is not a number stays.
void raise(double& largest, double difference) {
  if (!(difference <= largest)) largest = difference;
}

std::string read_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The peer's joints at the positions of ours.
class Peer {
 public:
  Peer(const KDL::Tree& tree, const Robot& robot) : tree_(tree), robot_(robot) {
    for (const auto& [name, segment] : tree.getSegments()) {
      const KDL::Joint& joint = segment.segment.getJoint();
      if (joint.getType() != KDL::Joint::None) index_[joint.getName()] = segment.q_nr;
    }
  }

  bool has_all_joints() const {
    return std::all_of(robot_.joints.begin(), robot_.joints.end(),
                       [this](const Joint& joint) { return index_.contains(joint.name); });
  }

  /// A joint that is locked here stays at zero there.
  KDL::JntArray joints(const Eigen::VectorXd& q) const {
    KDL::JntArray all(tree_.getNrOfJoints());
    for (std::size_t i = 0; i < robot_.joints.size(); ++i) {
      all(index_.at(robot_.joints[i].name)) = q[static_cast<Eigen::Index>(i)];
    }
    return all;
  }

  unsigned index(std::size_t joint) const { return index_.at(robot_.joints[joint].name); }

 private:
  const KDL::Tree& tree_;
  const Robot& robot_;
  std::map<std::string, unsigned> index_;
};

void compare_gravity(const KDL::Tree& tree, const Peer& peer, const Robot& robot,
                     const KDL::JntArray& q, Kinematics<double>& kinematics,
                     Differences& differences) {
  const unsigned n = tree.getNrOfJoints();
  KDL::TreeIdSolver_RNE solver(tree, KDL::Vector(0, 0, -robot.gravity));
  KDL::JntArray tau(n);
  if (solver.CartToJnt(q, KDL::JntArray(n), KDL::JntArray(n), KDL::WrenchMap(), tau) < 0) return;
  Eigen::VectorXd ours;
  kinematics.gravity_and_buoyancy(Eigen::Matrix3d::Identity(), ours);
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const double theirs = tau(peer.index(i));
    raise(differences.gravity,
          std::abs(ours[static_cast<Eigen::Index>(i)] - theirs) / (1 + std::abs(theirs)));
  }
}

void compare_tip(const KDL::Tree& tree, const Peer& peer, const Robot& robot,
                 const EndEffector& tip, const KDL::JntArray& q,
                 const Kinematics<double>& kinematics, Differences& differences) {
  KDL::TreeFkSolverPos_recursive fk(tree);
  KDL::TreeJntToJacSolver jacobian(tree);
  KDL::Frame frame;
  KDL::Jacobian J(tree.getNrOfJoints());
  if (fk.JntToCart(q, frame, tip.name) < 0 || jacobian.JntToJac(q, J, tip.name) < 0) {
    differences.pose = kInfinity;
    return;
  }
  const Pose<double> pose = kinematics.end_effector(tip);
  Matrix6Xd ours;
  kinematics.jacobian(tip, Eigen::Matrix3d::Identity(), ours);
  for (int r = 0; r < 3; ++r) {
    raise(differences.pose, std::abs(pose.p[r] - frame.p(r)));
    for (int c = 0; c < 3; ++c) raise(differences.pose, std::abs(pose.R(r, c) - frame.M(r, c)));
  }
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    for (int r = 0; r < 6; ++r) {
      raise(differences.jacobian, std::abs(ours(r, static_cast<Eigen::Index>(i)) -
                                           J(static_cast<unsigned>(r), peer.index(i))));
    }
  }
}

std::optional<Differences> compare(const fs::path& file, const Robot& robot) {
  KDL::Tree tree;
  if (!kdl_parser::treeFromString(read_file(file), tree)) return std::nullopt;
  const Peer peer(tree, robot);
  if (!peer.has_all_joints()) return std::nullopt;
  Differences differences;
  Kinematics<double> kinematics(robot);
  Random random(1);
  Eigen::VectorXd q(robot.joints.size());
  for (int posture = 0; posture < 5; ++posture) {
    draw_joints(robot, random, q);
    kinematics.set_joints(q);
    const KDL::JntArray theirs = peer.joints(q);
    for (const EndEffector& tip : robot.end_effectors) {
      compare_tip(tree, peer, robot, tip, theirs, kinematics, differences);
    }
    compare_gravity(tree, peer, robot, theirs, kinematics, differences);
  }
  return differences;
}

/// A field of a CSV table.
std::string field(std::string text) {
  std::replace(text.begin(), text.end(), '"', '\'');
  return text.find_first_of(",\n") == std::string::npos ? text : '"' + text + '"';
}

void print_row(const fs::path& folder, const fs::path& file) {
  using Clock = std::chrono::steady_clock;
  const std::string name = file.lexically_relative(folder).string();
  const auto start = Clock::now();
  try {
    const Robot robot = load_urdf(file);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    const std::optional<Differences> d = compare(file, robot);
    fmt::print(
        "{},read,,{},{},{},{},{:.3f},{}\n", field(name),
        robot.warnings.size() + robot.no_dynamics.size(), robot.links.size(), robot.joints.size(),
        robot.convex_bodies.size(), seconds,
        d ? fmt::format("yes,{:.1e},{:.1e},{:.1e}", d->pose, d->jacobian, d->gravity) : "no,,,");
  } catch (const std::invalid_argument& error) {
    std::string why = error.what();
    why.erase(0, std::min(why.size(), file.string().size() + 2));
    fmt::print("{},rejected,{},,,,,,,,,\n", field(name), field(why));
  }
}

}  // namespace
}  // namespace maxwrench

int main(int argc, char** argv) {
  if (argc != 2 || !std::filesystem::is_directory(argv[1])) {
    fmt::print(stderr, "usage: gallery FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".urdf") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  fmt::print("file,result,why,warnings,links,joints,shapes,seconds,peer,pose,jacobian,gravity\n");
  for (const auto& file : files) maxwrench::print_row(folder, file);
  return 0;
}
