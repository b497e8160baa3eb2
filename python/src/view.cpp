#include <pybind11/stl.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "maxwrench/trajectory.h"
#include "problems/loader/visuals.h"
#include "problems/make/bad_value.h"
#include "python/src/parts.h"
#include "view/page.h"
#include "view/scene/scene.h"

namespace maxwrench::python {
namespace {

/// The folders of packages that the robot of a task was read with.
std::vector<std::filesystem::path> packages_of(const PyTask& task) {
  const py::dict& how = task.recipe.second;
  if (!how.contains("robot")) return {};
  const PyRobot& robot = how["robot"].cast<const PyRobot&>();
  if (!robot.recipe.second.contains("packages")) return {};
  std::vector<std::filesystem::path> folders;
  for (const py::handle& folder : robot.recipe.second["packages"]) {
    folders.emplace_back(py::module_::import("os").attr("fspath")(folder).cast<std::string>());
  }
  return folders;
}

std::string page_of(const PyAnswer& self, bool tank) {
  const Answer& answer = self.answer;
  if (!answer.has_posture()) throw BadValue("answer", "no posture", "an answer with a posture");
  if (tank) require_tank(*answer.task, answer.choice.measure, "tank");
  const std::vector<std::filesystem::path> packages = packages_of(self.task);
  const py::gil_scoped_release released;
  const Problem& task = *answer.task;
  std::vector<Shown> shown = {{answer.choice.search.empty() ? "given" : "best", answer}};
  if (!answer.given_joints) {
    Options options;
    static_cast<Case&>(options) = answer.choice;
    options.check_collision = answer.collision;
    shown.push_back({"default", evaluate(task, default_knots(task), options)});
  }
  for (Shown& each : shown) each.tank = tank;
  return view_page(task, scene_of(task, read_visuals(task.robot, packages), shown));
}

}  // namespace

void add_view(py::module_& m) { m.def("_page", &page_of, py::arg("answer"), py::arg("tank")); }

}  // namespace maxwrench::python
