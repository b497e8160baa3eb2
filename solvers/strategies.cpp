#include "maxwrench/strategies.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <vector>

#include "maxwrench/problem.h"
#include "maxwrench/solve.h"
#include "solvers/integrator/makers.h"
#include "solvers/lp/makers.h"
#include "solvers/search/makers.h"
#include "solvers/trajectory/makers.h"
#include "solvers/wrench/makers.h"

namespace maxwrench {
namespace {

/// `make` for a measure that needs a robot or a problem, but no solver.
template <std::unique_ptr<Measure> (*make)(const Robot&)>
std::unique_ptr<Measure> of_robot(const Problem& problem, std::unique_ptr<WrenchSolver> /*none*/) {
  return make(problem.robot);
}
template <std::unique_ptr<Measure> (*make)(const Problem&)>
std::unique_ptr<Measure> of_problem(const Problem& problem,
                                    std::unique_ptr<WrenchSolver> /*none*/) {
  return make(problem);
}
/// `make` for a measure that solves a program.
template <std::unique_ptr<Measure> (*make)(const Robot&, std::unique_ptr<WrenchSolver>)>
std::unique_ptr<Measure> of_program(const Problem& problem, std::unique_ptr<WrenchSolver> solver) {
  return make(problem.robot, std::move(solver));
}

const LpEntry kLpSolvers[] = {
    {"simplex", "built-in bounded-variable simplex, warm-started", 1,
     [] { return make_simplex(); }},
#if MAXWRENCH_WITH_CLP
    {"clp", "Clp (COIN-OR), simplex", 2, make_clp},
#endif
#if MAXWRENCH_WITH_GLPK
    {"glpk", "GLPK, dual simplex", 2, make_glpk},
#endif
#if MAXWRENCH_WITH_IPOPT
    {"ipopt", "Ipopt, interior point", 20, make_ipopt},
#endif
};

const IntegratorEntry kIntegrators[] = {
#if MAXWRENCH_WITH_SUNDIALS
    {"cvode", "CVODE (SUNDIALS), backward differentiation formulas", true, make_cvode},
    {"cvode_adams", "CVODE (SUNDIALS), Adams-Moulton formulas", false, make_cvode_adams},
    {"arkode", "ARKODE (SUNDIALS), explicit Runge-Kutta method of order 5", false, make_arkode},
    {"ida", "IDA (SUNDIALS), on the residual form", true, make_ida},
#endif
    {"runge_kutta", "built-in classical Runge-Kutta method with a fixed step", false,
     make_runge_kutta},
};

/// The entries that the conditions above may omit.
constexpr struct {
  bool built_in;
  Absent entry;
} kOptional[] = {
    {MAXWRENCH_WITH_CLP, {"solver", "clp", "Clp"}},
    {MAXWRENCH_WITH_GLPK, {"solver", "glpk", "GLPK"}},
    {MAXWRENCH_WITH_IPOPT, {"solver", "ipopt", "Ipopt"}},
    {MAXWRENCH_WITH_IPOPT, {"search", "multistart", "Ipopt"}},
    {MAXWRENCH_WITH_IPOPT, {"search", "joint_nlp", "Ipopt"}},
    {MAXWRENCH_WITH_IPOPT, {"search", "facet_nlp", "Ipopt"}},
    {MAXWRENCH_WITH_NLOPT, {"search", "facet_sqp", "NLopt"}},
    {MAXWRENCH_WITH_NLOPT, {"search", "direct_l", "NLopt"}},
    {MAXWRENCH_WITH_NLOPT, {"search", "crs2", "NLopt"}},
    {MAXWRENCH_WITH_NLOPT, {"search", "mlsl", "NLopt"}},
    {MAXWRENCH_WITH_NLOPT, {"search", "isres", "NLopt"}},
    {MAXWRENCH_WITH_NLOPT, {"search", "slsqp", "NLopt"}},
    {MAXWRENCH_WITH_NLOPT, {"search", "mma", "NLopt"}},
    {MAXWRENCH_WITH_NLOPT, {"search", "lbfgs", "NLopt"}},
    {MAXWRENCH_WITH_NLOPT, {"search", "bobyqa", "NLopt"}},
    {MAXWRENCH_WITH_NLOPT, {"search", "cobyla", "NLopt"}},
    {MAXWRENCH_WITH_PAGMO, {"search", "pagmo_cmaes", "pagmo"}},
    {MAXWRENCH_WITH_PAGMO, {"search", "de", "pagmo"}},
    {MAXWRENCH_WITH_PAGMO, {"search", "sade", "pagmo"}},
    {MAXWRENCH_WITH_SUNDIALS, {"search", "nullspace", "SUNDIALS"}},
    {MAXWRENCH_WITH_SUNDIALS, {"search", "pontryagin", "SUNDIALS"}},
    {MAXWRENCH_WITH_SUNDIALS, {"integrator", "cvode", "SUNDIALS"}},
    {MAXWRENCH_WITH_SUNDIALS, {"integrator", "cvode_adams", "SUNDIALS"}},
    {MAXWRENCH_WITH_SUNDIALS, {"integrator", "arkode", "SUNDIALS"}},
    {MAXWRENCH_WITH_SUNDIALS, {"integrator", "ida", "SUNDIALS"}},
};

std::vector<Absent> make_absent() {
  std::vector<Absent> absent;
  for (const auto& [built_in, entry] : kOptional) {
    if (!built_in) absent.push_back(entry);
  }
  return absent;
}

/// Empty if none is built in.
std::vector<SearchEntry> make_transfer_searches() {
  return {
#if MAXWRENCH_WITH_SUNDIALS
    {"pontryagin",
     "Pontryagin's maximum principle by multiple shooting (CVODES)",
     false,
     make_pontryagin,
     false,
     0,
     5,
     true},
#endif
  };
}

/// Empty if none is built in.
std::vector<SearchEntry> make_facet_searches() {
  return {
#if MAXWRENCH_WITH_NLOPT
    {"facet_sqp", "SLSQP (NLopt) in posture and wrenches, between the facets of {B u}", false,
     make_facet_sqp, true},
#endif
#if MAXWRENCH_WITH_IPOPT
        {"facet_nlp", "the same with Ipopt", false, make_facet_nlp, true, 0, 5},
#endif
  };
}

std::vector<WrenchSolverEntry> make_wrench_solvers() {
  std::vector<WrenchSolverEntry> table = {
      {"facets", "ray shooting through the facets of {B u}, one wrench column", true, true, 1,
       make_facets},
      {"condensed", "dual simplex in the wrench alone, between the facets of {B u}", false, false,
       1, make_condensed},
  };
  for (const LpEntry& lp : kLpSolvers) {
    table.push_back({lp.name, lp.summary, false, false, lp.cost,
                     [make = lp.make] { return make_assembled(make()); }});
  }
  return table;
}

std::vector<TrajectorySolverEntry> make_trajectory_solvers() {
  std::vector<TrajectorySolverEntry> table = {
      {"facets_or_ipm", "facets of the worst instant if efforts exist at all instants, else ipm",
       make_facets_or_ipm},
      {"ipm", "built-in interior point method, linear in the number of instants",
       [] { return make_trajectory_ipm(); }}};
  for (const LpEntry& lp : kLpSolvers) {
    table.push_back(
        {lp.name, lp.summary, [make = lp.make] { return make_assembled_trajectory(make()); }});
  }
  return table;
}

}  // namespace

std::span<const MeasureEntry> measures() {
  static const MeasureEntry kMeasures[] = {
      {"ellipsoid", "beta_1: weighted ellipsoid of actuator efforts, closed form", false, true,
       nullptr, of_robot<make_ellipsoid>},
      {"l2_polytope", "efforts fixed to u = B^+ (tau_d + J'h), within their limits", true, true,
       nullptr, of_program<make_l2_polytope>},
      {"linf_polytope", "beta_2, beta_3: any efforts within their limits", true, true, nullptr,
       of_program<make_linf_polytope>},
      {"manipulability", "Yoshikawa's sqrt det(J J') of base and arm, lengths in m", false, false,
       "-", of_problem<make_manipulability>},
      {"transmission_ratio", "extent of {|J'h| <= 1} along c, N and N m weighted equally", false,
       true, "-", of_robot<make_transmission_ratio>},
      {"weighted_transmission_ratio", "beta_1 without the offset by tau_d", false, true, nullptr,
       of_robot<make_weighted_transmission_ratio>},
      {"least_effort", "minus the least sum of squared efforts at the reference wrench", false,
       true, "mixed", of_problem<make_least_effort>},
      {"saturating_wrench",
       "wrench at which the first actuator saturates, efforts weighted by their limits", false,
       false, nullptr, of_robot<make_saturating_wrench>},
      {"ellipsoid_trace",
       "sum of squared radii of the weighted ellipsoid, scaled by the desired wrench", false, false,
       "-", of_problem<make_ellipsoid_trace>},
      {"dynamic_manipulability", "largest acceleration along c, weighted ellipsoid of efforts",
       false, false, nullptr, of_problem<make_dynamic_manipulability>, true},
      {"dynamic_capability", "acceleration that every direction allows within all limits", false,
       false, nullptr, of_problem<make_dynamic_capability>, true},
  };
  return kMeasures;
}
std::span<const LpEntry> lp_solvers() { return kLpSolvers; }
std::span<const WrenchSolverEntry> wrench_solvers() {
  static const std::vector<WrenchSolverEntry> kTable = make_wrench_solvers();
  return kTable;
}
std::span<const TrajectorySolverEntry> trajectory_solvers() {
  static const std::vector<TrajectorySolverEntry> kTrajectorySolvers = make_trajectory_solvers();
  return kTrajectorySolvers;
}
std::span<const SearchEntry> searches() {
  static const SearchEntry kSearches[] = {
    {"sample", "uniformly random postures, the baseline of every comparison", false, make_sample,
     false, 0.1},
    {"grid", "regular grid", false, make_grid, false, 0.9},
    {"annealing", "simulated annealing in independent chains", false, make_annealing, true},
    {"cmaes", "built-in CMA-ES (covariance matrix adaptation) from many postures", false,
     make_cmaes, true},
#if MAXWRENCH_WITH_PAGMO
    {"pagmo_cmaes", "CMA-ES (pagmo) from many postures", false, make_pagmo_cmaes, true},
    {"de", "differential evolution (pagmo), several populations", false, make_de, true},
    {"sade", "self-adaptive differential evolution (pagmo)", false, make_sade, true},
#endif
#if MAXWRENCH_WITH_IPOPT
    {"multistart", "Ipopt with exact gradients from many postures, like fmincon", false,
     make_multistart, true, 0, 5},
#endif
#if MAXWRENCH_WITH_NLOPT
    {"direct_l", "DIRECT-L (NLopt), division of boxes", false, make_direct_l},
    {"crs2", "controlled random search (NLopt), several populations", false, make_crs2, true},
    {"mlsl", "multi-level single-linkage (NLopt), with gradients", false, make_mlsl, true},
    {"isres", "evolution strategy ISRES (NLopt), several populations", false, make_isres, true},
    {"slsqp", "SLSQP (NLopt) with exact gradients from many postures", false, make_slsqp, true},
    {"mma", "MMA (NLopt) with exact gradients from many postures", false, make_mma, true},
    {"lbfgs", "L-BFGS (NLopt) with exact gradients from many postures", false, make_lbfgs, true},
    {"bobyqa", "BOBYQA (NLopt) from many postures", false, make_bobyqa, true},
    {"cobyla", "COBYLA (NLopt) from many postures", false, make_cobyla, true},
#endif
#if MAXWRENCH_WITH_SUNDIALS
    {"nullspace", "local baseline: gradient projected onto the null space of J", true,
     make_nullspace, true},
#endif
  };
  return kSearches;
}
std::span<const SearchEntry> trajectory_searches() {
  static const SearchEntry kTrajectorySearches[] = {
    {"slp", "sequential linear programming in knots, efforts and wrenches, from many starts", false,
     make_slp, true, 0, 1, true},
    {"dp", "dynamic programming over grids of control points, best for one or two coordinates",
     false, make_dp, false, 0.5, 1, true},
#if MAXWRENCH_WITH_IPOPT
    {"joint_nlp", "Ipopt in knots, efforts and wrenches together, from the starts of slp", false,
     make_joint_nlp, false, 0, 5},
#endif
  };
  return kTrajectorySearches;
}
std::span<const SearchEntry> path_searches() {
  static const SearchEntry kPathSearches[] = {
      {"gradient_projection", "local baseline along a path: the projected gradient at each instant",
       true, make_gradient_projection, false, 0, 1, true},
      {"mpc",
       "receding horizon along a path: sequential linear programming over the next intervals",
       false, make_mpc, false, 0, 1, true},
  };
  return kPathSearches;
}
std::span<const SearchEntry> transfer_searches() {
  static const std::vector<SearchEntry> kTransferSearches = make_transfer_searches();
  return kTransferSearches;
}
std::span<const SearchEntry> facet_searches() {
  static const std::vector<SearchEntry> kFacetSearches = make_facet_searches();
  return kFacetSearches;
}
std::span<const IntegratorEntry> integrators() { return kIntegrators; }

std::span<const Absent> not_built_in() {
  static const std::vector<Absent> kAbsent = make_absent();
  return kAbsent;
}
bool one_at_a_time(std::string_view name) {
  return std::any_of(std::begin(kOptional), std::end(kOptional), [&](const auto& optional) {
    return optional.entry.name == name && optional.entry.library == std::string_view("Ipopt");
  });
}

const char* general_search() { return MAXWRENCH_WITH_NLOPT ? "crs2+cmaes" : "annealing+cmaes"; }

}  // namespace maxwrench
