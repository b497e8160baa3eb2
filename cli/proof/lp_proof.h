#pragma once

#include <string>

#include "maxwrench/mps.h"
#include "verify/lp_proof.h"

namespace maxwrench {

/// A file of one JSON object: the MPS file, verdict, the objective in the file's sense, and what
/// proves the verdict, in the order of the columns and rows of `MpsProgram::program`. Numbers are
/// fractions "p/q".
std::string lp_proof_text(const std::string& mps_file, const MpsProgram& mps, const LpProof& proof);

/// Whether a file is no certificate of another kind; throws if it cannot be read.
bool is_lp_proof(const std::string& file);

/// What was checked of such a file.
struct LpVerification {
  std::string mps_file, rejection;  ///< empty: verified
  Status status = Status::kNumericalError;
  std::string objective;  ///< as claimed; empty without an optimum
};

/// `mps_file`: what it is to be about; empty: what it says. Throws std::invalid_argument, in one
/// line, for a file that is none or damaged.
LpVerification verify_lp(const std::string& file, const std::string& mps_file);

}  // namespace maxwrench
