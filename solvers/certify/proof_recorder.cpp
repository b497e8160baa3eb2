#include "solvers/certify/proof_recorder.h"

#include <cmath>

#include "lib/math/rotated.h"
#include "maxwrench/version.h"
#include "solvers/certify/bound/loop_posture.h"
#include "solvers/certify/box_coordinates.h"
#include "verify/equations.h"
#include "verify/model.h"

namespace maxwrench {

namespace {

using Node = CertificateTree::Node;

/// The scenario that decides at the posture of an answer.
std::vector<double> decides_of(const Problem& problem, const Answer& answer) {
  const ScenarioList& list = problem.scenarios;
  const ScenarioChoice& choice = answer.capability.decides;
  std::vector<double> numbers = {static_cast<double>(choice.wrench),
                                 static_cast<double>(choice.limits)};
  numbers.insert(numbers.end(), choice.cases.begin(), choice.cases.end());
  if (!list.ball) return numbers;
  const ScenarioWrench& wrench = list.wrenches[static_cast<std::size_t>(choice.wrench)];
  Eigen::VectorXd z = Eigen::VectorXd::Zero(list.ball->E.cols());
  if (!wrench.hold) {
    const Vector6d c = rotated(Eigen::Matrix3d(answer.posture.turn.transpose()), choice.c);
    z = list.ball->E.transpose() * (c - wrench.c) / list.ball->radius;
  }
  numbers.insert(numbers.end(), z.begin(), z.end());
  return numbers;
}

/// The coordinates of a posture, with the shares of the forces of its second contact as
/// `make_capability_bound` has them.
Eigen::VectorXd coordinates_of(const Problem& problem, const Answer& answer) {
  Eigen::VectorXd x = BoxCoordinates(problem).of(answer.posture);
  const bool determined =
      answer.choice.measure == "linf_polytope" && base_determines_forces(problem);
  const Eigen::Index l = problem.contact_columns();
  if (l == 0 || determined || !problem.scenarios.empty()) return x;
  const LoopCoordinates limits(problem);
  const double t = answer.capability.beta;
  const Eigen::ArrayXd low = limits.w_min + t * limits.v_min;
  const Eigen::ArrayXd range = (limits.w_max + t * limits.v_max).array() - low;
  const Eigen::ArrayXd above = answer.capability.w.tail(l).array() - low;
  x.conservativeResize(x.size() + l);
  x.tail(l) = (range > 0).select(above / range, 0).cwiseMax(0).cwiseMin(1);
  return x;
}

}  // namespace

ProofRecorder::Box& ProofRecorder::box(std::size_t id) {
  if (boxes_.size() <= id) boxes_.resize(id + 1);
  return boxes_[id];
}

std::size_t ProofRecorder::keep(const Eigen::VectorXd& multiplier) {
  multipliers_.insert(multipliers_.end(), multiplier.begin(), multiplier.end());
  return multipliers_.size() - static_cast<std::size_t>(multiplier.size());
}

void ProofRecorder::add(const CertifiedBox& given) {
  const auto id = static_cast<std::size_t>(given.id);
  Box& own = box(id);
  for (const BoxCut& cut : given.cuts) {
    equations_ = static_cast<int>(cut.multiplier.size());
    Slice slice{{}, cut.axis, cut.upper, cut.at};
    slice.leaf.reason = CertificateTree::Reason::kNoPosture;
    slice.leaf.multiplier = keep(cut.multiplier);
    own.slices.push_back(slice);
  }
  own.node.axis = given.cut_axis;
  if (given.proof.kind == BoxProof::Kind::kCollision) {
    own.node.reason = CertificateTree::Reason::kCollision;
    own.node.pair = given.proof.pair;
  } else if (given.proof.kind == BoxProof::Kind::kMultiplier) {
    own.node.reason = CertificateTree::Reason::kMultiplier;
    own.node.multiplier = keep(given.proof.multiplier);
    own.node.parts = static_cast<std::size_t>(given.proof.multiplier.size());
    width_ = static_cast<int>(given.proof.multiplier.size());
  }
  if (given.parent >= 0) {  // the ids of two halves differ by one; that of the lower half is odd
    box(static_cast<std::size_t>(given.parent)).lower_half = id % 2 == 1 ? id : id - 1;
    return;
  }
  lower_ = given.lower;
  upper_ = given.upper;
  for (auto cut = given.cuts.rbegin(); cut != given.cuts.rend(); ++cut) {
    if (cut->axis >= 0) (cut->upper ? upper_ : lower_)[cut->axis] = cut->end;
  }
}

void ProofRecorder::write(const Node& node, CertificateTree& tree) const {
  tree.nodes.push_back(node);
  const auto from = multipliers_.begin() + static_cast<std::ptrdiff_t>(node.multiplier);
  Node& last = tree.nodes.back();
  last.multiplier = tree.multipliers.size();
  if (tree.of_list && last.reason == CertificateTree::Reason::kMultiplier) {
    last.parts =
        (node.parts - static_cast<std::size_t>(tree.shared)) / static_cast<std::size_t>(tree.width);
  } else {
    last.parts = 1;
  }
  tree.multipliers.insert(tree.multipliers.end(), from,
                          from + static_cast<std::ptrdiff_t>(tree.numbers(last)));
}

void ProofRecorder::write(const Part& part, std::vector<Part>& open, CertificateTree& tree) const {
  const Box& of = boxes_[part.box];
  if (part.slices == of.slices.size()) {
    write(of.node, tree);
    if (of.node.axis < 0) return;
    open.push_back({of.lower_half + 1});
    open.push_back({of.lower_half});
    return;
  }
  const Slice& slice = of.slices[part.slices];
  if (part.is_slice || slice.axis < 0) {
    write(slice.leaf, tree);
    return;
  }
  Node cut;
  cut.axis = slice.axis;
  cut.at = slice.at;
  write(cut, tree);
  Part upper{part.box, part.slices, true}, lower{part.box, part.slices + 1};
  if (!slice.upper) std::swap(upper, lower);
  open.push_back(upper);
  open.push_back(lower);
}

CertificateTree ProofRecorder::tree(const Problem& problem) const {
  CertificateTree tree;
  tree.width = width_;
  tree.equations = equations_;
  if (const ScenarioList& list = problem.scenarios; !list.empty()) {
    tree.of_list = true;
    tree.width = static_cast<int>(2 + list.loads.size()) + problem.robot.velocities();
    if (list.ball) tree.width += static_cast<int>(list.ball->E.cols());
    const FormModel model(problem);
    tree.shared = Equations(problem, model).count();
  }
  std::vector<Part> open = {{}};
  while (!open.empty()) {
    const Part part = open.back();
    open.pop_back();
    write(part, open, tree);
  }
  return tree;
}

ProofCertificate claim_of(const Answer& answer) {
  const Problem& problem = *answer.task;
  ProofCertificate proof;
  proof.version = version();
  proof.problem = answer.choice.problem;
  proof.measure = answer.choice.measure;
  proof.wrench = answer.choice.wrench;
  proof.collision = problem.robot.collision != nullptr;
  proof.digest = digest(problem);
  proof.x = coordinates_of(problem, answer);
  proof.value = answer.capability.beta;
  proof.u = answer.capability.u;
  proof.h = answer.capability.h;
  proof.tree.of_list = !problem.scenarios.empty();
  if (proof.tree.of_list) proof.decides = decides_of(problem, answer);
  return proof;
}

ProofCertificate ProofRecorder::certificate(const Answer& answer, double bound, double gap) const {
  ProofCertificate proof = claim_of(answer);
  proof.bound = bound;
  proof.gap = std::max(gap, (proof.bound - proof.value) / std::abs(proof.value));
  proof.without_yaw_joint =
      left_out_coordinate(*answer.task, proof.measure, proof.wrench).has_value();
  proof.lower = lower_;
  proof.upper = upper_;
  proof.tree = tree(*answer.task);
  return proof;
}

}  // namespace maxwrench
