#pragma once

#include "cli/proof/good_postures.h"
#include "maxwrench/certify.h"
#include "maxwrench/solve.h"

namespace maxwrench {

class ProofRecorder;

/// `certify`, with its progress on stderr.
///
/// @param recorder  receives the boxes, unless it is null
Proof prove_with_progress(const Problem& problem, Options how, ProofOptions proof,
                          ProofRecorder* recorder);

/// Lists the good postures after a proof that found a value, in the time that the proof left.
///
/// @param options  share and resolution of the list
/// @param how      as for the proof
/// @param seconds  the time of both
/// @param proof    a better posture that is found becomes its answer
GoodPostures list_with_progress(const Problem& problem, const WithinOptions& options,
                                const Options& how, double seconds, Proof& proof);

}  // namespace maxwrench
