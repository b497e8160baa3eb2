#include "solvers/search/slp_outcome.h"

#include <cmath>
#include <iterator>

#include "solvers/search/slp_run.h"

namespace maxwrench {

const long kJudged = KnotClimber::kJudgement + std::size(kRetreats) * (1 + KnotClimber::kJudgement);

bool SlpOutcome::improves(double its_worth, double its_value, double margin) const {
  const bool nothing = worth == -kInfinity && its_worth == -kInfinity;
  const double mine = nothing ? plan.value : worth;
  const double other = nothing ? its_value : its_worth;
  return mine == -kInfinity ? other > mine : other > mine + margin * (1 + std::abs(mine));
}

void judge(KnotClimber& climber, SearchRun& run, SlpOutcome& outcome) {
  const long before = climber.found().trace.evaluations();
  Candidate plan = climber.best();
  double worth = climber.worth(plan);
  if (worth == -kInfinity && outcome.worth > -kInfinity) {
    const Eigen::VectorXd base = outcome.plan.theta_r, way = plan.theta_r - base;
    for (const double share : kRetreats) {
      const Candidate between = climber.look(base + share * way);
      if (!(between.value > outcome.worth)) continue;
      worth = climber.worth(between);
      plan = between;
      if (worth > outcome.worth) break;
    }
  }
  run.add(climber.found().trace.evaluations() - before);
  if (!outcome.improves(worth, plan.value, 0)) return;
  outcome.worth = worth;
  outcome.plan = plan;
}

}  // namespace maxwrench
