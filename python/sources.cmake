set(maxwrench_python_sources
  src/answer_scenarios.cpp src/answer_state.cpp src/answers.cpp src/arrays.cpp src/background.cpp src/capabilities.cpp src/capability.cpp
  src/contacts.cpp src/errors.cpp src/evaluations.cpp src/explanations.cpp src/fronts.cpp src/held.cpp src/linear_programs.cpp src/maps.cpp
  src/margins.cpp src/module.cpp src/motion_arguments.cpp src/own_measures.cpp src/own_searches.cpp src/paths.cpp src/poses.cpp
  src/proofs.cpp src/robot_parts.cpp src/robots.cpp src/scale.cpp src/scenario_arguments.cpp src/sensitivity.cpp src/shared_objects.cpp
  src/solve.cpp src/tank.cpp src/tank_scenarios.cpp src/task_arguments.cpp src/task_makers.cpp src/tasks.cpp src/trajectory_proofs.cpp
  src/transfers.cpp src/view.cpp src/words.cpp src/wrench_sets.cpp)
set(maxwrench_python_modules
  __init__.py _arguments.py _dict.py _errors.py _files.py _frames.py _html.py _made.py _map.py _parts.py _pickle.py _plot.py _progress.py _race.py
  _ros.py _strategies.py _table.py _view.py)
