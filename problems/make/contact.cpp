#include "problems/make/contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lib/math/decompositions.h"
#include "lib/posture/movable.h"
#include "lib/robot/chain.h"
#include "problems/make/bad_value.h"
#include "problems/make/redundant_joints.h"
#include "problems/make/theta_r.h"

namespace maxwrench {
namespace {

constexpr const char* kForces = "none, point, push, friction, grasp or basis";

bool contains(const std::vector<int>& values, int value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

/// Sets C and the bounds of w_2. The columns are free, or may only push.
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

std::string basis_key(Eigen::Index j, const char* key) {
  return fmt::format("contact.basis[{}].{}", j, key);
}

void set_directions(const ContactSpec& spec, Contact& contact) {
  if (spec.basis.empty()) throw BadValue("contact.basis", "nothing", "one direction or more");
  set_basis(Matrix6Xd::Zero(6, static_cast<Eigen::Index>(spec.basis.size())), true, contact);
  Eigen::Index j = 0;
  for (const auto& [direction, min, max] : spec.basis) {
    require_numbers(basis_key(j, "direction"), direction, 6);
    if (direction.norm() < 1e-9) {
      throw BadValue(basis_key(j, "direction"), shown(direction), "a direction of nonzero length");
    }
    contact.C.col(j) = direction;
    contact.w_min[j] = min;
    contact.w_max[j] = max;
    if (!(min <= 0)) throw BadValue(basis_key(j, "min"), shown(min), "a number <= 0");
    if (!(max >= 0)) throw BadValue(basis_key(j, "max"), shown(max), "a number >= 0");
    ++j;
  }
}

void set_forces(const ContactSpec& spec, Contact& contact) {
  const std::string& forces = spec.forces;
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
    if (!spec.mu) throw BadValue("contact.mu", "nothing", "a finite number");
    require_finite("contact.mu", *spec.mu);
    require_positive("contact.mu", *spec.mu);
    set_basis(friction_edges(*spec.mu), false, contact);
  } else if (forces == "basis") {
    set_directions(spec, contact);
  } else {
    throw BadValue("contact.forces", forces.empty() ? "nothing" : shown(forces), kForces);
  }
  if (spec.mu && forces != "friction") {
    throw BadValue("contact.mu", shown(*spec.mu), "no such key unless forces = 'friction'");
  }
}

/// The directions of `basis` that may be pulled and pushed without limit. No combination of them
/// may be zero or do no work, because nothing would bound it. A single direction that does no work
/// is rejected whatever its limits.
void require_work(const Eigen::MatrixXd& works, const Contact& contact) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index j = 0; j < works.cols(); ++j) {
    if (works.col(j).norm() < kRankTolerance * contact.C.col(j).norm()) {
      throw BadValue(basis_key(j, "direction"), shown(contact.C.col(j)),
                     "one that does work: the end effector can move along it");
    }
    if (contact.w_min[j] == -kInfinity && contact.w_max[j] == kInfinity) free.push_back(j);
  }
  const Eigen::MatrixXd both = works(Eigen::all, free);
  const auto rank = split(both, kRankTolerance).range.cols();
  if (rank == both.cols()) return;
  throw BadValue(
      "contact.basis", fmt::format("{} directions without limits", free.size()),
      fmt::format("at most as many as do work independently of each other, {} of these", rank));
}

/// Angles of rotations about the fixed axes x, y, z, in this order.
Eigen::Vector3d rpy_of(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d rpy(std::atan2(R(2, 1), R(2, 2)),
                            std::atan2(-R(2, 0), std::hypot(R(0, 0), R(1, 0))),
                            std::atan2(R(1, 0), R(0, 0)));
  return rpy.array() + 0.0;  // no -0
}

/// Removes from C the parts that do no work, because the structure takes them: for free forces all
/// such columns, for others their part along which the end effector cannot move.
void drop_idle(const std::string& forces, const Robot& robot, Contact& contact) {
  const Eigen::Matrix<double, 6, 6> movable = movable_at_contact(robot, contact);
  const Matrix6Xd works = movable * contact.C;
  if (forces == "basis") require_work(works, contact);
  if ((forces == "push" || forces == "friction") && movable.col(2).norm() < kRankTolerance) {
    throw BadValue("contact.rpy", shown(rpy_of(contact.frame.R)),
                   "a frame along whose z the end effector can move");
  }
  if (movable.isIdentity(kRankTolerance)) return;
  if (forces == "point" || forces == "grasp") {
    set_basis(tidy_range(works), true, contact);
  } else {
    contact.C = works;
  }
}

/// Sets the rest positions of the arm's joints that are not dependent.
void set_rest(const ContactSpec& spec, const std::vector<int>& chain, Problem& problem,
              Contact& contact) {
  const Robot& robot = problem.robot;
  contact.q_rest = resting_joints(robot);
  std::map<std::string, double> given = spec.rest;
  std::vector<int> resting;
  for (const int i : chain) {
    if (contains(contact.follow, i)) continue;
    resting.push_back(i);
    const Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    const auto found = given.find(joint.name);
    if (found != given.end()) {
      const double value = found->second;
      const std::string key = "contact.rest." + joint.name;
      require_finite(key, value);
      if (value < joint.q_min || value > joint.q_max) {
        throw BadValue(key, shown(value),
                       fmt::format("a number within {} .. {}", joint.q_min, joint.q_max));
      }
      contact.q_rest[i] = value;
      given.erase(found);
    }
    if (!problem.dependent.empty()) problem.guess_q[i] = contact.q_rest[i];
  }
  if (given.empty()) return;
  throw BadValue("contact.rest." + given.begin()->first, "an unknown key",
                 fmt::format("one of {}", names_of(robot, resting)));
}

[[noreturn]] void throw_bad_dependents(const ContactSpec& spec, const std::string& expected) {
  throw BadValue("contact.joints", spec.joints.empty() ? "nothing" : shown(spec.joints), expected);
}

/// Sets which joints of the arm are dependent; the others rest.
void set_arm(const ContactSpec& spec, Problem& problem, Contact& contact) {
  const Robot& robot = problem.robot;
  const char* key = "contact.end_effector";
  require_no_gears(key, robot, contact.end_effector);
  const std::vector<int> chain = chain_to(robot, contact.end_effector);
  if (chain.empty()) {
    throw BadValue(key, shown(spec.end_effector), "an end effector with its own arm");
  }
  for (const int joint : chain_to(robot, problem.end_effector)) {
    if (!contains(chain, joint)) continue;
    throw BadValue(key, shown(spec.end_effector),
                   "an end effector with its own arm (the first one shares a joint with it)");
  }
  const std::string names = names_of(robot, chain);
  for (const std::string& name : spec.joints) {
    const auto found = std::find_if(chain.begin(), chain.end(), [&](int joint) {
      return robot.joints[static_cast<std::size_t>(joint)].name == name;
    });
    if (found == chain.end()) throw_bad_dependents(spec, "some of " + names);
    contact.follow.push_back(*found);
  }
  const bool ordered =
      std::is_sorted(contact.follow.begin(), contact.follow.end()) &&
      std::adjacent_find(contact.follow.begin(), contact.follow.end()) == contact.follow.end();
  const auto most = static_cast<std::size_t>(contact.rows());
  if (!ordered || contact.follow.empty() || contact.follow.size() > most) {
    throw_bad_dependents(spec, fmt::format("at most {} of {}, in this order", most, names));
  }
  if (contact.holds_axes && contact.follow.size() != most) {
    throw_bad_dependents(spec, "six joints: a firm grasp needs them");
  }
  const int ways = dependent_rank(robot, contact);
  if (ways < static_cast<int>(contact.follow.size())) {
    throw_bad_dependents(
        spec, fmt::format("joints that the contact determines: of these {} it determines {}",
                          contact.follow.size(), ways));
  }
  set_rest(spec, chain, problem, contact);
}

void add_coordinates(const ContactSpec& spec, Problem& problem, const Contact& contact) {
  const int count = contact.coordinates();
  for (const auto& [name, values] : {std::pair("min", &spec.min), std::pair("max", &spec.max),
                                     std::pair("default", &spec.initial)}) {
    const std::string key = std::string("contact.") + name;
    if (count > 0) require_numbers(key, *values, count);
    if (count > 0 || values->size() == 0) continue;
    throw BadValue(key, shown(*values), "no such key: a point has none");
  }
  if (count == 0) return;
  if (!(spec.min.array() < spec.max.array()).all()) {
    throw BadValue("contact.max", shown(spec.max), "numbers > min");
  }
  if ((spec.initial.array() < spec.min.array()).any() ||
      (spec.initial.array() > spec.max.array()).any()) {
    throw BadValue("contact.default", shown(spec.initial), "numbers within min .. max");
  }
  const auto append = [count](Eigen::VectorXd& all, const Eigen::VectorXd& own) {
    all.conservativeResize(all.size() + count);
    all.tail(count) = own;
  };
  append(problem.theta_r_min, spec.min);
  append(problem.theta_r_max, spec.max);
  append(problem.theta_r_default, spec.initial);
}

}  // namespace

void set_contact(const ContactSpec& spec, Problem& problem) {
  Contact contact;
  contact.end_effector =
      find_end_effector("contact.end_effector", spec.end_effector, problem.robot);
  contact.surface = spec.surface;
  require_pose("contact", spec.frame);
  contact.frame = spec.frame;
  const bool circle = contact.surface == Surface::kCircle;
  if (spec.radius && !circle) {
    throw BadValue("contact.radius", shown(*spec.radius),
                   "no such key unless the shape is a circle");
  }
  if (circle && !spec.radius) throw BadValue("contact.radius", "nothing", "a finite number");
  contact.radius = spec.radius.value_or(0);
  require_finite("contact.radius", contact.radius);
  if (circle) require_positive("contact.radius", contact.radius);
  set_forces(spec, contact);
  drop_idle(spec.forces, problem.robot, contact);
  set_arm(spec, problem, contact);
  require_finite("contact.length_scale", spec.length_scale);
  require_positive("contact.length_scale", spec.length_scale);
  contact.length_scale = spec.length_scale;
  require_non_negative("contact.sigma_min", spec.sigma_min);
  contact.sigma_min = spec.sigma_min;
  contact.rank = stacked_rank(problem.robot, problem.end_effector, contact);
  add_coordinates(spec, problem, contact);
  if (!spec.basis.empty() && spec.forces != "basis") {
    throw BadValue("contact.basis", fmt::format("{} directions", spec.basis.size()),
                   "no such key unless forces = 'basis'");
  }
  problem.contact = std::move(contact);
}

}  // namespace maxwrench
