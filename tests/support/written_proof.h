#pragma once

#include <string>

#include "maxwrench/problem.h"
#include "verify/certificate.h"

namespace maxwrench {

/// A shipped problem and what `certify` writes of it.
struct WrittenProof {
  Problem problem;
  ProofCertificate proof;

  WrittenProof(const char* name, const char* measure, Wrench wrench, double gap,
               long boxes = 1000000);
  WrittenProof(const WrittenProof&) = delete;

  /// Why `verify` does not accept a certificate of the problem; empty if it does.
  std::string rejection(const ProofCertificate& of) const;
};

}  // namespace maxwrench
