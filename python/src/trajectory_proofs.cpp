#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "maxwrench/load.h"
#include "maxwrench/plan_bound.h"
#include "maxwrench/trajectory_proof.h"
#include "problems/make/bad_value.h"
#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/fields.h"
#include "python/src/parts.h"
#include "python/src/words.h"
#include "solvers/certify/certify.h"

namespace maxwrench::python {

template <class Archive>
void fields(Archive& archive, VerifiedTrajectory& v) {
  archive(v.rejection, v.t, v.slices, v.places, v.clearance, v.version, v.problem, v.collision,
          v.unit, v.knots, v.guaranteed, v.decides, v.scenarios, v.t_h, v.parts, v.seconds);
}

namespace {

/// A proof in time, with the task that it was asked of.
struct PyTrajectoryProof {
  TrajectoryProof proof;
  PyTask task;
  double bound = std::numeric_limits<double>::quiet_NaN();  ///< of all trajectories

  double gap() const { return (bound - proof.answer.beta()) / std::abs(proof.answer.beta()); }
};

template <class Archive>
void fields(Archive& archive, PyTrajectoryProof& self) {
  TrajectoryProof& p = self.proof;
  PyAnswer answer{p.answer, self.task};
  archive(answer, self.task, static_cast<Verdict&>(p), p.guaranteed, p.t, p.decides, p.scenarios,
          p.parts, p.slices, p.clearance, p.seconds, self.bound);
  archive.bytes(p.certificate);
  p.answer = std::move(answer.answer);
}

/// The name of a scenario; None without a list.
std::optional<std::string> name_or_none(const std::string& scenario) {
  return scenario.empty() ? std::nullopt : std::optional(scenario);
}

/// What no trajectory exceeds; NaN for tasks that have no such bound.
double bound_beside(const TrajectoryProof& proof, const Problem& problem, const Options& options,
                    const ProofOptions& how) {
  const Eigen::MatrixXd& knots = proof.answer.trajectory.knots;
  if (knots.size() == 0 || !why_no_trajectory_bound(problem, options).empty()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  Options own = options;
  own.search = "";  // the trajectory is given
  return bound_trajectories(problem, own, how, knots).bound;
}

void save_trajectory_proof(const PyTrajectoryProof& self, const py::object& path) {
  const std::string file = path_in("path", path);
  if (self.proof.certificate.empty()) {
    throw BadValue("proof", "no certificate", "one of a trajectory that is proven");
  }
  py::module_::import("maxwrench._files")
      .attr("write_bytes")(file, py::bytes(self.proof.certificate));
}

std::string repr_of_trajectory_proof(const PyTrajectoryProof& self) {
  const TrajectoryProof& proof = self.proof;
  const std::string& name = self.task.problem->name;
  if (proof.status != Status::kProven) {
    return fmt::format("<TrajectoryProof {}: {}, {}>", name, to_string(proof.status),
                       proof.reason.str());
  }
  return fmt::format("<TrajectoryProof {}: {:.6g} {} {}>", name, proof.guaranteed,
                     proof.answer.unit,
                     self.task.problem->motion->impulse ? "at the peak" : "at every instant");
}

}  // namespace

py::object certify_motion(const PyTask& task, const py::object& theta_r, const Options& options,
                          const ProofOptions& limits, const py::object& callback) {
  TrajectoryProofOptions how;
  how.keep_certificate = true;
  PyTrajectoryProof result{{}, task};
  const Problem& problem = *task.problem;
  Eigen::MatrixXd knots;
  if (!theta_r.is_none()) {
    knots = knots_in(numbers("theta_r", theta_r), problem);
    if (knots.rows() != knots_of(problem)) knots = constant_knots(problem, stacked(knots));
  }
  CertifyOptions of_bound;
  of_bound.gap = limits.gap;
  of_bound.seconds = limits.seconds;
  require_valid(of_bound);
  Options own = options;
  const Callback shown(callback, options.budget, problem.name);
  run_in_background(shown.function(), [&](Watch& watch) {
    watch_over(watch, own);
    result.proof = knots.size() > 0 ? certify_trajectory(problem, knots, own, how)
                                    : solve_proven(problem, own, how);
    if (knots.size() == 0) result.bound = bound_beside(result.proof, problem, own, limits);
  });
  return py::cast(std::move(result));
}

py::object verify_motion(const std::string& file, const std::optional<Problem>& given,
                         int threads) {
  VerifiedTrajectory result;
  run_or_interrupt([&] {
    result = verify_trajectory_certificate(
        file, [&](const std::string& name) { return given ? *given : load_problem(name); },
        threads);
  });
  return py::cast(std::move(result));
}

void add_trajectory_proofs(py::module_& m) {
  py::class_<PyTrajectoryProof>(
      m, "TrajectoryProof",
      R"(A proof of what a trajectory exerts at every instant, made by ``certify``.

>>> motion = maxwrench.load("planar/trajectory")
>>> proof = maxwrench.certify(motion, motion.theta_r_default)
>>> proof.status, proof.guaranteed <= proof.answer.beta
('proven', True)
)")
      .def_property_readonly(
          "status", [](const PyTrajectoryProof& p) { return to_string(p.proof.status); },
          "proven, or why not: invalid_posture, infeasible or numerical_error.")
      .def_property_readonly(
          "reason", [](const PyTrajectoryProof& p) { return p.proof.reason.str(); },
          "What is violated, and when; empty if it is proven.")
      .def_property_readonly(
          "answer",
          [](const PyTrajectoryProof& p) {
            return PyAnswer{p.proof.answer, p.task};
          },
          "The Answer of the trajectory.")
      .def_property_readonly(
          "guaranteed", [](const PyTrajectoryProof& p) { return p.proof.guaranteed; },
          "The wrench along c that is proven at every instant, of an impulse at its peak; NaN: "
          "none.")
      .def_property_readonly(
          "t", [](const PyTrajectoryProof& p) { return p.proof.t; },
          "The instant of the reason [s]; NaN: none.")
      .def_property_readonly(
          "decides", [](const PyTrajectoryProof& p) { return name_or_none(p.proof.decides); },
          "Of a list, the scenario with the least proven factor, or the one without a proof; None "
          "without a list.")
      .def_property_readonly(
          "scenarios", [](const PyTrajectoryProof& p) { return p.proof.scenarios; },
          "The number of proven scenarios of a list; 0: there is no list.")
      .def_property_readonly(
          "searched", [](const PyTrajectoryProof& p) { return p.proof.searched; },
          "What the first search found, between knots, if another trajectory is the proven one; "
          "NaN: "
          "it is the proven one, or it was given.")
      .def_property_readonly(
          "rejection", [](const PyTrajectoryProof& p) { return p.proof.rejection; },
          "Why the trajectory of ``searched`` is not proven; empty if there is none.")
      .def_property_readonly(
          "held", [](const PyTrajectoryProof& p) { return p.proof.held; },
          "Whether the trajectory is the default posture, held, because more was proven of no "
          "other.")
      .def_readonly("bound", &PyTrajectoryProof::bound,
                    "What no trajectory of the task exceeds; NaN: it was given, or there is none.")
      .def_property_readonly("gap", &PyTrajectoryProof::gap,
                             "(bound - beta)/|beta|, beta that of ``answer``; NaN: no bound.")
      .def_property_readonly(
          "slices", [](const PyTrajectoryProof& p) { return p.proof.slices; },
          "The number of slices of time on which the efforts were enclosed.")
      .def_property_readonly(
          "clearance", [](const PyTrajectoryProof& p) { return p.proof.clearance; },
          "No bodies are closer than their margin plus this [m].")
      .def_property_readonly(
          "seconds", [](const PyTrajectoryProof& p) { return p.proof.seconds; },
          "Wall time of the proof [s].")
      .def("save", &save_trajectory_proof, py::arg("path"),
           "Writes the certificate to the file path; ``verify`` and the command check it with "
           "independent code.")
      .def("__repr__", &repr_of_trajectory_proof)
      .def(py::pickle(&pack<PyTrajectoryProof>, &unpack<PyTrajectoryProof>));
  py::class_<VerifiedTrajectory>(
      m, "VerifiedTrajectory",
      R"(The result of ``verify`` for a certificate of a trajectory. True if verified.

>>> motion = maxwrench.load("planar/trajectory")
>>> maxwrench.certify(motion, motion.theta_r_default).save("motion.cert")
>>> maxwrench.verify("motion.cert").verified
True
)")
      .def_property_readonly(
          "verified", [](const VerifiedTrajectory& v) { return v.verified(); },
          "Whether the certificate proves its claims.")
      .def_readonly("rejection", &VerifiedTrajectory::rejection, "Why not; empty if it does.")
      .def_readonly("problem", &VerifiedTrajectory::problem, "The name of the task.")
      .def_readonly(
          "guaranteed", &VerifiedTrajectory::guaranteed,
          "The wrench along c that is exerted at every instant, in an impulse at its peak.")
      .def_readonly("unit", &VerifiedTrajectory::unit, "Its unit.")
      .def_property_readonly(
          "decides", [](const VerifiedTrajectory& v) { return name_or_none(v.decides); },
          "Of a list, the scenario with the least factor; None without a list.")
      .def_readonly("scenarios", &VerifiedTrajectory::scenarios,
                    "The number of scenarios of a list; 0: there is no list.")
      .def_readonly("slices", &VerifiedTrajectory::slices,
                    "The number of slices of time that were checked.")
      .def_readonly("clearance", &VerifiedTrajectory::clearance,
                    "No bodies are closer than their margin plus this [m].")
      .def_property_readonly(
          "knots", [](const VerifiedTrajectory& v) { return copy(RowMatrix(v.knots)); },
          "The knots (k×r).")
      .def("__bool__", [](const VerifiedTrajectory& v) { return v.verified(); })
      .def("__repr__",
           [](const VerifiedTrajectory& v) {
             return fmt::format("<VerifiedTrajectory {}: {}>", v.problem,
                                v.verified() ? "verified" : "rejected: " + v.rejection);
           })
      .def(py::pickle(&pack<VerifiedTrajectory>, &unpack<VerifiedTrajectory>));
}

}  // namespace maxwrench::python
