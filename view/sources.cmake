set(maxwrench_view_sources
  base64.cpp page.cpp page_file.cpp
  engine/engine.cpp engine/evaluator.cpp engine/module.cpp engine/problem_data.cpp engine/wrapped_hull.cpp
  scene/bodies.cpp scene/explanation.cpp scene/frames.cpp scene/good_postures.cpp scene/shown.cpp scene/mesh.cpp scene/robot.cpp scene/scenarios_in_time.cpp scene/scene.cpp scene/tank.cpp scene/wrench_sets.cpp
  still/numbers.cpp still/painter.cpp still/solids.cpp still/still.cpp still/world.cpp still/wrenches.cpp)
