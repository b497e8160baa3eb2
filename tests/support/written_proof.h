#pragma once

#include <string>

#include "maxwrench/problem.h"
#include "verify/certificate.h"

namespace maxwrench {

/// A shipped problem and the certificate that `certify` writes for it.
struct WrittenProof {
  Problem problem;
  ProofCertificate proof;

  WrittenProof(const char* name, const char* measure, Wrench wrench, double gap,
               long boxes = 1000000);
  WrittenProof(Problem of, const char* name, const char* measure, Wrench wrench, double gap,
               long boxes = 1000000);
  WrittenProof(const WrittenProof&) = delete;

  /// Why `verify` rejects a certificate of the problem; empty if it accepts it.
  std::string rejection(const ProofCertificate& of) const;
};

}  // namespace maxwrench
