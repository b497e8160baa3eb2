set(maxwrench_cli_sources
  cli.cpp ctrl_c.cpp lp.cpp manual.cpp output.cpp progress.cpp
  proof/certify.cpp proof/good_postures.cpp proof/lp_proof.cpp proof/plan_bounds.cpp proof/prove.cpp proof/trajectory_proofs.cpp proof/verify.cpp proof/verify_rows.cpp
  report/benchmark_set_section.cpp report/difference_sections.cpp report/page.cpp report/race_sections.cpp report/report.cpp
  report/report_table.cpp report/run_sections.cpp
  reproduce/dual_arm.cpp reproduce/motion.cpp reproduce/planar.cpp reproduce/reproduce.cpp reproduce/tank_plans.cpp reproduce/uvms.cpp
  suite/compare.cpp suite/merge.cpp suite/race_figures.cpp suite/race_table.cpp suite/row_writer.cpp suite/run.cpp suite/shard_option.cpp
  suite/workers.cpp
  task/check.cpp task/dies_option.cpp task/eval.cpp task/explain_option.cpp task/held_option.cpp task/init.cpp
  task/list.cpp task/load_and_solve.cpp task/motion_options.cpp task/own_weight.cpp task/plot.cpp task/pose.cpp
  task/problem_options.cpp task/simulate.cpp task/simulate_motion.cpp task/simulate_scenarios.cpp
  task/map.cpp task/pareto.cpp task/sensitivity.cpp task/solve.cpp task/state.cpp task/view.cpp
  task/margin.cpp)
