#include "python/src/fields.h"
#include "python/src/parts.h"

namespace maxwrench::python {
template <class Archive>
void fields(Archive& archive, IkCounts& c) {
  archive(c.unreachable, c.most, c.found, c.beyond_limit, c.singular, c.collision, c.incomplete);
}

template <class Archive>
void fields(Archive& archive, CallCount& c) {
  archive(c.method, c.status, c.calls, c.evaluations);
}

namespace {

/// What pickle stores of an answer: the posture, and what its search did.
struct AnswerState {
  PyTask task;
  Case choice;
  RowMatrix given;
  bool given_joints = false, collision = true;
  Verdict verdict;
  std::string unit, stopped;
  long evaluations = 0, undecided = 0;
  std::vector<CallCount> calls;
  IkCounts ik_solutions;
  double wall_s = 0;
};

template <class Archive>
void fields(Archive& archive, AnswerState& s) {
  archive(s.task, s.choice, s.given, s.given_joints, s.collision, s.verdict, s.unit, s.stopped,
          s.evaluations, s.undecided, s.calls, s.ik_solutions, s.wall_s);
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
  AnswerState state;
  state.task = self.task;
  state.choice = a.choice;
  state.given = a.given_joints ? RowMatrix(a.posture.q.transpose()) : RowMatrix(a.trajectory.knots);
  state.given_joints = a.given_joints;
  state.collision = a.collision;
  state.verdict = a;
  state.unit = a.unit;
  state.stopped = a.stopped;
  state.evaluations = a.evaluations;
  state.undecided = a.undecided;
  state.calls = a.calls;
  state.ik_solutions = a.ik_solutions;
  state.wall_s = a.wall_s;
  return pack(state);
}

PyAnswer answer_from_state(const py::tuple& given) {
  const auto state = unpack<AnswerState>(given);
  Answer a = evaluated(*state.task.problem, state.choice, state.given, state.given_joints,
                       state.collision);
  a.choice = state.choice;
  static_cast<Verdict&>(a) = state.verdict;
  a.unit = state.unit;
  a.stopped = state.stopped;
  a.evaluations = state.evaluations;
  a.undecided = state.undecided;
  a.calls = state.calls;
  a.ik_solutions = state.ik_solutions;
  a.wall_s = state.wall_s;
  return {std::move(a), state.task};
}

}  // namespace maxwrench::python
