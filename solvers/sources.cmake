set(maxwrench_solvers_sources
  certify/bound/any_bound.cpp certify/bound/any_rows.cpp certify/bound/alone_list_bound.cpp certify/bound/ball_bound.cpp
  certify/bound/bound_points.cpp
  certify/bound/ceiling.cpp certify/bound/list_bound.cpp certify/bound/list_model.cpp certify/bound/list_multiplier.cpp certify/bound/list_rows.cpp certify/bound/capability_bound.cpp certify/bound/collision_bound.cpp
  certify/bound/equation_points.cpp certify/bound/equation_program.cpp certify/bound/exact_posture.cpp
  certify/bound/free_bound.cpp certify/bound/free_limits.cpp certify/bound/free_points.cpp certify/bound/loop_box.cpp
  certify/bound/loop_linear.cpp certify/bound/loop_model.cpp certify/bound/loop_posture.cpp certify/bound/multi_affine.cpp
  certify/bound/thrust_points.cpp
  certify/bound/multiplier_program.cpp certify/bound/pure_bound.cpp 
  certify/box_coordinates.cpp certify/box_tree.cpp certify/certify.cpp certify/clusters.cpp certify/good_postures.cpp certify/halving.cpp certify/proof.cpp
  certify/proof_recorder.cpp
  certify/trajectory/edge_program.cpp certify/trajectory/solve_proven.cpp certify/trajectory/trajectory_proof.cpp
  explain/best_posture.cpp explain/efforts.cpp explain/exits.cpp explain/explain.cpp explain/explanation_json.cpp
  explain/explanation_text.cpp explain/instants.cpp explain/limits.cpp
  integrator/runge_kutta.cpp
  lp/elastic.cpp
  lp/exact/exact_basis.cpp lp/exact/rational_elimination.cpp
  lp/simplex.cpp
  lp/simplex/dual.cpp lp/simplex/dual_start.cpp lp/simplex/engine.cpp lp/simplex/factor.cpp lp/simplex/inverse.cpp
  lp/simplex/markowitz.cpp lp/simplex/model.cpp lp/simplex/primal.cpp lp/simplex/sparse_factor.cpp
  map/lattice.cpp map/map.cpp map/map_text.cpp map/plan_check.cpp map/posed.cpp map/robot_keys.cpp
  pareto/front.cpp pareto/front_text.cpp pareto/weighted.cpp
  search/annealing.cpp search/batch.cpp search/cmaes.cpp search/composition.cpp search/facet_starts.cpp search/grid.cpp
  search/joint_program.cpp search/knot_drawing.cpp search/knot_starts.cpp search/local_search.cpp search/probe.cpp
  search/restart.cpp search/sample.cpp
  search/factor_program.cpp search/slp.cpp search/slp_outcome.cpp search/slp_run.cpp search/starts.cpp search/trace.cpp
  solve/active_limits.cpp solve/answer_json.cpp solve/evaluate_each.cpp solve/experiment.cpp solve/format.cpp
  solve/held.cpp solve/held_text.cpp solve/json_line.cpp solve/method.cpp solve/near_singular.cpp solve/row.cpp solve/scenario_alone.cpp
  solve/scenario_ends.cpp solve/scenario_sample.cpp solve/sensitivity.cpp solve/solve.cpp solve/summary.cpp
  solve/tank.cpp solve/tank_scenarios.cpp solve/why_none.cpp
  added_strategies.cpp strategies.cpp strategy_lookup.cpp
  trajectory/assembled.cpp trajectory/bordered_facets.cpp trajectory/by_facets.cpp trajectory/embedding.cpp
  trajectory/common_factor.cpp trajectory/embedding_passes.cpp trajectory/even_efforts.cpp trajectory/facets_or_ipm.cpp trajectory/forms.cpp
  trajectory/forms_answer.cpp trajectory/forms_order.cpp trajectory/ipm.cpp trajectory/normal_matrix.cpp
  version.cpp
  wrench/assembled.cpp wrench/condensed.cpp wrench/efforts.cpp wrench/elimination.cpp wrench/facets.cpp wrench/tableau.cpp
  wrench/tableau/verdict.cpp
  wrench_set/boundary.cpp wrench_set/directions.cpp wrench_set/ellipsoid.cpp wrench_set/frame.cpp wrench_set/polytope.cpp
  wrench_set/support.cpp
  margin/instant_scan.cpp margin/margin_text.cpp margin/motion_margin.cpp
  search/gradient_projection.cpp search/linear_steps.cpp search/mpc.cpp search/mpc_window.cpp search/path_plan.cpp search/projected_flow.cpp
  search/dp.cpp search/dp_grid.cpp search/dp_level.cpp search/dp_motion.cpp
  solve/scenario_values.cpp solve/too_weak.cpp
  certify/trajectory/instant_bound.cpp certify/trajectory/instant_objective.cpp certify/trajectory/instant_ranges.cpp
  certify/trajectory/plan_bound.cpp certify/trajectory/quadratic_loads.cpp
  map/list_keys.cpp)
if(MAXWRENCH_WITH_SUNDIALS)
  list(APPEND maxwrench_solvers_sources
    integrator/arkode.cpp integrator/cvode.cpp integrator/ida.cpp integrator/sundials.cpp
    search/nullspace.cpp
    pontryagin/climb.cpp pontryagin/extremal.cpp pontryagin/extremal_flow.cpp pontryagin/least_effort_motion.cpp
    search/pontryagin.cpp)
endif()
if(MAXWRENCH_WITH_IPOPT)
  list(APPEND maxwrench_solvers_sources
    ipopt/ipopt_nlp.cpp
    lp/ipopt.cpp
    search/facet_nlp.cpp search/joint_nlp.cpp search/multistart.cpp)
endif()
if(MAXWRENCH_WITH_CLP)
  list(APPEND maxwrench_solvers_sources
    lp/clp.cpp)
endif()
if(MAXWRENCH_WITH_GLPK)
  list(APPEND maxwrench_solvers_sources
    lp/glpk.cpp)
endif()
if(MAXWRENCH_WITH_NLOPT)
  list(APPEND maxwrench_solvers_sources
    search/facet_sqp.cpp search/nlopt_run.cpp search/nlopt_searches.cpp search/row_sqp.cpp)
endif()
if(MAXWRENCH_WITH_PAGMO)
  list(APPEND maxwrench_solvers_sources
    search/pagmo_run.cpp)
endif()
