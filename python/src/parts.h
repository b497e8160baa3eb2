#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>

#include "maxwrench/certify.h"
#include "maxwrench/path.h"
#include "maxwrench/solve.h"
#include "maxwrench/task.h"
#include "python/src/arrays.h"

// What the files of the module share.

namespace maxwrench::python {

namespace py = pybind11;

/// How an object was made: the name of a function of the module and its arguments. Pickle stores
/// this in place of the object.
using Recipe = std::pair<std::string, py::dict>;

/// A robot, as Python holds it.
struct PyRobot {
  std::shared_ptr<const Robot> robot;
  Recipe recipe;
};

/// A task, as Python holds it.
struct PyTask {
  std::shared_ptr<const Problem> problem;
  Recipe recipe;
};

/// A path of the end effector, as Python holds it.
struct PyPath {
  Path path;
  Recipe recipe;
};

/// An answer with the task that it was asked of.
struct PyAnswer {
  Answer answer;
  PyTask task;
};

/// What pickle stores: the call that makes the object again, and the digest that it must have.
py::tuple reduced(const Recipe& recipe, const std::string& digest = "");
/// The task in an argument: a Task, or the name of one.
PyTask task_of(const py::object& task);
/// The Evaluations of a static task at each row of an array.
py::object evaluate_rows(const PyTask& task, const py::object& theta_r, const Options& options,
                         bool gradients, const py::object& callback);
/// The same in postures given by all joints.
py::object evaluate_joint_rows(const PyTask& task, const py::object& q, const Options& options,
                               const py::object& callback);
/// What pickle stores of an answer: the posture, and what its search did. The posture is evaluated
/// again when it is read, with the same result.
py::tuple answer_state(const PyAnswer& self);
PyAnswer answer_from_state(const py::tuple& state);
/// theta_r of a posture, as one row, or knots (k×r) of a task in time.
Eigen::MatrixXd knots_in(const Array& array, const Problem& task);
/// `certify` of a task in time: a TrajectoryProof, of the knots in theta_r or, if that is None, of
/// the trajectory that a search finds, with the bound that none exceeds.
py::object certify_motion(const PyTask& task, const py::object& theta_r, const Options& options,
                          const ProofOptions& limits, const py::object& callback);
/// `verify` of a certificate of a trajectory; `given` is the task in place of the one it names.
py::object verify_motion(const std::string& file, const std::optional<Problem>& given, int threads);
/// The second contact of a task: a maxwrench.Contact.
ContactSpec contact_in(const py::object& value);
/// Reads the dicts of a task that have the keys of a task file: those of its table `[wrench]`, and
/// the tables `uncertainty`, `loss` and `payload`, for the robot of `spec`.
void read_scenario_arguments(const py::dict& wrench, const py::dict& tables, TaskSpec& spec);
/// The table of wrenches over time in the argument `wrenches`, which leaves `arguments`; or none.
std::optional<WrenchTable> wrenches_in(py::dict& arguments);
/// The homogeneous matrix of a pose (4×4).
RowMatrix matrix_of(const Pose<double>& pose);
/// Adds the method `explain`.
void add_explain(py::class_<PyAnswer>& answer);
/// Adds what an answer says of a list of scenarios.
void add_scenarios(py::class_<PyAnswer>& answer);
/// [x y z roll pitch yaw] of the base in the world, then the joints.
Eigen::VectorXd theta_of(const Pose<double>& base, const Eigen::VectorXd& q);

// Each adds its classes and functions to the module.
void add_errors(py::module_& m);
void add_poses(py::module_& m);
void add_robots(py::module_& m);
void add_robot_parts(py::module_& m);
void add_paths(py::module_& m);
void add_tasks(py::module_& m);
void add_task_makers(py::module_& m);
void add_transfers(py::module_& m);
void add_explanations(py::module_& m);
void add_sensitivity(py::module_& m);
void add_maps(py::module_& m);
void add_fronts(py::module_& m);
void add_answers(py::module_& m);
void add_solve(py::module_& m);
void add_evaluations(py::module_& m);
void add_capabilities(py::module_& m);
void add_capability(py::module_& m);
void add_scale(py::module_& m);
void add_linear_programs(py::module_& m);
void add_tank(py::module_& m);
void add_held(py::module_& m);
void add_proofs(py::module_& m);
void add_trajectory_proofs(py::module_& m);
void add_wrench_sets(py::module_& m);
void add_view(py::module_& m);
void add_own_measures(py::module_& m);
void add_own_searches(py::module_& m);

}  // namespace maxwrench::python
