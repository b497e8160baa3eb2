#include "maxwrench/held.h"

#include <fmt/format.h>

#include <string>

#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/fields.h"
#include "python/src/parts.h"

namespace maxwrench::python {

/// What Python shows of it: neither the efforts nor the samples of the experiment.
template <class Archive>
void fields(Archive& archive, HeldTrajectory& h) {
  archive(static_cast<Verdict&>(h), h.answer.trajectory.knots, h.run.summary.planned,
          h.run.summary.held, h.share, h.reading, h.first, h.simulations, h.stopped, h.seconds);
}

namespace {

py::object solve_task_held(const py::object& task, long simulations, const std::string& wrench,
                           const std::string& solver, const std::string& search, std::uint64_t seed,
                           long budget, int threads, const std::string& integrator,
                           const py::object& callback) {
  const PyTask of = task_of(task);
  Options options;
  options.wrench = parse_wrench(wrench);
  options.solver = solver;
  options.search = search;
  options.seed = seed;
  options.budget = budget;
  options.threads = threads;
  HeldOptions how;
  how.simulations = simulations;
  how.integrator = integrator;
  HeldTrajectory held;
  const Callback shown(callback, simulations, of.problem->name);
  run_in_background(shown.function(), [&](Watch& watch) {
    watch_over(watch, options);
    held = solve_held(*of.problem, options, how);
  });
  return py::cast(std::move(held));
}

constexpr const char* kSolveHeld =
    R"(Searches for the trajectory with the largest reading that the virtual tank holds.

It starts at the best trajectories that can be proven, with and without the lag of the tank's
thrusters, and moves the knots and the planned wrench. Of a task that proofs do not support, it
starts at those of ``solve``. Each evaluation is an experiment.

Args:
    task: a Task in time with one wrench along c, or the name of one.
    simulations: largest number of experiments.
    wrench, solver, search, seed, budget: those of ``solve`` for the first trajectories; the seed is
        also that of the search itself.
    threads: number of threads; it changes the time, never the answer; 0: one per core.
    integrator: of the experiments.
    callback: as of ``solve``.

Returns:
    HeldTrajectory: the best one found.

Raises:
    InputError: the tank does not support the task, or a value is out of its range.

>>> held = maxwrench.solve_held("planar/trajectory", simulations=2, budget=300)
>>> held.status, held.held
('best_found', True)
)";

}  // namespace

void add_held(py::module_& m) {
  py::class_<HeldTrajectory>(m, "HeldTrajectory",
                             R"(A trajectory and its experiment, made by ``solve_held``.

>>> held = maxwrench.solve_held("planar/trajectory", simulations=2, budget=300)
>>> held.reading >= held.first
True
)")
      .def_property_readonly(
          "status", [](const HeldTrajectory& h) { return to_string(h.status); },
          "best_found, none_found, or budget_exhausted after an interruption.")
      .def_property_readonly(
          "reason", [](const HeldTrajectory& h) { return h.reason.str(); },
          "Why there is none; empty if there is one.")
      .def_property_readonly(
          "knots",
          [](const HeldTrajectory& h) { return copy(RowMatrix(h.answer.trajectory.knots)); },
          "The knots of theta_r (k×r).")
      .def_readonly("reading", &HeldTrajectory::reading,
                    "The reading along c: of a path the least, of an impulse that at its peak.")
      .def_readonly("first", &HeldTrajectory::first,
                    "The reading of the best of the first trajectories; NaN: none is held.")
      .def_readonly("share", &HeldTrajectory::share,
                    "The planned wrench as a share of the value of the trajectory.")
      .def_property_readonly(
          "planned", [](const HeldTrajectory& h) { return h.run.summary.planned; },
          "The planned wrench along c [N or N m].")
      .def_property_readonly(
          "held", [](const HeldTrajectory& h) { return h.run.summary.held; },
          "Whether the wrench was held.")
      .def_readonly("simulations", &HeldTrajectory::simulations, "The number of experiments.")
      .def("__repr__",
           [](const HeldTrajectory& h) {
             return fmt::format("<HeldTrajectory: {}, reading {:.6g}>", to_string(h.status),
                                h.reading);
           })
      .def(py::pickle(&pack<HeldTrajectory>, &unpack<HeldTrajectory>));
  m.def("solve_held", &solve_task_held, py::arg("task"), py::kw_only(),
        py::arg("simulations") = HeldOptions().simulations, py::arg("wrench") = "pure",
        py::arg("solver") = "", py::arg("search") = "", py::arg("seed") = 1, py::arg("budget") = 0,
        py::arg("threads") = 0, py::arg("integrator") = HeldOptions().integrator,
        py::arg("callback") = py::none(), kSolveHeld);
}

}  // namespace maxwrench::python
