#include "verify/certificate.h"

#include <stdexcept>
#include <string_view>

#include "verify/bytes.h"
#include "verify/sealed.h"

namespace maxwrench {
namespace {

constexpr std::string_view kMagic = "maxwrench proof 2\n";
constexpr std::string_view kListMagic = "maxwrench proof 3\n";
constexpr std::size_t kMostNodes = 50'000'000;

void put_pose(ByteWriter& to, const Pose<double>& pose) {
  to.matrix(pose.R);
  to.matrix(pose.p);
}

void put_core(ByteWriter& to, const InnerBody& core) {
  to.count(core.link);
  put_pose(to, core.placement);
  to.matrix(core.half_sizes);
  if (!core.points.empty()) to.count(static_cast<Eigen::Index>(core.points.size()));
  for (const Eigen::Vector3d& x : core.points) to.matrix(x);
}

void put_collision(ByteWriter& to, const CollisionChecker* checker) {
  const int pairs = checker == nullptr ? 0 : checker->pairs();
  to.count(pairs);
  for (int i = 0; i < pairs; ++i) {
    InnerBodyPair pair;
    const bool known = checker->inner_bodies(i, pair);
    to.whole(known ? 1 : 0, 1);
    if (!known) continue;
    put_core(to, pair.a);
    put_core(to, pair.b);
    to.real(pair.reach);
  }
}

void put_robot(ByteWriter& to, const Robot& robot) {
  for (const int axis : robot.base_axes) to.count(axis);
  for (const Link& link : robot.links) {
    to.real(link.mass);
    to.matrix(link.com);
    to.real(link.volume);
    to.matrix(link.cob);
  }
  for (const Joint& joint : robot.joints) {
    to.count(joint.type == JointType::kRevolute ? 0 : 1);
    to.count(joint.parent);
    put_pose(to, joint.placement);
    to.matrix(joint.axis);
    to.real(joint.q_min);
    to.real(joint.q_max);
  }
  to.real(robot.gravity);
  to.real(robot.water_density);
  to.real(robot.trim.buoyancy_mass);
  to.matrix(robot.trim.position);
  to.matrix(robot.actuation.B);
  to.matrix(robot.actuation.u_min);
  to.matrix(robot.actuation.u_max);
  put_collision(to, robot.collision.get());
}

void put_end_effector(ByteWriter& to, const Robot& robot, int index) {
  const EndEffector& tip = robot.end_effectors[static_cast<std::size_t>(index)];
  to.count(tip.link);
  put_pose(to, tip.placement);
}

void put_contact(ByteWriter& to, const Robot& robot, const Contact& contact) {
  put_end_effector(to, robot, contact.end_effector);
  to.count(static_cast<int>(contact.surface));
  put_pose(to, contact.frame);
  to.real(contact.radius);
  for (const Eigen::MatrixXd& each :
       {Eigen::MatrixXd(contact.C), Eigen::MatrixXd(contact.w_min), Eigen::MatrixXd(contact.w_max),
        Eigen::MatrixXd(contact.q_rest)}) {
    to.matrix(each);
  }
  to.whole(contact.holds_axes ? 1 : 0, 1);
  to.real(contact.length_scale);
  to.real(contact.sigma_min);
  for (const int joint : contact.follow) to.count(joint);
}

void put_load(ByteWriter& to, const LoadCase& load) {
  to.count(static_cast<Eigen::Index>(load.loads.size()));
  for (const LinkLoad& change : load.loads) {
    to.count(change.link);
    to.real(change.mass);
    to.matrix(change.moment);
  }
  to.matrix(load.current);
}

void put_list(ByteWriter& to, const ScenarioList& list) {
  to.count(static_cast<Eigen::Index>(list.wrenches.size()));
  for (const ScenarioWrench& wrench : list.wrenches) {
    to.matrix(wrench.c);
    to.whole(wrench.hold ? 1 : 0, 1);
  }
  to.whole((list.ball ? 1 : 0) + (list.payload ? 2 : 0) + (list.non_negative ? 4 : 0), 1);
  if (list.ball) {
    to.matrix(list.ball->E);
    to.real(list.ball->radius);
  }
  if (list.payload) {
    to.real(list.payload->wet_mass);
    to.matrix(list.payload->moment);
  }
  to.count(static_cast<Eigen::Index>(list.limits.size()));
  for (const ScenarioLimits& limits : list.limits) {
    to.matrix(limits.actuation.u_min);
    to.matrix(limits.actuation.u_max);
  }
  to.count(static_cast<Eigen::Index>(list.loads.size()));
  for (const LoadGroup& group : list.loads) {
    to.count(static_cast<Eigen::Index>(group.size()));
    for (const LoadCase& load : group) put_load(to, load);
  }
}

/// A tag has two bits for the reason, five for the axis (a box of 31 coordinates has 3^31 control
/// points), and this bit if the cut is not at the middle.
constexpr int kElsewhere = 128;

void put_tree(ByteWriter& to, const CertificateTree& tree) {
  to.count(tree.width);
  to.count(tree.equations);
  if (tree.of_list) to.count(tree.shared);
  to.count(static_cast<Eigen::Index>(tree.nodes.size()));
  for (const CertificateTree::Node& node : tree.nodes) {
    const int tag = static_cast<int>(node.reason) | (node.axis + 1) << 2;
    to.whole(static_cast<std::uint64_t>(tag | (node.at ? kElsewhere : 0)), 1);
    if (node.at) to.real(*node.at);
    if (node.reason == CertificateTree::Reason::kCollision) {
      to.whole(static_cast<std::uint64_t>(node.pair), 4);
    }
    if (tree.of_list && node.reason == CertificateTree::Reason::kMultiplier) {
      to.whole(node.parts, 1);
    }
    for (std::size_t i = 0; i < tree.numbers(node); ++i) {
      to.real(tree.multipliers[node.multiplier + i]);
    }
  }
}

/// Reads a tree. False if the data contain none.
bool take_tree(ByteReader& from, CertificateTree& tree) {
  tree.width = static_cast<int>(from.count(sizeof(double)));
  tree.equations = static_cast<int>(from.count(sizeof(double)));
  if (tree.of_list) tree.shared = static_cast<int>(from.count(sizeof(double)));
  const std::size_t nodes = from.count(1);
  if (nodes > kMostNodes) return false;
  tree.nodes.resize(nodes);
  for (CertificateTree::Node& node : tree.nodes) {
    const auto tag = static_cast<int>(from.whole(1));
    if (!from.good()) return false;
    node.reason = static_cast<CertificateTree::Reason>(tag & 3);
    node.axis = (tag % kElsewhere >> 2) - 1;
    if ((tag & kElsewhere) != 0) node.at = from.real();
    if (node.reason == CertificateTree::Reason::kCollision) {
      node.pair = static_cast<int>(from.whole(4));
    }
    if (tree.of_list && node.reason == CertificateTree::Reason::kMultiplier) {
      node.parts = static_cast<std::size_t>(from.whole(1));
    }
    node.multiplier = tree.multipliers.size();
    const std::size_t numbers = tree.numbers(node);
    for (std::size_t i = 0; i < numbers && from.good(); ++i) {
      tree.multipliers.push_back(from.real());
    }
  }
  return true;
}

/// A robot without gears has the digest that it always had.
void put_gear(ByteWriter& to, const Gear& gear) {
  to.count(gear.leader);
  to.real(gear.ratio);
  to.real(gear.offset);
}

}  // namespace

std::uint64_t digest(const Problem& problem) {
  ByteWriter all;
  put_robot(all, problem.robot);
  put_end_effector(all, problem.robot, problem.end_effector);
  put_pose(all, problem.pose);
  all.matrix(problem.c);
  all.matrix(problem.W_any);
  for (const int joint : problem.redundant) all.count(joint);
  for (const int joint : problem.dependent) all.count(joint);
  put_pose(all, problem.robot.mount);
  for (const int axis : problem.free.axes) all.count(axis);
  all.whole((problem.free.along_end_effector ? 1 : 0) + (problem.free.wrench_turns ? 2 : 0), 1);
  if (problem.contact) put_contact(all, problem.robot, *problem.contact);
  if (!problem.scenarios.empty()) put_list(all, problem.scenarios);
  for (const Joint& joint : problem.robot.joints) {
    if (joint.gear) put_gear(all, *joint.gear);
  }
  all.matrix(problem.theta_r_min);
  all.matrix(problem.theta_r_max);
  return digest_of(all.text());
}

std::string certificate_text(const ProofCertificate& proof) {
  ByteWriter raw;
  raw.words(proof.version);
  raw.words(proof.problem);
  raw.words(proof.measure);
  raw.whole(proof.wrench == Wrench::kAny ? 1 : 0, 1);
  raw.whole((proof.collision ? 1 : 0) + (proof.without_yaw_joint ? 2 : 0), 1);
  raw.whole(proof.digest, 8);
  for (const double x : {proof.bound, proof.gap, proof.value}) raw.real(x);
  for (const Eigen::VectorXd& v :
       {proof.x, proof.u, Eigen::VectorXd(proof.h), proof.lower, proof.upper}) {
    raw.matrix(v);
  }
  if (proof.tree.of_list) {
    raw.matrix(Eigen::Map<const Eigen::VectorXd>(proof.decides.data(),
                                                 static_cast<Eigen::Index>(proof.decides.size())));
  }
  put_tree(raw, proof.tree);
  return seal(proof.tree.of_list ? kListMagic : kMagic, raw.text());
}

ProofCertificate read_certificate(const std::string& file) {
  ProofCertificate proof;
  proof.tree.of_list = begins_with(file, kListMagic);
  const std::string raw = unseal(file, proof.tree.of_list ? kListMagic : kMagic);
  ByteReader from(raw);
  proof.version = from.words();
  proof.problem = from.words();
  proof.measure = from.words();
  proof.wrench = from.whole(1) == 1 ? Wrench::kAny : Wrench::kPure;
  const std::uint64_t how = from.whole(1);
  if (how > 3) throw std::invalid_argument(file + ": its claim is of an unknown kind");
  proof.collision = (how & 1) != 0;
  proof.without_yaw_joint = (how & 2) != 0;
  proof.digest = from.whole(8);
  for (double* x : {&proof.bound, &proof.gap, &proof.value}) *x = from.real();
  proof.x = from.vector();
  proof.u = from.vector();
  const Eigen::VectorXd h = from.vector();
  proof.lower = from.vector();
  proof.upper = from.vector();
  if (proof.tree.of_list) {
    const Eigen::VectorXd decides = from.vector();
    proof.decides.assign(decides.begin(), decides.end());
  }
  const bool plain = fits_in_a_line(proof.version) && fits_in_a_line(proof.problem) &&
                     fits_in_a_line(proof.measure);
  if (!plain || h.size() != 6 || !take_tree(from, proof.tree) || !from.at_end()) {
    throw std::invalid_argument(file + ": got a damaged file, expected a whole certificate");
  }
  proof.h = h;
  return proof;
}

}  // namespace maxwrench
