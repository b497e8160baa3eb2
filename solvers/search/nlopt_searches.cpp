#include "solvers/search/makers.h"
#include "solvers/search/nlopt_run.h"

// The methods of NLopt.

namespace maxwrench {
namespace {

NloptOptions gradient_search(const char* method, nlopt_algorithm algorithm) {
  NloptOptions options{method, algorithm};
  options.x_tolerance = 1e-7;
  options.f_tolerance = 1e-10;
  return options;
}

NloptOptions model_search(const char* method, nlopt_algorithm algorithm) {
  NloptOptions options{method, algorithm};
  options.initial_step = 0.1;
  options.x_tolerance = 1e-6;
  return options;
}

}  // namespace

/// Sequential quadratic programs with a dense quasi-Newton matrix (Kraft 1994).
std::unique_ptr<Search> make_slsqp() {
  return make_nlopt_search(gradient_search("slsqp", NLOPT_LD_SLSQP));
}

/// Moving asymptotes: separable convex models (Svanberg 2002).
std::unique_ptr<Search> make_mma() {
  return make_nlopt_search(gradient_search("mma", NLOPT_LD_MMA));
}

/// Limited-memory quasi-Newton method with bounds (Liu, Nocedal 1989; Luksan's code).
std::unique_ptr<Search> make_lbfgs() {
  return make_nlopt_search(gradient_search("lbfgs", NLOPT_LD_LBFGS));
}

/// Quadratic models without derivatives (Powell 2009).
std::unique_ptr<Search> make_bobyqa() {
  return make_nlopt_search(model_search("bobyqa", NLOPT_LN_BOBYQA));
}

/// Linear models on a simplex without derivatives (Powell 1994).
std::unique_ptr<Search> make_cobyla() {
  return make_nlopt_search(model_search("cobyla", NLOPT_LN_COBYLA));
}

/// Controlled random search with local mutation (Price 1983; Kaelo, Ali 2006): random simplices
/// contract a population, which includes the start. If another search follows, a population within
/// a hundredth of the bounds is close enough.
std::unique_ptr<Search> make_crs2() {
  NloptOptions options{"crs2", NLOPT_GN_CRS2_LM};
  options.x_tolerance = 1e-7;
  options.x_rough = 1e-2;
  options.evaluations_per_run = 2500;
  return make_nlopt_search(options);
}

/// Improved stochastic ranking evolution strategy (Runarsson, Yao 2005). The start belongs to the
/// first population. Runs until the budget is used.
std::unique_ptr<Search> make_isres() {
  NloptOptions options{"isres", NLOPT_GN_ISRES};
  options.evaluations_per_run = 10000;
  return make_nlopt_search(options);
}

/// Multi-level single-linkage (Rinnooy Kan, Timmer 1987): local searches by L-BFGS from random
/// points, at most one for each cluster of points.
std::unique_ptr<Search> make_mlsl() {
  NloptOptions options{"mlsl", NLOPT_G_MLSL, NLOPT_LD_LBFGS};
  options.x_tolerance = 1e-7;
  options.max_parallel = 1;
  return make_nlopt_search(options);
}

/// DIRECT-L: divides the bounds into boxes, first those that may hold the best value for any
/// Lipschitz constant, with a bias to local search (Gablonsky, Kelley 2001). It uses no random
/// numbers. The start determines the s of phi and is otherwise just one more point.
std::unique_ptr<Search> make_direct_l() {
  NloptOptions options{"direct_l", NLOPT_GN_DIRECT_L};
  options.max_parallel = 1;
  return make_nlopt_search(options);
}

}  // namespace maxwrench
