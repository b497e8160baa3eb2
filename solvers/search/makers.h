#pragma once

#include <memory>

#include "maxwrench/search.h"

// Searches. The table of strategies describes them.

namespace maxwrench {

std::unique_ptr<Search> make_annealing();

std::unique_ptr<Search> make_bobyqa();

std::unique_ptr<Search> make_cmaes();

std::unique_ptr<Search> make_cobyla();

std::unique_ptr<Search> make_crs2();

std::unique_ptr<Search> make_de();

std::unique_ptr<Search> make_direct_l();

std::unique_ptr<Search> make_dp();

std::unique_ptr<Search> make_facet_nlp();

std::unique_ptr<Search> make_facet_sqp();

std::unique_ptr<Search> make_gradient_projection();

std::unique_ptr<Search> make_grid();

std::unique_ptr<Search> make_isres();

std::unique_ptr<Search> make_joint_nlp();

std::unique_ptr<Search> make_lbfgs();

std::unique_ptr<Search> make_mlsl();

std::unique_ptr<Search> make_mma();

std::unique_ptr<Search> make_mpc();

std::unique_ptr<Search> make_multistart();

std::unique_ptr<Search> make_nullspace();

std::unique_ptr<Search> make_pagmo_cmaes();

std::unique_ptr<Search> make_pontryagin();

std::unique_ptr<Search> make_sade();

std::unique_ptr<Search> make_sample();

std::unique_ptr<Search> make_slp();

std::unique_ptr<Search> make_slsqp();

}  // namespace maxwrench
