#include <pybind11/pybind11.h>

#include "maxwrench/version.h"
#include "python/src/margins.h"
#include "python/src/parts.h"

PYBIND11_MODULE(_core, m) {
  using namespace maxwrench;
  m.doc() = "The compiled part of maxwrench; import maxwrench instead.";
  m.attr("__version__") = version();
  m.def("describe_build", &describe_build,
        R"(Returns the version, how the module was built, and the libraries that it uses.

>>> maxwrench.describe_build().startswith("maxwrench " + maxwrench.__version__)
True
)");
  python::add_errors(m);
  python::add_poses(m);
  python::add_robots(m);
  python::add_robot_parts(m);
  python::add_paths(m);
  python::add_tasks(m);
  python::add_task_makers(m);
  python::add_transfers(m);
  python::add_explanations(m);
  python::add_answers(m);
  python::add_evaluations(m);
  python::add_solve(m);
  python::add_sensitivity(m);
  python::add_maps(m);
  python::add_fronts(m);
  python::add_margins(m);
  python::add_capabilities(m);
  python::add_capability(m);
  python::add_scale(m);
  python::add_linear_programs(m);
  python::add_tank(m);
  python::add_held(m);
  python::add_proofs(m);
  python::add_trajectory_proofs(m);
  python::add_wrench_sets(m);
  python::add_view(m);
  python::add_own_measures(m);
  python::add_own_searches(m);
}
