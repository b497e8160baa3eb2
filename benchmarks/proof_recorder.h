#pragma once

#include "benchmarks/row.h"
#include "solvers/certify/certify.h"
#include "verify/certificate.h"

namespace maxwrench {

/// Keeps the boxes of a run of branch and bound, for its certificate.
class ProofRecorder {
 public:
  /// For `CertifyOptions::sink`.
  void add(const CertifiedBox& box);

  /// What was proven of the posture of a row, which has a value. `gap`: what was asked for.
  ProofCertificate certificate(const Problem& problem, const Row& row, const CertifyResult& result,
                               double gap) const;

 private:
  CertificateTree tree() const;

  std::vector<CertificateTree::Node> nodes_;  ///< by `CertifiedBox::id`
  std::vector<std::size_t> lower_half_;  ///< of a node that is cut; the upper one is next to it
  std::vector<double> multipliers_;
  std::size_t width_ = 0;
  Eigen::VectorXd lower_, upper_;  ///< of the root
};

}  // namespace maxwrench
