#pragma once

#include "maxwrench/solve.h"
#include "solvers/certify/certify.h"
#include "verify/certificate.h"

namespace maxwrench {

/// Keeps the boxes of a run of branch and bound, for its certificate.
class ProofRecorder {
 public:
  /// For `CertifyOptions::sink`.
  void add(const CertifiedBox& box);

  /// What was proven of the posture of an answer, which has a value. `gap`: what was asked for.
  ProofCertificate certificate(const Answer& answer, const CertifyResult& result, double gap) const;

 private:
  /// What was cut off a box: a leaf, and where.
  struct Slice {
    CertificateTree::Node leaf;
    int axis = -1;  ///< -1: all that was left
    bool upper = false;
    double at = 0;
  };
  struct Box {
    std::vector<Slice> slices;
    CertificateTree::Node node;  ///< of the rest
    std::size_t lower_half = 0;  ///< if it is cut; the upper one is next to it
  };
  /// A part of a tree that is still to be written: a slice, or what is left after the first ones.
  struct Part {
    std::size_t box = 0, slices = 0;
    bool is_slice = false;
  };

  Box& box(std::size_t id);
  std::size_t keep(const Eigen::VectorXd& multiplier);
  CertificateTree tree() const;
  void write(const Part& part, std::vector<Part>& open, CertificateTree& tree) const;
  void write(const CertificateTree::Node& node, CertificateTree& tree) const;

  std::vector<Box> boxes_;  ///< by `CertifiedBox::id`
  std::vector<double> multipliers_;
  int width_ = 0, equations_ = 0;
  Eigen::VectorXd lower_, upper_;  ///< of the root
};

}  // namespace maxwrench
