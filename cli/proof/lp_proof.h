#pragma once

#include <string>

#include "maxwrench/mps.h"
#include "verify/lp_proof.h"

namespace maxwrench {

/// A file with one JSON object: the MPS file, the verdict, the objective in the file's sense, and
/// the proof of the verdict, in the order of the columns and rows of `MpsProgram::program`. Numbers
/// are fractions "p/q".
std::string lp_proof_text(const std::string& mps_file, const MpsProgram& mps, const LpProof& proof);

/// Whether a file is a certificate of a linear program and not of another kind; throws if it cannot
/// be read.
bool is_lp_proof(const std::string& file);

/// The result of the check of such a file.
struct LpVerification {
  std::string mps_file, rejection;  ///< rejection: empty if verified
  Status status = Status::kNumericalError;
  std::string objective;  ///< as claimed; empty if there is no optimum
};

/// `mps_file` is the program of the certificate; if empty, the certificate names it. Throws
/// std::invalid_argument, with one line, if the file is not a certificate or is damaged.
LpVerification verify_lp(const std::string& file, const std::string& mps_file);

}  // namespace maxwrench
