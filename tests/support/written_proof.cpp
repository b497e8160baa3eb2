#include "tests/support/written_proof.h"

#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "solvers/certify/proof.h"
#include "solvers/certify/proof_recorder.h"
#include "solvers/solve/method.h"
#include "tests/support/support.h"
#include "verify/verify.h"

namespace maxwrench {

WrittenProof::WrittenProof(const char* name, const char* measure, Wrench wrench, double gap,
                           long boxes)
    : WrittenProof(load_problem(name), name, measure, wrench, gap, boxes) {}

WrittenProof::WrittenProof(Problem of, const char* name, const char* measure, Wrench wrench,
                           double gap, long boxes)
    : problem(std::move(of)) {
  Case c;
  c.problem = name;
  c.measure = measure;
  c.wrench = wrench;
  c.search = default_search(problem, measure);
  c.budget = 2000;
  const Method method = resolve(problem, c);
  Answer row = solve(problem, {method.choice, 1});
  ProofRecorder recorder;
  CertifyOptions options;
  options.gap = gap;
  options.boxes = boxes;
  options.sink = [&](const CertifiedBox& box) { recorder.add(box); };
  const auto bound = make_capability_bound(problem, measure, wrench);
  const CertifyResult result =
      prove(problem, method, *bound, {row.posture.theta_r, row.capability.beta}, options);
  if (result.best.value > row.capability.beta) {
    row = evaluate(problem, result.best.theta_r, {method.choice});
  }
  proof = recorder.certificate(row, result.bound, gap);
}

std::string WrittenProof::rejection(const ProofCertificate& of) const {
  return verify(problem, of, 1).rejection;
}

}  // namespace maxwrench
