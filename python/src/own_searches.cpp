#include <pybind11/stl.h>

#include <cmath>

#include "maxwrench/batch.h"
#include "maxwrench/strategies.h"
#include "problems/make/bad_value.h"
#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/parts.h"
#include "python/src/shared_objects.h"

namespace maxwrench::python {
namespace {

/// The objective as a search in Python sees it. It counts, keeps the best point, and ends the
/// search. Its functions are called with the lock.
class PyObjective {
 public:
  PyObjective(Objective& objective, const SearchOptions& options)
      : objective_(objective), options_(options), run_(options) {}

  const Objective& objective() const { return require_alive().objective_; }
  const SearchOptions& options() const { return require_alive().options_; }

  double evaluate(const py::object& theta_r, Eigen::VectorXd* gradient) {
    require_alive();
    const Eigen::VectorXd point = vector("theta_r", theta_r, objective_.dimension());
    require_all_finite("theta_r", point);
    begin(1);
    double value = 0;
    {
      const py::gil_scoped_release released;
      value = run_.evaluate(objective_, clamped(point), gradient);
      run_.add(1);
    }
    keep(clamped(point), value);
    return value;
  }

  py::array evaluate_rows(const py::object& rows) {
    require_alive();
    const RowMatrix points = matrix("theta_r", rows, -1, objective_.dimension());
    require_all_finite("theta_r", points);
    begin(points.rows());
    std::vector<double> values;
    {
      const py::gil_scoped_release released;
      values = evaluate_all(
          objective_, points.rows(), [&](long i) { return clamped(points.row(i)); },
          options_.threads, run_);
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isnan(values[i])) keep(clamped(points.row(Eigen::Index(i))), values[i]);
    }
    return copy(Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(values.data(), values.size())));
  }

  long left() const { return options_.budget - result_.evaluations; }
  SearchResult finish() {
    alive_ = false;
    result_.interrupted = run_.ended();
    return std::move(result_);
  }

 private:
  const PyObjective& require_alive() const {
    if (!alive_) throw BadValue("objective", "one whose search has ended", "the present one");
    return *this;
  }
  /// Ends the search unless `count` more evaluations are allowed.
  void begin(Eigen::Index count) {
    if (count <= left() && !run_.ended()) {
      result_.evaluations += count;
      begun_ = result_.evaluations - count;
      return;
    }
    PyErr_SetString(search_ended().ptr(), run_.interrupted() ? "interrupted" : kBudgetSpent);
    throw py::error_already_set();
  }
  void keep(const Eigen::VectorXd& point, double value) {
    ++begun_;
    if (!(value > result_.value)) return;
    result_.conclude(Status::kBestFound);
    result_.theta_r = point;
    result_.value = value;
    result_.history.push_back({begun_, value});
  }
  /// Methods of others leave the bounds by rounding.
  Eigen::VectorXd clamped(const Eigen::VectorXd& point) const {
    return point.cwiseMax(objective_.lower()).cwiseMin(objective_.upper());
  }

  Objective& objective_;
  const SearchOptions& options_;
  SearchRun run_;
  SearchResult result_;
  long begun_ = 0;
  bool alive_ = true;
};

/// While it lives, the search in this thread can be ended by an exception. Needs the lock.
class Interruptible {
 public:
  Interruptible() : watch_(watch_of_this_thread()), thread_(PyThread_get_thread_ident()) {
    if (watch_) watch_->python_thread = thread_;
  }
  ~Interruptible() {
    if (!watch_) return;
    watch_->python_thread = 0;
    PyThreadState_SetAsyncExc(thread_, nullptr);  // one that came too late
  }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

 private:
  Watch* watch_;
  unsigned long thread_;
};

/// A search that is written in Python.
class PythonSearch : public Search {
 public:
  explicit PythonSearch(Shared search) : search_(std::move(search)) {}

  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    check(options, objective);
    const py::gil_scoped_acquire lock;
    const auto seen = std::make_shared<PyObjective>(objective, options);
    const Interruptible interruptible;
    try {
      search_->attr("maximize")(seen);
    } catch (py::error_already_set& error) {
      if (!error.matches(search_ended())) {
        seen->finish();
        throw;
      }
    }
    return seen->finish();
  }

 private:
  Shared search_;
};

void add_python_search(const py::object& search) {
  const std::string name = attribute_of(search, "name", "");
  const std::string summary = attribute_of(search, "__doc__", "a search in Python");
  SearchEntry entry{name.c_str(), summary.c_str(), flag_of(search, "local"),
                    [shared = share(search)] { return std::make_unique<PythonSearch>(shared); }};
  entry.accepts_starts = flag_of(search, "accepts_starts");
  add_search(entry);
}

py::list points_of(const std::vector<Candidate>& candidates) {
  py::list points;
  for (const Candidate& candidate : candidates) {
    points.append(py::make_tuple(copy(candidate.theta_r), candidate.value));
  }
  return points;
}

void add_objective(py::module_& m) {
  py::class_<PyObjective, std::shared_ptr<PyObjective>>(
      m, "Objective", R"(The function that a search maximises: beta at theta_r, or at stacked knots.

Call it with a point (d); the value is -inf where there is none. The best point counts by itself.
Once the budget is used or the user interrupts, a call ends the search by the exception SearchEnded.

>>> class Middle(maxwrench.Search):
...     name = "middle"
...     def maximize(self, objective):
...         objective((objective.lower + objective.upper) / 2)
>>> maxwrench.add_search(Middle())
>>> maxwrench.solve("planar/force", search="middle").evaluations
1
)")
      .def(
          "__call__", [](PyObjective& o, const py::object& x) { return o.evaluate(x, nullptr); },
          py::arg("theta_r"), "Returns the value at a point theta_r (d).")
      .def("values", &PyObjective::evaluate_rows, py::arg("theta_r"),
           "Returns the values (N) at N points theta_r (N×d), evaluated side by side.")
      .def(
          "value_and_gradient",
          [](PyObjective& o, const py::object& x) {
            Eigen::VectorXd gradient;
            const double value = o.evaluate(x, &gradient);
            return py::make_tuple(value, copy(gradient));
          },
          py::arg("theta_r"),
          "Returns the value at a point theta_r (d) and its exact gradient (d).")
      .def_property_readonly(
          "lower", [](const PyObjective& o) { return copy(o.objective().lower()); },
          "Lower bounds (d).")
      .def_property_readonly(
          "upper", [](const PyObjective& o) { return copy(o.objective().upper()); },
          "Upper bounds (d).")
      .def_property_readonly(
          "dimension", [](const PyObjective& o) { return o.objective().dimension(); }, "d.")
      .def_property_readonly("left", &PyObjective::left, "The number of evaluations left.")
      .def_property_readonly(
          "budget", [](const PyObjective& o) { return o.options().budget; },
          "The number of evaluations in all.")
      .def_property_readonly(
          "seed", [](const PyObjective& o) { return o.options().seed; },
          "The seed of random numbers.")
      .def_property_readonly(
          "start",
          [](const PyObjective& o) -> py::object {
            if (o.options().start.size() == 0) return py::none();
            return copy(o.options().start);
          },
          "The default point (d), or None.")
      .def_property_readonly(
          "starts", [](const PyObjective& o) { return points_of(o.options().starts); },
          "Points and values of an earlier stage, best first.");
}

}  // namespace

void add_own_searches(py::module_& m) {
  search_ended();
  add_objective(m);
  m.def("_add_search", &add_python_search, py::arg("search"));
}

}  // namespace maxwrench::python
