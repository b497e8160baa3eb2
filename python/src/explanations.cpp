#include <fmt/format.h>
#include <pybind11/stl.h>

#include <utility>

#include "maxwrench/explain.h"
#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/fields.h"
#include "python/src/parts.h"

namespace maxwrench::python {

template <class Archive>
void fields(Archive& archive, BindingLimit& l) {
  archive(static_cast<LimitRate&>(l), l.share, l.gain, l.rate_up, l.rate_down, l.up, l.down);
}

namespace {

/// An explanation, and what it explains.
struct PyExplanation {
  Explanation explanation;
  PyAnswer answer;
  double share = 1;  ///< as of `explain`
};

PyExplanation explained(const PyAnswer& answer, double share) {
  Explanation found;
  run_or_interrupt([&] { found = explain(answer.answer, {share}); });
  return {std::move(found), answer, share};
}

std::vector<BindingLimit> of_rates(const std::vector<LimitRate>& rates) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<BindingLimit> limits;
  for (const LimitRate& rate : rates) limits.push_back({rate, kUnknown});
  return limits;
}

std::string repr_of_limit(const BindingLimit& limit) {
  return fmt::format("<Limit {} {}: at {:g} {}, rate {:.5g}>", limit.name, to_string(limit.side),
                     limit.limit, limit.unit, limit.rate);
}

std::string repr_of_explanation(const PyExplanation& self) {
  const Explanation& e = self.explanation;
  const std::string name = self.answer.task.problem->name;
  if (!e.missing.empty()) return fmt::format("<Explanation {}: {}>", name, e.missing);
  if (!e.instants.empty()) {
    return fmt::format("<Explanation {}: limits bind at {} instants>", name, e.instants.size());
  }
  return fmt::format("<Explanation {}: {:.6g} {}, {} limits bind>", name, e.beta, e.unit,
                     e.limits.size());
}

py::dict budget_of(const PyExplanation& self) {
  const ValueBudget& budget = self.explanation.budget;
  py::dict parts;
  for (const BindingLimit& limit : self.explanation.limits) {
    parts[py::str(limit.name + " " + to_string(limit.side))] = limit.share;
  }
  parts["weight"] = budget.weight;
  parts["buoyancy"] = budget.buoyancy;
  parts["trim"] = budget.trim;
  parts["other"] = budget.other;
  return parts;
}

py::object least_efforts(const PyExplanation& self) {
  const LeastEfforts& efforts = self.explanation.efforts;
  if (!efforts.missing.empty()) return py::none();
  return copy(efforts.u);
}

py::dict missing_of(const PyExplanation& self) {
  const Explanation& e = self.explanation;
  py::dict why;
  why["limits"] = e.missing;
  why["ranges"] = e.ranges_missing;
  why["best"] = e.best.missing;
  why["u"] = e.efforts.missing;
  return why;
}

py::list instants_of(const PyExplanation& self) {
  py::list list;
  for (const InstantLimits& instant : self.explanation.instants) {
    list.append(py::make_tuple(instant.t, of_rates(instant.limits)));
  }
  return list;
}

constexpr const char* kExplain = R"(Says which limits determine the value.

Args:
    share: the share of the wrench that the least efforts hold, from 0 to 1.

Returns:
    Explanation: the limits with their multipliers and ranges, the value as a sum, the rates with
    the posture optimised again, and the least efforts.

Raises:
    InputError: the share is not from 0 to 1.

>>> answer = maxwrench.evaluate("uvms/lift", maxwrench.load("uvms/lift").theta_r_default)
>>> for limit in answer.explain().limits:
...     print(limit.name, limit.side, round(limit.rate, 5), round(limit.down, 5))
front_right_vertical min -0.3841 1.48353
front_left_vertical min -0.3841 1.48353
)";

void add_limit(py::module_& m) {
  py::class_<BindingLimit> limit(m, "Limit", R"(A limit that determines a value; NaN: not known.

>>> limit = maxwrench.evaluate("planar/force", [0, 0]).explain().limits[0]
>>> limit.name, limit.side, limit.limit, limit.unit, round(limit.rate, 5)
('front_left', 'max', 1.0, 'N', 1.15534)
)");
  limit
      .def_readonly("name", &BindingLimit::name,
                    "Name of the actuator, coordinate of theta_r, pair of bodies or force.")
      .def_readonly("unit", &BindingLimit::unit, "Unit of the limit.")
      .def_property_readonly(
          "side", [](const BindingLimit& l) { return to_string(l.side); },
          "min or max; smaller: the smaller of both absolute limits.")
      .def_readonly("limit", &BindingLimit::limit, "The limit [unit].")
      .def_readonly("rate", &BindingLimit::rate, "The multiplier, d value/d limit.")
      .def_readonly("share", &BindingLimit::share, "rate * limit: its part of the value.")
      .def_readonly("gain", &BindingLimit::gain,
                    "Growth of the value if this limit alone moves outward by 10 %.")
      .def_readonly("rate_up", &BindingLimit::rate_up, "The derivative for a rising limit.")
      .def_readonly("rate_down", &BindingLimit::rate_down, "The derivative for a falling limit.")
      .def_readonly("up", &BindingLimit::up, "How far the limit may rise at rate_up [unit].")
      .def_readonly("down", &BindingLimit::down, "How far it may fall at rate_down [unit].")
      .def("__repr__", &repr_of_limit)
      .def(py::pickle(&pack<BindingLimit>, &unpack<BindingLimit>));
}

}  // namespace

void add_explanations(py::module_& m) {
  add_limit(m);
  py::class_<PyExplanation>(m, "Explanation", R"(What binds: the limits that determine a value.

>>> explanation = maxwrench.evaluate("planar/force", [0, 0]).explain()
>>> [limit.name for limit in explanation.limits]
['front_left', 'rear_right']
>>> round(sum(explanation.budget.values()) / explanation.beta, 9)
1.0
)")
      .def_property_readonly(
          "beta", [](const PyExplanation& e) { return e.explanation.beta; },
          "The value [unit]; NaN: there is none.")
      .def_property_readonly(
          "unit", [](const PyExplanation& e) { return e.explanation.unit; },
          "The unit of the value.")
      .def_property_readonly(
          "scenario", [](const PyExplanation& e) { return e.explanation.scenario; },
          "Of a list of scenarios, the one that decides; empty: the task has no list.")
      .def_property_readonly(
          "limits", [](const PyExplanation& e) { return e.explanation.limits; },
          "The limits that bind at the posture, those with the largest gain first.")
      .def_property_readonly(
          "kink", [](const PyExplanation& e) { return e.explanation.kink; },
          "Whether rates of rising and falling limits differ.")
      .def_property_readonly("budget", &budget_of,
                             "The value as a sum: the share of each limit and load, by name.")
      .def_property_readonly(
          "best", [](const PyExplanation& e) { return of_rates(e.explanation.best.limits); },
          "The limits at a best posture, with rates for which the posture is optimised again.")
      .def_property_readonly("u", &least_efforts,
                             "The least efforts (m) [N or N m]; None: there are none.")
      .def_property_readonly("instants", &instants_of,
                             "Of a task in time: pairs of an instant [s] and its limits.")
      .def_property_readonly("missing", &missing_of,
                             "Why limits, ranges, best or u are not known; empty: they are.")
      .def_property_readonly(
          "task", [](const PyExplanation& e) { return e.answer.task; }, "The Task.")
      .def(
          "summary", [](const PyExplanation& e) { return summary(e.explanation); },
          "Returns the text that the command prints.")
      .def(
          "to_dict",
          [](const PyExplanation& e) {
            return py::dict(py::module_::import("json").attr("loads")(to_json(e.explanation)));
          },
          "Returns the JSON object of the command as a dict.")
      .def("__str__", [](const PyExplanation& e) { return summary(e.explanation); })
      .def("__repr__", &repr_of_explanation)
      .def(py::pickle([](const PyExplanation& e) { return py::make_tuple(e.answer, e.share); },
                      [](const py::tuple& state) {
                        return explained(state[0].cast<PyAnswer>(), state[1].cast<double>());
                      }));
}

void add_explain(py::class_<PyAnswer>& answer) {
  answer.def("explain", &explained, py::kw_only(), py::arg("share") = 1.0, kExplain);
}

}  // namespace maxwrench::python
