set(maxwrench_problems_sources
  collision/collision.cpp collision/grown_shape.cpp collision/shapes.cpp
  loader/bad_input.cpp loader/block.cpp loader/contact_table.cpp loader/drives.cpp loader/joint_group.cpp loader/knots.cpp loader/motion_file.cpp
  loader/motion_table.cpp loader/number_table.cpp loader/path_table.cpp loader/robot_choices.cpp
  loader/robot_file.cpp loader/robot_srdf.cpp loader/scenario_tables.cpp loader/srdf.cpp loader/state_file.cpp loader/task_file.cpp
  loader/urdf_element.cpp loader/urdf_joint.cpp loader/urdf_shape.cpp loader/urdf_structure.cpp loader/urdf_tree.cpp
  loader/urdf_visual.cpp loader/visuals.cpp loader/xacro.cpp
  make/bad_value.cpp make/base_motion.cpp make/coordinate_series.cpp make/motion_instants.cpp make/collision_shapes.cpp make/contact.cpp make/free_pose.cpp make/losses.cpp make/motion_task.cpp make/payload.cpp
  make/posture.cpp make/redundant_joints.cpp
  make/robot.cpp make/scenarios.cpp make/task.cpp make/theta_r.cpp make/touching_bodies.cpp make/transfer_ends.cpp make/uncertain_loads.cpp
  mesh/capsule.cpp mesh/find_mesh.cpp mesh/hull.cpp mesh/mesh_shape.cpp mesh/mesh_text.cpp mesh/read_mesh.cpp mesh/thin_out.cpp
  mps/fields.cpp mps/reader.cpp mps/wrench_file.cpp mps/writer.cpp)
