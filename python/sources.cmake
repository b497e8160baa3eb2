set(maxwrench_python_sources
  answer_state.cpp answers.cpp arrays.cpp background.cpp capability.cpp errors.cpp evaluations.cpp linear_programs.cpp module.cpp poses.cpp
  proofs.cpp robots.cpp solve.cpp strategies.cpp tank.cpp tasks.cpp words.cpp wrench_sets.cpp)
set(maxwrench_python_modules
  __init__.py _arguments.py _errors.py _files.py _frames.py _html.py _pickle.py _plot.py _progress.py _race.py _ros.py _strategies.py _table.py)
