#include <pybind11/stl.h>

#include "python/src/arrays.h"
#include "python/src/parts.h"

namespace maxwrench::python {
namespace {

py::tuple state_of(const IkCounts& c) {
  return py::make_tuple(c.unreachable, c.most, c.found, c.beyond_limit, c.singular, c.collision,
                        c.incomplete);
}

IkCounts counts_of(const py::tuple& state) {
  const auto number = [&state](int i) { return state[std::size_t(i)].cast<long>(); };
  return {number(0), number(1), number(2), number(3), number(4), number(5), number(6)};
}

py::tuple state_of(const Case& c) {
  return py::make_tuple(c.problem, c.measure, to_string(c.wrench), c.solver, c.search, c.seed,
                        c.budget, c.scheme);
}

Case case_of(const py::tuple& state) {
  Case c;
  c.problem = state[0].cast<std::string>();
  c.measure = state[1].cast<std::string>();
  c.wrench = parse_wrench(state[2].cast<std::string>());
  c.solver = state[3].cast<std::string>();
  c.search = state[4].cast<std::string>();
  c.seed = state[5].cast<std::uint64_t>();
  c.budget = state[6].cast<long>();
  c.scheme = state[7].cast<std::string>();
  return c;
}

py::list state_of(const std::vector<CallCount>& calls) {
  py::list list;
  for (const CallCount& call : calls) {
    list.append(py::make_tuple(call.method, call.status, call.calls, call.evaluations));
  }
  return list;
}

std::vector<CallCount> calls_of(const py::list& state) {
  std::vector<CallCount> calls;
  for (const py::handle& item : state) {
    const auto call = item.cast<py::tuple>();
    calls.push_back({call[0].cast<std::string>(), call[1].cast<std::string>(), call[2].cast<long>(),
                     call[3].cast<long>()});
  }
  return calls;
}

/// The answer of a posture or trajectory, without what its search did.
Answer evaluated(const Problem& task, const Case& choice, const RowMatrix& given, bool given_joints,
                 bool collision) {
  if (given.size() == 0) {
    Answer answer;
    answer.task = std::make_shared<const Problem>(task);
    return answer;
  }
  Options options;
  static_cast<Case&>(options) = choice;
  options.check_collision = collision;
  if (given_joints) return evaluate_posture(task, given.row(0), options);
  return evaluate(task, given, options);
}

}  // namespace

py::tuple answer_state(const PyAnswer& self) {
  const Answer& a = self.answer;
  const RowMatrix given =
      a.given_joints ? RowMatrix(a.posture.q.transpose()) : RowMatrix(a.trajectory.knots);
  return py::make_tuple(self.task, state_of(a.choice), copy(given), a.given_joints, a.collision,
                        static_cast<int>(a.status), a.reason.str(), a.unit, a.evaluations,
                        state_of(a.calls), a.stopped, a.undecided, state_of(a.ik_solutions),
                        a.wall_s);
}

PyAnswer answer_from_state(const py::tuple& state) {
  const auto task = state[0].cast<PyTask>();
  const Case choice = case_of(state[1]);
  const RowMatrix given = matrix("knots", state[2]);
  Answer a = evaluated(*task.problem, choice, given, state[3].cast<bool>(), state[4].cast<bool>());
  a.choice = choice;
  a.conclude(static_cast<Status>(state[5].cast<int>()), state[6].cast<std::string>());
  a.unit = state[7].cast<std::string>();
  a.evaluations = state[8].cast<long>();
  a.calls = calls_of(state[9]);
  a.stopped = state[10].cast<std::string>();
  a.undecided = state[11].cast<long>();
  a.ik_solutions = counts_of(state[12]);
  a.wall_s = state[13].cast<double>();
  return {std::move(a), task};
}

}  // namespace maxwrench::python
