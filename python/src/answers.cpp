#include <fmt/format.h>
#include <pybind11/stl.h>

#include "lib/robot/kinematics.h"
#include "maxwrench/figures.h"
#include "python/src/arrays.h"
#include "python/src/parts.h"
#include "solvers/solve/format.h"

namespace maxwrench::python {
namespace {

/// One row of numbers for each instant; without rows where there is none.
template <class Row>
RowMatrix of_instants(const Trajectory& trajectory, Eigen::Index cols, Row row) {
  RowMatrix table = RowMatrix::Constant(Eigen::Index(trajectory.instants.size()), cols,
                                        std::numeric_limits<double>::quiet_NaN());
  Eigen::Index i = 0;
  for (const Instant& instant : trajectory.instants) {
    const Eigen::VectorXd numbers = row(instant);
    if (numbers.size() == cols) table.row(i) = numbers;
    ++i;
  }
  return table;
}

bool in_time(const Answer& answer) { return answer.task->motion.has_value(); }

/// An array over instants for a task in time, else that of the only instant.
template <class Row>
py::object per_instant(const Answer& answer, Eigen::Index cols, Row row) {
  if (answer.trajectory.instants.empty()) return py::none();
  const RowMatrix table = of_instants(answer.trajectory, cols, row);
  if (in_time(answer)) return copy(table);
  return copy(Eigen::VectorXd(table.row(0)));
}

Eigen::Index joints_of(const Answer& answer) {
  return Eigen::Index(answer.task->robot.joints.size());
}

py::object theta_r(const PyAnswer& self) {
  const Answer& answer = self.answer;
  if (!answer.has_posture()) return py::none();
  if (in_time(answer)) return copy(RowMatrix(answer.trajectory.knots));
  return copy(Eigen::VectorXd(answer.trajectory.knots.row(0)));
}

py::object gradient(const PyAnswer& self) {
  const Trajectory& trajectory = self.answer.trajectory;
  if (trajectory.gradient.size() == 0) return py::none();
  if (in_time(self.answer)) return copy(RowMatrix(trajectory.gradient));
  return copy(stacked(trajectory.gradient));
}

py::object theta(const PyAnswer& self) {
  return per_instant(self.answer, 6 + joints_of(self.answer),
                     [](const Instant& i) { return theta_of(i.base, i.q); });
}

py::object efforts(const PyAnswer& self) {
  if (!self.answer.has_value()) return py::none();
  if (!in_time(self.answer) && self.answer.capability.u.size() == 0) return py::none();
  return per_instant(self.answer, self.answer.task->robot.actuators(),
                     [](const Instant& i) { return i.u; });
}

py::object wrench(const PyAnswer& self) {
  if (!self.answer.has_value()) return py::none();
  if (!in_time(self.answer) && self.answer.capability.w.size() == 0) return py::none();
  return per_instant(self.answer, 6, [](const Instant& i) { return Eigen::VectorXd(i.h); });
}

py::object beta_of_instants(const PyAnswer& self) {
  const auto& instants = self.answer.trajectory.instants;
  Eigen::VectorXd beta(instants.size());
  Eigen::Index i = 0;
  for (const Instant& instant : instants) beta[i++] = instant.beta();
  if (!self.answer.has_value() || instants.empty()) return py::none();
  if (!in_time(self.answer)) return py::float_(beta[0]);
  return copy(beta);
}

py::object lambda(const PyAnswer& self) {
  const Capability& capability = self.answer.capability;
  if (!self.answer.has_value() || capability.lambda.size() == 0) return py::none();
  return copy(capability.lambda);
}

py::object residual_of(const PyAnswer& self) {
  if (!self.answer.has_value()) return py::none();
  const Residual& residual = self.answer.residual();
  py::dict numbers;
  numbers["balance"] = residual.balance;
  numbers["bounds"] = residual.bounds;
  numbers["dual"] = residual.dual;
  numbers["gap"] = residual.gap;
  return numbers;
}

py::dict solutions_of(const PyAnswer& self) {
  const IkCounts& counts = self.answer.ik_solutions;
  py::dict numbers;
  numbers["valid"] = counts.valid();
  numbers["most"] = counts.most;
  numbers["found"] = counts.found;
  numbers["unreachable"] = counts.unreachable;
  numbers["beyond_limit"] = counts.beyond_limit;
  numbers["singular"] = counts.singular;
  numbers["collision"] = counts.collision;
  numbers["incomplete"] = counts.incomplete;
  return numbers;
}

std::string repr_of_answer(const PyAnswer& self) {
  const Answer& answer = self.answer;
  const std::string value = answer.has_value()
                                ? fmt::format("{:.6g} {}", answer.beta(), answer.unit)
                                : fmt::format("no value ({})", answer.reason.c_str());
  return fmt::format("<Answer {}: {}, {}>", answer.task->name, to_string(answer.status), value);
}

py::dict to_dict(const PyAnswer& self) {
  return py::module_::import("json").attr("loads")(to_json(self.answer));
}

std::string figure_of(const PyAnswer& self) {
  const Answer& answer = self.answer;
  if (!answer.has_posture()) throw std::invalid_argument("figure: got no posture, expected one");
  if (!in_time(answer)) {
    return figure(*answer.task, {{answer.choice.measure, answer.posture.theta_r}});
  }
  const double T = answer.task->motion->path.duration();
  return trajectory_figure(*answer.task, answer.trajectory, {0, T / 2, T});
}

py::object times(const PyAnswer& self) {
  if (!in_time(self.answer)) return py::none();
  Eigen::VectorXd t(self.answer.trajectory.instants.size());
  Eigen::Index i = 0;
  for (const Instant& instant : self.answer.trajectory.instants) t[i++] = instant.t;
  return copy(t);
}

/// The matrices of poses, with the given axes before the last two.
py::object matrices(const std::vector<Pose<double>>& poses, std::vector<py::ssize_t> shape) {
  RowMatrix rows(4 * Eigen::Index(poses.size()), 4);
  Eigen::Index i = 0;
  for (const Pose<double>& pose : poses) rows.middleRows<4>(4 * i++) = matrix_of(pose);
  shape.insert(shape.end(), {4, 4});
  return copy(rows).attr("reshape")(shape);
}

py::object link_poses(const PyAnswer& self) {
  const Robot& robot = self.answer.task->robot;
  const auto& instants = self.answer.trajectory.instants;
  if (instants.empty()) return py::none();
  std::vector<Pose<double>> poses;
  Kinematics<double> kinematics(robot);
  for (const Instant& instant : instants) {
    kinematics.set_joints(instant.q);
    for (const Pose<double>& link : kinematics.links()) poses.push_back(instant.base * link);
  }
  const auto links = py::ssize_t(robot.links.size());
  if (!in_time(self.answer)) return matrices(poses, {links});
  return matrices(poses, {py::ssize_t(instants.size()), links});
}

py::object end_effector(const PyAnswer& self) {
  std::vector<Pose<double>> poses;
  for (const Instant& i : self.answer.trajectory.instants) poses.push_back(i.end_effector);
  if (poses.empty()) return py::none();
  if (!in_time(self.answer)) return matrices(poses, {});
  return matrices(poses, {py::ssize_t(poses.size())});
}

/// What the search did, and how long it took.
void add_effort(py::class_<PyAnswer>& answer) {
  const auto choice = [&answer](const char* name, std::string Case::*member, const char* doc) {
    answer.def_property_readonly(
        name, [member](const PyAnswer& a) { return a.answer.choice.*member; }, doc);
  };
  choice("measure", &Case::measure, "The name of the measure.");
  choice("solver", &Case::solver, "The name of the solver of the lower level.");
  choice("search", &Case::search, "The name of the search; empty if the posture was given.");
  answer
      .def_property_readonly(
          "wrench", [](const PyAnswer& a) { return to_string(a.answer.choice.wrench); },
          "The allowed wrenches: pure or any.")
      .def_property_readonly(
          "seed", [](const PyAnswer& a) { return a.answer.choice.seed; },
          "The seed of the random numbers.")
      .def_property_readonly(
          "budget", [](const PyAnswer& a) { return a.answer.choice.budget; },
          "The largest number of evaluations.")
      .def_property_readonly(
          "evaluations", [](const PyAnswer& a) { return a.answer.evaluations; },
          "The number of evaluations.")
      .def_property_readonly(
          "stopped", [](const PyAnswer& a) { return a.answer.stopped; }, "Why the search ended.")
      .def_property_readonly(
          "seconds", [](const PyAnswer& a) { return a.answer.wall_s; }, "Wall time [s].")
      .def_property_readonly("solutions", &solutions_of,
                             "Counts of the IK solutions of all evaluations, by name.");
}

}  // namespace

Eigen::VectorXd theta_of(const Pose<double>& base, const Eigen::VectorXd& q) {
  Eigen::VectorXd theta(6 + q.size());
  theta << base.p, rpy(base.R), q;
  return theta;
}

void add_answers(py::module_& m) {
  py::class_<PyAnswer> answer(m, "Answer", R"(The value of a posture or trajectory, verified.

Arrays of a static task have one number for each coordinate. Those of a task in time have one row
for each instant ``t`` (N), but ``theta_r`` and ``gradient`` one for each knot (k). An array that
does not exist is None.

>>> answer = maxwrench.evaluate("planar/force", [0, 0])
>>> print(round(answer.beta, 3), answer.unit, answer.status)
2.311 N optimal
)");
  answer
      .def_property_readonly(
          "beta",
          [](const PyAnswer& a) {
            return a.answer.has_value() ? a.answer.beta()
                                        : std::numeric_limits<double>::quiet_NaN();
          },
          "The value [unit]; NaN: there is none.")
      .def_property_readonly(
          "unit", [](const PyAnswer& a) { return a.answer.unit; }, "The unit of the value.")
      .def_property_readonly(
          "status", [](const PyAnswer& a) { return to_string(a.answer.status); },
          "How it ended: optimal, best_found, budget_exhausted, reached, or why there is no value.")
      .def_property_readonly(
          "reason", [](const PyAnswer& a) { return a.answer.reason.str(); },
          "Why there is no value; empty if there is one.")
      .def_property_readonly(
          "has_value", [](const PyAnswer& a) { return a.answer.has_value(); },
          "Whether there is a value.")
      .def_property_readonly("theta_r", &theta_r, "The posture (r), or the knots (k×r) [rad or m].")
      .def_property_readonly(
          "theta", &theta,
          "Base and joints in the world: x, y, z, roll, pitch, yaw [m; rad], then the joints "
          "(6 + J), or N rows of them.")
      .def_property_readonly(
          "q",
          [](const PyAnswer& a) {
            return per_instant(a.answer, joints_of(a.answer), [](const Instant& i) { return i.q; });
          },
          "The joints (J), or N rows of them [rad or m].")
      .def_property_readonly("u", &efforts, "The efforts (m), or N rows of them [N or N m].")
      .def_property_readonly(
          "h", &wrench,
          "The wrench [force; torque] that the robot exerts, in the world (6), or N rows of them.")
      .def_property_readonly("betas", &beta_of_instants,
                             "The wrench along c: a number, or one of each instant (N).")
      .def_property_readonly("gradient", &gradient,
                             "Exact gradient of the value by theta_r (r), or k×r.")
      .def_property_readonly("lambda_", &lambda,
                             "Derivative of the value by tau_d (n), of a static task.")
      .def_property_readonly("t", &times, "The instants (N) [s]; None for a static task.")
      .def_property_readonly(
          "J",
          [](const PyAnswer& a) -> py::object {
            if (in_time(a.answer) || !a.answer.has_posture()) return py::none();
            return copy(RowMatrix(a.answer.posture.J));
          },
          "Jacobian (6×n) of a static task: velocities to the twist of the end effector in the "
          "world.")
      .def_property_readonly(
          "tau_d",
          [](const PyAnswer& a) {
            const Eigen::Index n = a.answer.task->robot.velocities();
            return per_instant(a.answer, n, [](const Instant& i) { return i.tau_d; });
          },
          "Forces that the efforts must exert without contact (n), or N rows of them.")
      .def_property_readonly(
          "velocity",
          [](const PyAnswer& a) {
            const Eigen::Index n = a.answer.task->robot.velocities();
            return per_instant(a.answer, n, [](const Instant& i) { return i.v; });
          },
          "Velocities (n): base in base axes, then joints; or N rows of them.")
      .def_property_readonly(
          "beta_linf", [](const PyAnswer& a) { return a.answer.beta_linf; },
          "Static: the value of linf_polytope at the same posture; NaN: none.")
      .def_property_readonly(
          "between_knots",
          [](const PyAnswer& a) { return a.answer.trajectory.value_between_knots; },
          "In time: the least value between knots [unit]; NaN: none.")
      .def_property_readonly("residual", &residual_of,
                             "balance, bounds, dual and gap, recomputed from the task's data; None "
                             "without a value.")
      .def_property_readonly(
          "task", [](const PyAnswer& a) { return a.task; }, "The Task.")
      .def_property_readonly("links", &link_poses,
                             "Homogeneous matrices of the links in the world (L×4×4), in the order "
                             "of robot.link_names; in time N×L×4×4.")
      .def_property_readonly("end_effector", &end_effector,
                             "Homogeneous matrix of the end effector in the world (4×4), or N×4×4.")
      .def(
          "summary", [](const PyAnswer& a) { return summary(a.answer); },
          "Returns the text that the command prints.")
      .def(
          "to_json", [](const PyAnswer& a) { return to_json(a.answer); },
          "Returns the JSON object that the command prints.")
      .def("to_dict", &to_dict, "Returns the JSON object as a dict.")
      .def("figure", &figure_of, "Returns a figure as an SVG document.")
      .def("__str__", [](const PyAnswer& a) { return summary(a.answer); })
      .def("__repr__", &repr_of_answer)
      .def(py::pickle(&answer_state, &answer_from_state));
  add_effort(answer);
  add_explain(answer);
  add_scenarios(answer);
}

}  // namespace maxwrench::python
