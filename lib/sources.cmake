set(maxwrench_lib_sources
  math/cubic_spline.cpp math/decompositions.cpp math/direct_drives.cpp math/distance.cpp math/gjk.cpp math/linear_program.cpp math/ode_solution.cpp
  math/nearest_edge.cpp math/polygon.cpp math/quick_hull.cpp math/random.cpp math/status.cpp math/zonotope.cpp
  measure/closed_form.cpp measure/dynamic_capability.cpp measure/dynamic_manipulability.cpp measure/ellipsoid.cpp measure/ellipsoid_trace.cpp measure/least_effort.cpp measure/manipulability.cpp
  measure/measure.cpp measure/one_sided.cpp measure/polytope.cpp measure/saturating_wrench.cpp measure/scenario_polytope.cpp measure/task_dynamics.cpp
  measure/transmission_ratio.cpp measure/value_measure.cpp
  measure/wrench_program.cpp
  posture/free_pose.cpp posture/given_posture.cpp
  posture/ik/contact_arm.cpp posture/ik/continuation.cpp posture/ik/damped_newton.cpp posture/ik/dependent_joints.cpp
  posture/ik/ik_solver.cpp posture/ik/ik_start_system.cpp posture/ik/path_tracker.cpp posture/ik/primary_ik.cpp
  posture/ik/second_arm.cpp posture/ik/tool_chain.cpp
  posture/movable.cpp posture/posture.cpp posture/pull_back.cpp posture/redundancy.cpp posture/scenario_slopes.cpp posture/tally.cpp posture/violation.cpp
  robot/chain.cpp robot/clearance_slope.cpp robot/contact.cpp robot/dynamics.cpp robot/dynamics_slopes.cpp robot/free_motion.cpp
  robot/kinematics.cpp robot/problem.cpp robot/robot.cpp
  scenario/ball_across.cpp scenario/current_cases.cpp scenario/current_load.cpp scenario/scenario_facets.cpp scenario/scenario_list.cpp scenario/scenario_margins.cpp
  scenario/scenario_program.cpp scenario/static_load.cpp
  search/capability.cpp search/facet_program.cpp search/scenario_rows.cpp
  tank/control_loop.cpp tank/controller.cpp tank/effort_tracking.cpp tank/motion_run.cpp tank/ode.cpp tank/options.cpp
  tank/reference.cpp tank/script.cpp tank/summary.cpp tank/tank.cpp
  trajectory/canonical_equations.cpp trajectory/carried.cpp trajectory/clearance.cpp trajectory/instant_evaluator.cpp
  trajectory/limits.cpp trajectory/motion_evaluator.cpp trajectory/motion_scenarios.cpp trajectory/objective.cpp
  trajectory/overshoot.cpp trajectory/path.cpp trajectory/program.cpp trajectory/robot_motion.cpp trajectory/scheme.cpp
  trajectory/trajectory.cpp trajectory/trajectory_program.cpp trajectory/trajectory_residual.cpp
  trajectory/transfer_dynamics.cpp trajectory/window_evaluator.cpp trajectory/workspace.cpp)
