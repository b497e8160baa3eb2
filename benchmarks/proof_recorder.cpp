#include "benchmarks/proof_recorder.h"

#include <cmath>

#include "maxwrench/version.h"

namespace maxwrench {

void ProofRecorder::add(const CertifiedBox& box) {
  using enum CertificateTree::Reason;
  const auto id = static_cast<std::size_t>(box.id);
  if (nodes_.size() <= id) {
    nodes_.resize(id + 1);
    lower_half_.resize(id + 1);
  }
  CertificateTree::Node& node = nodes_[id];
  node.axis = box.cut_axis;
  if (box.proof.kind == BoxProof::Kind::kCollision) {
    node.reason = kCollision;
    node.pair = box.proof.pair;
  } else if (box.proof.kind == BoxProof::Kind::kMultiplier) {
    node.reason = kMultiplier;
    node.multiplier = multipliers_.size();
    width_ = static_cast<std::size_t>(box.proof.multiplier.size());
    for (const double x : box.proof.multiplier) multipliers_.push_back(x);
  }
  if (box.parent < 0) {
    lower_ = box.lower;
    upper_ = box.upper;
  } else {  // ids of halves are one apart, the lower one's is odd
    const auto parent = static_cast<std::size_t>(box.parent);
    if (lower_half_.size() <= parent) lower_half_.resize(parent + 1);
    lower_half_[parent] = id % 2 == 1 ? id : id - 1;
  }
}

CertificateTree ProofRecorder::tree() const {
  CertificateTree tree;
  tree.width = static_cast<int>(width_);
  std::vector<std::size_t> open = {0};
  while (!open.empty()) {
    const std::size_t id = open.back();
    open.pop_back();
    tree.nodes.push_back(nodes_[id]);
    if (nodes_[id].reason == CertificateTree::Reason::kMultiplier) {
      const auto from = multipliers_.begin() + static_cast<std::ptrdiff_t>(nodes_[id].multiplier);
      tree.nodes.back().multiplier = tree.multipliers.size();
      tree.multipliers.insert(tree.multipliers.end(), from,
                              from + static_cast<std::ptrdiff_t>(width_));
    }
    if (nodes_[id].axis < 0) continue;
    open.push_back(lower_half_[id] + 1);
    open.push_back(lower_half_[id]);
  }
  return tree;
}

ProofCertificate ProofRecorder::certificate(const Problem& problem, const Row& row,
                                            const CertifyResult& result, double gap) const {
  ProofCertificate proof;
  proof.version = version();
  proof.problem = row.choice.problem;
  proof.measure = row.choice.measure;
  proof.wrench = row.choice.wrench;
  proof.collision = problem.robot.collision != nullptr;
  proof.digest = digest(problem);
  proof.bound = result.bound;
  proof.theta_r = row.posture.theta_r;
  proof.value = row.capability.beta;
  proof.gap = std::max(gap, (proof.bound - proof.value) / std::abs(proof.value));
  proof.u = row.capability.u;
  proof.h = row.capability.h;
  proof.lower = lower_;
  proof.upper = upper_;
  proof.tree = tree();
  return proof;
}

}  // namespace maxwrench
