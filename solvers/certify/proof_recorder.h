#pragma once

#include "maxwrench/solve.h"
#include "solvers/certify/certify.h"
#include "verify/certificate.h"

namespace maxwrench {

/// The claim of an answer whose posture has a value, without a bound and boxes.
ProofCertificate claim_of(const Answer& answer);

/// Records the boxes of a run of branch and bound, for its certificate.
class ProofRecorder {
 public:
  /// For `CertifyOptions::sink`.
  void add(const CertifiedBox& box);

  /// The certificate of an answer whose posture has a value. No value exceeds `bound`, and `gap` is
  /// the requested gap.
  ProofCertificate certificate(const Answer& answer, double bound, double gap) const;

 private:
  /// A slice cut off a box: a leaf, and where it was cut.
  struct Slice {
    CertificateTree::Node leaf;
    int axis = -1;  ///< -1: the whole remaining box
    bool upper = false;
    double at = 0;
  };
  struct Box {
    std::vector<Slice> slices;
    CertificateTree::Node node;  ///< of the rest; `parts` is the number of entries
    std::size_t lower_half = 0;  ///< if the box is cut; the upper half has the next id
  };
  /// A part of a tree that is still to be written: a slice, or the rest of a box after its first
  /// slices.
  struct Part {
    std::size_t box = 0, slices = 0;
    bool is_slice = false;
  };

  Box& box(std::size_t id);
  std::size_t keep(const Eigen::VectorXd& multiplier);
  CertificateTree tree(const Problem& problem) const;
  void write(const Part& part, std::vector<Part>& open, CertificateTree& tree) const;
  void write(const CertificateTree::Node& node, CertificateTree& tree) const;

  std::vector<Box> boxes_;  ///< by `CertifiedBox::id`
  std::vector<double> multipliers_;
  int width_ = 0, equations_ = 0;
  Eigen::VectorXd lower_, upper_;  ///< of the root
};

}  // namespace maxwrench
