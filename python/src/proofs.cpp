#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>
#include <filesystem>
#include <optional>

#include "maxwrench/certify.h"
#include "maxwrench/load.h"
#include "maxwrench/trajectory_proof.h"
#include "problems/loader/bad_input.h"
#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/fields.h"
#include "python/src/parts.h"
#include "python/src/words.h"

namespace maxwrench::python {

template <class Archive>
void fields(Archive& archive, VerifiedProof& p) {
  archive(p.rejection, p.boxes, p.by_multiplier, p.by_collision, p.by_equations, p.by_parent,
          p.ceiling, p.version, p.problem, p.measure, p.wrench, p.collision, p.unit, p.theta_r,
          p.value, p.bound, p.seconds);
}

namespace {

/// A proof, with the task that it was asked of.
struct PyProof {
  Proof proof;
  PyTask task;
};

template <class Archive>
void fields(Archive& archive, PyProof& self) {
  Proof& p = self.proof;
  PyAnswer answer{p.answer, self.task};
  archive(answer, self.task, static_cast<Verdict&>(p), p.bound, p.search, p.boxes, p.colliding,
          p.search_s, p.seconds);
  archive.bytes(p.certificate);
  p.answer = std::move(answer.answer);
}

py::object certify_task(const py::object& task, const py::object& theta_r, double gap,
                        double seconds, const std::string& measure, const std::string& wrench,
                        const std::string& search, std::uint64_t seed, long budget, int threads,
                        const py::object& callback) {
  const PyTask of = task_of(task);
  Options options;
  options.measure = measure;
  options.wrench = parse_wrench(wrench);
  options.search = search;
  options.seed = seed;
  options.budget = budget;
  options.threads = threads;
  if (of.problem->motion) {
    if (gap != ProofOptions().gap && !theta_r.is_none()) {
      throw BadValue("gap", shown(gap), "no such argument of a task in time with theta_r");
    }
    if (seconds != ProofOptions().seconds && !theta_r.is_none()) {
      throw BadValue("seconds", shown(seconds), "no such argument of a task in time with theta_r");
    }
    return certify_motion(of, theta_r, options, {.gap = gap, .seconds = seconds}, callback);
  }
  if (!theta_r.is_none()) {
    throw BadValue("theta_r", "an array", "None: " + of.problem->name + " is a static task");
  }
  ProofOptions how;
  how.gap = gap;
  how.seconds = seconds;
  how.keep_certificate = why_no_certificate(*of.problem, options.wrench).empty();
  PyProof result{{}, of};
  const Callback shown(callback, 0, of.problem->name);
  run_in_background(shown.function(), [&](Watch& watch) {
    watch_over(watch, options);
    result.proof = certify(*of.problem, options, how);
  });
  return py::cast(std::move(result));
}

void save(const PyProof& self, const py::object& path) {
  const std::string file = path_in("path", path);
  if (self.proof.certificate.empty()) {
    throw BadValue("proof", "no certificate",
                   "one of a task without contact forces and currents, with a value");
  }
  py::module_::import("maxwrench._files")
      .attr("write_bytes")(file, py::bytes(self.proof.certificate));
}

/// What ``status``, ``beta`` and the others say, for tables and files.
py::dict dict_of_proof(const PyProof& self) {
  const Proof& proof = self.proof;
  const auto number = [](double value) -> py::object {
    if (!std::isfinite(value)) return py::none();
    return py::float_(value);
  };
  py::dict parts;
  parts["problem"] = self.task.problem->name;
  parts["status"] = to_string(proof.status);
  parts["reason"] = proof.reason.str();
  parts["unit"] = proof.answer.unit;
  parts["beta"] = proof.answer.has_value() ? number(proof.answer.beta()) : py::none();
  parts["bound"] = number(proof.bound);
  parts["gap"] = number(proof.gap());
  parts["theta_r"] = py::none();
  if (proof.answer.has_posture()) {
    const Eigen::VectorXd& theta_r = proof.answer.posture.theta_r;
    parts["theta_r"] = std::vector<double>(theta_r.begin(), theta_r.end());
  }
  parts["boxes"] = proof.boxes;
  parts["colliding"] = proof.colliding;
  parts["seconds"] = proof.seconds;
  return parts;
}

py::object verify_file(const py::object& path, const py::object& task, int threads) {
  const std::string file = path_in("path", path);
  open_file(file, "a certificate");
  std::optional<Problem> given;
  if (!task.is_none()) given = *task_of(task).problem;
  if (is_trajectory_certificate(std::filesystem::path(file))) {
    return verify_motion(file, given, threads);
  }
  VerifiedProof result;
  run_or_interrupt([&] {
    result = verify_certificate(
        file, [&](const std::string& name) { return given ? *given : load_problem(name); },
        threads);
  });
  return py::cast(std::move(result));
}

std::string repr_of_proof(const PyProof& self) {
  const Proof& proof = self.proof;
  return fmt::format(
      "<Proof {}: {}, {:.6g} to {:.6g} {}>", self.task.problem->name, to_string(proof.status),
      proof.answer.has_value() ? proof.answer.beta() : -kInfinity, proof.bound, proof.answer.unit);
}

constexpr const char* kCertify =
    R"(Searches for the best posture, and proves how much larger a value can be. For a task in time:
proves what a trajectory exerts at every instant, and without theta_r also what none exceeds.

Args:
    task: a Task, or the name of one.
    theta_r: for a task in time, as of ``evaluate``; None: the trajectory that a search finds.
    gap: the proof of a bound ends once bound - beta is at most this share of beta; at least 1e-8.
    seconds: the time limit of that proof, after the search [s].
    measure: "linf_polytope", "l2_polytope" or "ellipsoid"; for a task in time the first.
    wrench, search, seed, budget, threads, callback: as of ``solve``.

Returns:
    Proof: the best posture and the bound. TrajectoryProof: that of a task in time.

Raises:
    InputError: the task is not supported, or as ``solve``.

>>> proof = maxwrench.certify("planar/force", gap=1e-3)
>>> proof.status, proof.gap <= 1e-3
('proven', True)
)";

}  // namespace

void add_proofs(py::module_& m) {
  py::class_<PyProof>(m, "Proof", R"(A proof of the largest capability, made by ``certify``.

>>> proof = maxwrench.certify("planar/force")
>>> proof.status, proof.beta <= proof.bound
('proven', True)
)")
      .def_property_readonly(
          "status", [](const PyProof& p) { return to_string(p.proof.status); },
          "proven: the gap is as requested; bracket: the bound holds, but the gap is larger.")
      .def_property_readonly(
          "reason", [](const PyProof& p) { return p.proof.reason.str(); },
          "Which limit ended a proof that is a bracket.")
      .def_property_readonly(
          "answer",
          [](const PyProof& p) {
            return PyAnswer{p.proof.answer, p.task};
          },
          "The Answer of the best posture known.")
      .def_property_readonly(
          "beta",
          [](const PyProof& p) {
            return p.proof.answer.has_value() ? p.proof.answer.beta()
                                              : std::numeric_limits<double>::quiet_NaN();
          },
          "Its value; NaN: there is none.")
      .def_property_readonly(
          "bound", [](const PyProof& p) { return p.proof.bound; },
          "No posture within the limits has a larger value; infinite: none is proven.")
      .def_property_readonly(
          "gap", [](const PyProof& p) { return p.proof.gap(); }, "(bound - beta)/|beta|.")
      .def_property_readonly(
          "boxes", [](const PyProof& p) { return p.proof.boxes; },
          "The number of boxes of theta_r that were bounded.")
      .def_property_readonly(
          "colliding", [](const PyProof& p) { return p.proof.colliding; },
          "The number of these in which every posture collides.")
      .def_property_readonly(
          "seconds", [](const PyProof& p) { return p.proof.seconds; },
          "Wall time of the proof after the search [s].")
      .def("save", &save, py::arg("path"),
           "Writes the certificate to the file path; ``verify`` and the command check it with "
           "independent code.")
      .def_property_readonly(
          "task", [](const PyProof& p) { return p.task; }, "The Task.")
      .def("to_dict", &dict_of_proof,
           "Returns all of these by name; None where a number is not finite.")
      .def("__repr__", &repr_of_proof)
      .def(py::pickle(&pack<PyProof>, &unpack<PyProof>));
  py::class_<VerifiedProof>(m, "VerifiedProof", R"(The result of ``verify``. True if verified.

>>> maxwrench.certify("planar/force").save("force.cert")
>>> checked = maxwrench.verify("force.cert")
>>> bool(checked), checked.problem, checked.beta <= checked.bound
(True, 'planar/force', True)
)")
      .def_property_readonly(
          "verified", [](const VerifiedProof& v) { return v.rejection.empty(); },
          "Whether the certificate proves its claims.")
      .def_readonly("rejection", &VerifiedProof::rejection, "Why not; empty if it does.")
      .def_readonly("problem", &VerifiedProof::problem, "The name of the task.")
      .def_readonly("measure", &VerifiedProof::measure, "The measure.")
      .def_readonly("beta", &VerifiedProof::value, "The value of the posture.")
      .def_readonly("bound", &VerifiedProof::bound, "No posture has a larger value.")
      .def_readonly("unit", &VerifiedProof::unit, "The unit of both.")
      .def_readonly("boxes", &VerifiedProof::boxes, "The number of boxes that were checked.")
      .def_property_readonly(
          "theta_r", [](const VerifiedProof& v) { return copy(v.theta_r); }, "The posture (r).")
      .def("__bool__", [](const VerifiedProof& v) { return v.rejection.empty(); })
      .def("__repr__",
           [](const VerifiedProof& v) {
             return fmt::format("<VerifiedProof {}: {}>", v.problem,
                                v.rejection.empty() ? "verified" : "rejected: " + v.rejection);
           })
      .def(py::pickle(&pack<VerifiedProof>, &unpack<VerifiedProof>));
  m.def("certify", &certify_task, py::arg("task"), py::arg("theta_r") = py::none(), py::kw_only(),
        py::arg("gap") = 1e-3, py::arg("seconds") = 60.0, py::arg("measure") = Case().measure,
        py::arg("wrench") = "pure", py::arg("search") = "", py::arg("seed") = 1,
        py::arg("budget") = 0, py::arg("threads") = 0, py::arg("callback") = py::none(), kCertify);
  m.def("verify", &verify_file, py::arg("path"), py::arg("task") = py::none(), py::kw_only(),
        py::arg("threads") = 0,
        R"(Checks a certificate with code that is independent of the code that wrote it.

Args:
    path: a file that ``Proof.save`` or ``maxwrench certify --certificate`` wrote.
    task: the Task or its name; None: the one that the certificate names.
    threads: as of ``solve``.

Returns:
    VerifiedProof: the claims, and whether they are proven. VerifiedTrajectory: those of a
    trajectory.

Raises:
    InputError: the file is missing, damaged or no certificate.

>>> maxwrench.certify("planar/force").save("force.cert")
>>> maxwrench.verify("force.cert").verified
True
)");
}

}  // namespace maxwrench::python
