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

/// What a search did, and what it found.
template <class Archive>
void search_fields(Archive& archive, Answer& a) {
  archive(static_cast<Verdict&>(a), a.unit, a.stopped, a.evaluations, a.undecided, a.calls,
          a.ik_solutions, a.wall_s);
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
  PyTask task = self.task;
  Answer a = self.answer;
  RowMatrix given =
      a.given_joints ? RowMatrix(a.posture.q.transpose()) : RowMatrix(a.trajectory.knots);
  Packer packer;
  packer(task, a.choice, given, a.given_joints, a.collision);
  search_fields(packer, a);
  return packer.state();
}

PyAnswer answer_from_state(const py::tuple& state) {
  PyTask task;
  Case choice;
  RowMatrix given;
  bool given_joints = false, collision = true;
  Unpacker unpacker(state);
  unpacker(task, choice, given, given_joints, collision);
  Answer a = evaluated(*task.problem, choice, given, given_joints, collision);
  a.choice = choice;
  search_fields(unpacker, a);
  return {std::move(a), std::move(task)};
}

}  // namespace maxwrench::python
