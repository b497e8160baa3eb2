set(maxwrench_verify_sources
  any_proof.cpp any_wrench.cpp box_forms.cpp braced_proof.cpp centred_rows.cpp certificate.cpp collision_proof.cpp contact_limits.cpp coordinates.cpp equations.cpp form.cpp free_wrench_limits.cpp free_proof.cpp gain.cpp
  incumbent.cpp list_forms.cpp list_proof.cpp list_value.cpp loads.cpp lp_proof.cpp model.cpp nearest_means.cpp packed.cpp proof_over_box.cpp pure_proof.cpp
  sealed.cpp shrinking.cpp verify.cpp wide_matrix.cpp
  trajectory/dependent_joints.cpp trajectory/effort_law.cpp trajectory/jet.cpp trajectory/knot_curve.cpp trajectory/motion_clearance.cpp trajectory/narrow_box.cpp trajectory/provable.cpp
  trajectory/scenario_task.cpp trajectory/trajectory_certificate.cpp trajectory/trajectory_forces.cpp trajectory/trajectory_model.cpp
  trajectory/verify_scenarios.cpp trajectory/verify_trajectory.cpp)
