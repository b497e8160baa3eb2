#include "benchmarks/tables/dictionary.h"

#include <algorithm>

namespace maxwrench {
namespace {

constexpr ColumnMeaning kDictionary[] = {
    // the case
    {"problem", "", "name of a shipped task, or the path of a task file"},
    {"measure", "", "capability measure"},
    {"wrench", "", "pure: along c only; any: other components are free"},
    {"solver", "", "lower-level solver; none: the measure is a closed form"},
    {"search", "", "search that chose the posture or trajectory; stages are joined by +"},
    {"seed", "", "seed of the random numbers"},
    {"budget", "", "evaluation budget of the search"},
    {"scheme", "", "scheme that turns knots into motion; empty: a static task"},
    {"integrator", "",
     "integrator of the experiment with the default posture or trajectory; empty: no experiment"},
    // values.csv
    {"status", "",
     "best_found; optimal for a given posture; reached for an experiment; or why there is no "
     "value"},
    {"beta", "unit", "largest value found, or the reading of an experiment; empty: none"},
    {"value_between_knots", "unit", "value of a trajectory that also holds between its instants"},
    {"unit", "", "unit of beta"},
    {"beta_linf", "beta_linf_unit",
     "value of linf_polytope at the same posture with the same wrenches, or the planned value of "
     "an experiment"},
    {"beta_linf_unit", "", "unit of beta_linf"},
    {"label", "", "identified: the model's numbers are not public data"},
    {"theta_r", "rad, m", "coordinates of the posture, or those of a trajectory knot by knot"},
    {"h", "N, N m", "force and torque that the robot exerts, in world axes"},
    {"u", "N, N m", "efforts of the actuators"},
    {"lambda", "unit/N, unit/(N m)", "multipliers of the balance, d beta/d tau_d"},
    {"balance", "N, N m", "largest violation of the balance of forces, recomputed"},
    {"bounds", "N, N m", "largest violation of a limit of u or w, recomputed"},
    {"dual", "", "largest violation of a dual constraint, recomputed"},
    {"gap", "unit", "difference of the primal and dual value, recomputed"},
    {"evaluations", "", "evaluations spent; for an experiment, those of its derivatives"},
    {"reason", "", "why there is no value, or a remark"},
    {"calls", "",
     "how local methods ended: name, end (for slp, the solver of the step), calls, evaluations"},
    {"task_digest", "",
     "digest of the bytes of the files of task, robot, URDF and path: FNV-1a, 64 bits"},
    // times.csv
    {"wall_s", "s", "wall time of the case"},
    {"us_per_evaluation", "us", "wall time of an evaluation"},
    {"cpu_s", "s", "processor time of the case"},
    {"threads", "", "number of threads"},
    {"machine", "", "processor"},
    {"build", "", "build type, compiler, libraries"},
    {"sources", "", "identifier of the sources that the values depend on"},
    {"version", "", "release and commit"},
    // search_comparison.csv and search_times.csv
    {"best_known", "unit",
     "reference of the targets: the proven bound, else the best value of all runs"},
    {"proven", "", "yes: best_known is a proven bound"},
    {"role", "", "default: the search of solve; contender; peer: through a third-party solver"},
    {"below", "", "shortfall of beta below the proven bound or the best value, as a share of it"},
    {"evaluations_to_tenth", "", "evaluations until 10 % below best_known; empty: never"},
    {"evaluations_to_hundredth", "", "evaluations until 1 % below"},
    {"evaluations_to_thousandth", "", "evaluations until 0.1 % below"},
    {"evaluations_to_ten_thousandth", "", "evaluations until 0.01 % below"},
    {"seconds_to_tenth", "s", "processor time until 10 % below best_known; empty: never"},
    {"seconds_to_hundredth", "s", "processor time until 1 % below"},
    {"seconds_to_thousandth", "s", "processor time until 0.1 % below"},
    {"seconds_to_ten_thousandth", "s", "processor time until 0.01 % below"},
    {"seconds", "s", "processor time of the whole run"},
    // tables of report
    {"rows", "", "number of rows that the line summarises"},
    {"solved", "", "number of these rows or instances with a value, or that reached 0.1 %"},
    {"best", "unit", "largest beta of the solved rows"},
    {"near", "", "rows within 0.1 % of the best of their task"},
    {"median_below", "", "median of below; failures count as infinite, then empty"},
    {"us", "us",
     "median processor time of an evaluation; in a benchmark set failures are infinite"},
    {"us_low", "us", "lower end of its bootstrap interval of 95 %; empty: fewer than 6 rows"},
    {"us_high", "us", "upper end"},
    {"coordinates", "", "d: number of searched coordinates theta_r, of all knots"},
    {"instants", "", "k: number of knots of a task in time; 1: static"},
    {"actuators", "", "number of efforts u"},
    {"columns", "", "number of unknowns w: free wrench components and forces of a second contact"},
    {"benchmark_set", "", "which instances are compared"},
    {"instances", "", "of the benchmark set"},
    {"share_best", "", "rho(1): share of instances on which it was the cheapest"},
    {"share_double", "", "rho(2): share on which it took at most twice the cheapest"},
    {"experiment_ms", "ms",
     "processor time of an experiment in the virtual tank; of an integrator the median"},
    {"planned", "unit", "value of the posture or trajectory along c; the tank requests 0.5 % less"},
    {"reading", "unit",
     "load cell along c: mean of the hold, least along a path, or at t_h of an impulse"},
    {"median_ms", "ms", "median processor time to 0.1 % below; empty: half never reached it"},
    {"reference", "", "the method that the others are compared with"},
    {"times", "", "cost as a multiple of the reference's: median over rows or instances"},
    {"times_low", "", "lower end of its bootstrap interval of 95 %; empty: fewer than 6"},
    {"times_high", "", "upper end; empty: infinite, or fewer than 6"},
    {"p", "", "Wilcoxon's signed rank test of times, two-sided, corrected by Holm"},
    {"group", "", "group of races"},
    {"supported", "", "number of tasks in the group that the search supports"},
    {"typical", "", "expected time as a multiple of the fastest search's: median over tasks"},
    {"worst", "", "the largest of these"},
    {"reached_tenth", "",
     "share of runs that came within 10 %; an unsupported task counts as missed"},
    {"reached_hundredth", "", "the same within 1 %"},
    {"reached_thousandth", "", "the same within 0.1 %"},
    {"reached_ten_thousandth", "", "the same within 0.01 %"},
    {"runs", "", "number of seeds of a search on a task"},
    {"ert_ms_tenth", "ms", "expected running time to 10 % below (COCO); empty: never"},
    {"ert_ms_hundredth", "ms", "the same to 1 %"},
    {"ert_ms_thousandth", "ms", "the same to 0.1 %"},
    {"ert_ms_ten_thousandth", "ms", "the same to 0.01 %"},
    {"ert_evaluations_tenth", "", "expected evaluations to 10 % below (COCO); empty: never"},
    {"ert_evaluations_hundredth", "", "the same to 1 %"},
    {"ert_evaluations_thousandth", "", "the same to 0.1 %"},
    {"ert_evaluations_ten_thousandth", "", "the same to 0.01 %"},
    // tables of report --compare
    {"folder", "", "a or b: the folder that has the row"},
    {"status_a", "", "status in the first folder"},
    {"status_b", "", "status in the second folder"},
    {"beta_a", "unit", "beta in the first folder"},
    {"beta_b", "unit", "beta in the second folder"},
    {"reason_a", "", "reason in the first folder"},
    {"reason_b", "", "reason in the second folder"},
    {"what", "", "column in which the rows of a line agree"},
    {"name", "", "value of that column"},
    {"change", "",
     "slower or faster if the whole interval is 5 % or more from 1 and p < 0.05; else empty"},
    // dictionary.csv
    {"column", "", "name of a column"},
    {"meaning", "", "meaning of the column"},
};

}  // namespace

std::span<const ColumnMeaning> dictionary() { return kDictionary; }

const ColumnMeaning* find_meaning(const std::string& column) {
  const auto found =
      std::find_if(std::begin(kDictionary), std::end(kDictionary),
                   [&](const ColumnMeaning& entry) { return entry.column == column; });
  return found == std::end(kDictionary) ? nullptr : found;
}

}  // namespace maxwrench
