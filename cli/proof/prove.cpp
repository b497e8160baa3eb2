#include "cli/proof/prove.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "cli/progress.h"
#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/proof.h"
#include "solvers/solve/format.h"
#include "solvers/solve/method.h"

namespace maxwrench {

Proof prove_with_progress(const Problem& problem, Options how, ProofOptions proof,
                          ProofRecorder* recorder) {
  Progress search("search", kUsualBudget);
  how.progress = search.counter();
  std::optional<ProgressLine> line;
  proof.progress = [&](double most, double beta) {
    search.finish();
    if (!line) line.emplace();
    line->show("certify gap " + percent((most - beta) / std::abs(beta)));
  };
  return certify(problem, how, proof, recorder);
}

GoodPostures list_with_progress(const Problem& problem, const WithinOptions& options,
                                const Options& how, double seconds, Proof& proof) {
  ProgressLine line;
  GoodOptions good;
  good.within = options.share();
  good.resolution = options.resolution;
  good.seconds = std::max(0.0, seconds - proof.seconds);
  good.threads = thread_count(how.threads);
  good.interrupted = how.interrupted;
  good.progress = [&line](std::size_t waiting, std::size_t kept) {
    line.show(fmt::format("within {} boxes kept, {} open", kept, waiting));
  };
  const auto bound = make_bound_of_all_coordinates(problem, how.measure, how.wrench);
  return verified_good_postures(problem, resolve(problem, how), *bound, proof.bound, good,
                                proof.answer);
}

}  // namespace maxwrench
