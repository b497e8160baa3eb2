#include "solvers/search/slp_outcome.h"

#include <cmath>
#include <iterator>

#include "solvers/search/slp_run.h"

namespace maxwrench {

const long kJudged = SlpRun::kJudgement + std::size(kRetreats) * (1 + SlpRun::kJudgement);

bool SlpOutcome::improves(double its_worth, double its_value, double margin) const {
  const bool nothing = worth == -kInfinity && its_worth == -kInfinity;
  const double mine = nothing ? trajectory.value : worth;
  const double other = nothing ? its_value : its_worth;
  return mine == -kInfinity ? other > mine : other > mine + margin * (1 + std::abs(mine));
}

void judge(SlpRun& slp_run, SearchRun& run, SlpOutcome& outcome) {
  const long before = slp_run.found().trace.evaluations();
  Candidate trajectory = slp_run.best();
  double worth = slp_run.worth(trajectory);
  if (worth == -kInfinity && outcome.worth > -kInfinity) {
    const Eigen::VectorXd base = outcome.trajectory.theta_r, way = trajectory.theta_r - base;
    for (const double share : kRetreats) {
      const Candidate between = slp_run.look(base + share * way);
      if (!(between.value > outcome.worth)) continue;
      worth = slp_run.worth(between);
      trajectory = between;
      if (worth > outcome.worth) break;
    }
  }
  run.add(slp_run.found().trace.evaluations() - before);
  if (!outcome.improves(worth, trajectory.value, 0)) return;
  outcome.worth = worth;
  outcome.trajectory = trajectory;
}

}  // namespace maxwrench
