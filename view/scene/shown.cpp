#include "solvers/solve/format.h"
#include "view/scene/parts.h"
#include "view/scene/scene.h"

namespace maxwrench {

nlohmann::ordered_json shown_json(const Shown& shown, std::size_t most_sets) {
  const Answer& answer = shown.answer;
  const Reason& collision = answer.trajectory.collision;
  nlohmann::ordered_json object;
  object["name"] = shown.name;
  object["status"] = to_string(answer.status);
  object["reason"] = known(!answer.reason.empty(), answer.reason.str());
  object["collision"] = known(!collision.empty(), collision.str());
  object["beta"] = known(answer.has_value(), answer.beta());
  object["unit"] = answer.unit;
  object["search"] = known(!answer.choice.search.empty(), answer.choice.search);
  object["evaluations"] = answer.evaluations;
  if (answer.task->motion) object["knots"] = rows(answer.trajectory.knots);
  object["frames"] = frames_json(answer, most_sets);
  object["explanation"] = explanation_json(answer);
  object["scenarios"] = scenarios_json(answer);
  return object;
}

}  // namespace maxwrench
