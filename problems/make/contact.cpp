#include "problems/make/contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/math/decompositions.h"
#include "lib/posture/dependent_joints.h"
#include "lib/posture/movable.h"
#include "lib/robot/chain.h"
#include "problems/make/theta_r.h"
#include "problems/loader/urdf_tree.h"

namespace maxwrench {
namespace {

constexpr const char* kForces = "none, point, push, friction, grasp or basis";
constexpr const char* kSurfaces = "point, line, plane or circle";

bool contains(const std::vector<int>& values, int value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

/// C and the bounds of w_2: `free` columns, or columns that may only push.
void set_basis(Matrix6Xd C, bool free, Contact& contact) {
  const Eigen::Index l = C.cols();
  contact.C = std::move(C);
  contact.w_min = Eigen::VectorXd::Constant(l, free ? -kInfinity : 0.0);
  contact.w_max = Eigen::VectorXd::Constant(l, kInfinity);
}

/// The edges of a pyramid inside the friction cone about z: e_z + mu e, e along +-x and +-y.
Matrix6Xd friction_edges(double mu) {
  Matrix6Xd C = Matrix6Xd::Zero(6, 4);
  C.row(2).setOnes();
  C.row(0) << mu, -mu, 0, 0;
  C.row(1) << 0, 0, mu, -mu;
  return C;
}

void read_basis(const Block& block, Contact& contact) {
  const std::vector<Block> list = block.list("basis");
  if (list.empty()) block.refuse_value("basis", "one direction or more");
  set_basis(Matrix6Xd::Zero(6, static_cast<Eigen::Index>(list.size())), true, contact);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    list[i].allow_only({"direction", "min", "max"});
    contact.C.col(j) = list[i].numbers("direction", 6);
    if (contact.C.col(j).norm() < 1e-9) {
      list[i].refuse_value("direction", "a direction of nonzero length");
    }
    contact.w_min[j] = list[i].number("min", -kInfinity);
    contact.w_max[j] = list[i].number("max", kInfinity);
    if (contact.w_min[j] > 0) list[i].refuse_value("min", "a number <= 0");
    if (contact.w_max[j] < 0) list[i].refuse_value("max", "a number >= 0");
  }
}

void read_forces(const Block& block, Contact& contact) {
  const std::string forces = block.text("forces");
  const Matrix6Xd all = Matrix6Xd::Identity(6, 6);
  contact.holds_axes = forces == "grasp";
  if (forces == "none") {
    set_basis(Matrix6Xd(6, 0), true, contact);
  } else if (forces == "point") {
    set_basis(all.leftCols(3), true, contact);
  } else if (forces == "push") {
    set_basis(all.middleCols(2, 1), false, contact);
  } else if (forces == "grasp") {
    set_basis(all, true, contact);
  } else if (forces == "friction") {
    const double mu = block.number("mu");
    if (!(mu > 0)) block.refuse_value("mu", "a number > 0");
    set_basis(friction_edges(mu), false, contact);
  } else if (forces == "basis") {
    read_basis(block, contact);
  } else {
    block.refuse_value("forces", kForces);
  }
  if (block.has("mu") && forces != "friction") {
    block.refuse_value("mu", "no such key, but for forces = 'friction'");
  }
}

/// The directions of `basis` that may be pulled and pushed without limit: none of their sums may be
/// free of work, or zero, because nothing would bound it. One alone that does no work is refused
/// whatever its limits.
void require_work(const Block& block, const Eigen::MatrixXd& works, const Contact& contact) {
  const std::vector<Block> list = block.list("basis");
  std::vector<Eigen::Index> free;
  for (Eigen::Index j = 0; j < works.cols(); ++j) {
    if (works.col(j).norm() < kRankTolerance * contact.C.col(j).norm()) {
      list[static_cast<std::size_t>(j)].refuse_value(
          "direction", "one that does work: the end effector can move along it");
    }
    if (contact.w_min[j] == -kInfinity && contact.w_max[j] == kInfinity) free.push_back(j);
  }
  const Eigen::MatrixXd both = works(Eigen::all, free);
  const auto rank = split(both, kRankTolerance).range.cols();
  if (rank == both.cols()) return;
  block.refuse_value(
      "basis", fmt::format("{} directions without limits", free.size()),
      fmt::format("no more than do work independently of each other, {} of these", rank));
}

/// Leaves out of C what does no work, because the structure takes it: of free forces all such
/// columns, of others their part along which the end effector cannot move.
void drop_idle(const Block& block, const Robot& robot, Contact& contact) {
  const std::string forces = block.text("forces");
  const Eigen::Matrix<double, 6, 6> movable = movable_at_contact(robot, contact);
  const Matrix6Xd works = movable * contact.C;
  if (forces == "basis") require_work(block, works, contact);
  if ((forces == "push" || forces == "friction") && movable.col(2).norm() < kRankTolerance) {
    block.refuse_value("rpy", "a frame along whose z the end effector can move");
  }
  if (movable.isIdentity(kRankTolerance)) return;
  if (forces == "point" || forces == "grasp") {
    set_basis(tidy_range(works), true, contact);
  } else {
    contact.C = works;
  }
}

Surface read_surface(const Block& block) {
  const std::string name = block.text("surface", "point");
  if (name == "point") return Surface::kPoint;
  if (name == "line") return Surface::kLine;
  if (name == "plane") return Surface::kPlane;
  if (name == "circle") return Surface::kCircle;
  block.refuse_value("surface", kSurfaces);
}

/// Where the joints of the arm that do not follow rest.
void read_rest(const Block& block, const std::vector<int>& chain, Problem& problem,
               Contact& contact) {
  const Robot& robot = problem.robot;
  contact.q_rest.resize(static_cast<Eigen::Index>(robot.joints.size()));
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    contact.q_rest[static_cast<Eigen::Index>(i)] =
        std::clamp(0.0, robot.joints[i].q_min, robot.joints[i].q_max);
  }
  const Block rest = block.table("rest");
  std::vector<std::string> resting;
  for (const int i : chain) {
    if (contains(contact.follow, i)) continue;
    const Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    resting.push_back(joint.name);
    const double value = rest.number(joint.name, contact.q_rest[i]);
    if (value < joint.q_min || value > joint.q_max) {
      rest.refuse_value(joint.name,
                        fmt::format("a number within {} .. {}", joint.q_min, joint.q_max));
    }
    contact.q_rest[i] = value;
    if (!problem.dependent.empty()) problem.guess_q[i] = value;
  }
  rest.allow_only({resting.begin(), resting.end()});
}

/// Which joints of the arm follow; the others rest.
void read_arm(const Block& block, Problem& problem, Contact& contact) {
  const Robot& robot = problem.robot;
  const std::vector<int> chain = chain_to(robot, contact.end_effector);
  if (chain.empty()) block.refuse_value("end_effector", "an end effector on an arm of its own");
  for (const int joint : chain_to(robot, problem.end_effector)) {
    if (contains(chain, joint)) {
      block.refuse_value("end_effector",
                         "an end effector on an arm of its own (the first one "
                         "shares a joint with it)");
    }
  }
  const std::string names = names_of(robot, chain);
  for (const std::string& name : block.texts("joints")) {
    const auto found = std::find_if(chain.begin(), chain.end(), [&](int joint) {
      return robot.joints[static_cast<std::size_t>(joint)].name == name;
    });
    if (found == chain.end()) block.refuse_value("joints", "some of " + names);
    contact.follow.push_back(*found);
  }
  const bool ordered =
      std::is_sorted(contact.follow.begin(), contact.follow.end()) &&
      std::adjacent_find(contact.follow.begin(), contact.follow.end()) == contact.follow.end();
  const auto most = static_cast<std::size_t>(contact.rows());
  if (!ordered || contact.follow.empty() || contact.follow.size() > most) {
    block.refuse_value("joints", fmt::format("at most {} of {}, in this order", most, names));
  }
  if (contact.holds_axes && contact.follow.size() != most) {
    block.refuse_value("joints", "six joints: a firm grasp needs them");
  }
  const int ways = following_rank(robot, contact);
  if (ways < static_cast<int>(contact.follow.size())) {
    block.refuse_value("joints",
                       fmt::format("joints that the contact fixes: of these {} it fixes {}",
                                   contact.follow.size(), ways));
  }
  read_rest(block, chain, problem, contact);
}

void read_coordinates(const Block& block, Problem& problem, const Contact& contact) {
  const int count = contact.coordinates();
  for (const char* key : {"min", "max", "default"}) {
    if (count == 0 && block.has(key)) block.refuse_value(key, "no such key: a point has none");
  }
  if (count == 0) return;
  const Eigen::VectorXd low = block.numbers("min", count), high = block.numbers("max", count);
  const Eigen::VectorXd start = block.numbers("default", count);
  if (!(low.array() < high.array()).all()) block.refuse_value("max", "numbers > min");
  if ((start.array() < low.array()).any() || (start.array() > high.array()).any()) {
    block.refuse_value("default", "numbers within min .. max");
  }
  const auto append = [count](Eigen::VectorXd& all, const Eigen::VectorXd& own) {
    all.conservativeResize(all.size() + count);
    all.tail(count) = own;
  };
  append(problem.theta_r_min, low);
  append(problem.theta_r_max, high);
  append(problem.theta_r_default, start);
}

}  // namespace

void read_contact(const Block& block, Problem& problem) {
  block.allow_only({"end_effector", "forces", "mu", "basis", "surface", "xyz", "rpy", "radius",
                    "min", "max", "default", "joints", "rest", "length_scale", "sigma_min"});
  Contact contact;
  const std::string wanted = block.text("end_effector");
  const auto& tips = problem.robot.end_effectors;
  const auto found = std::find_if(tips.begin(), tips.end(),
                                  [&](const EndEffector& tip) { return tip.name == wanted; });
  if (found == tips.end()) block.refuse_value("end_effector", "an end effector of the robot");
  contact.end_effector = static_cast<int>(found - tips.begin());
  contact.surface = read_surface(block);
  contact.frame = pose_from_xyz_rpy(block.vector("xyz"), block.vector("rpy"));
  const bool circle = contact.surface == Surface::kCircle;
  if (block.has("radius") && !circle) block.refuse_value("radius", "no such key, but for a circle");
  if (circle) contact.radius = block.number("radius");
  if (circle && !(contact.radius > 0)) block.refuse_value("radius", "a number > 0");
  read_forces(block, contact);
  drop_idle(block, problem.robot, contact);
  read_arm(block, problem, contact);
  contact.length_scale = block.number("length_scale", contact.length_scale);
  if (!(contact.length_scale > 0)) block.refuse_value("length_scale", "a number > 0");
  contact.sigma_min = block.non_negative("sigma_min", contact.sigma_min);
  contact.rank = stacked_rank(problem.robot, problem.end_effector, contact);
  read_coordinates(block, problem, contact);
  if (block.has("basis") && block.text("forces") != "basis") {
    block.refuse_value("basis", "no such key, but for forces = 'basis'");
  }
  problem.contact = std::move(contact);
}

}  // namespace maxwrench
