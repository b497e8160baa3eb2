#include "view/engine/engine.h"

#include <algorithm>
#include <stdexcept>

#include "maxwrench/strategies.h"
#include "solvers/solve/format.h"
#include "solvers/solve/method.h"
#include "view/engine/evaluator.h"
#include "view/engine/problem_data.h"
#include "view/scene/parts.h"
#include "view/scene/scene.h"

namespace maxwrench {
namespace {

/// A named part of a result: numbers or texts.
struct Field {
  const char* name;
  char kind;
  Eigen::VectorXd numbers;
  std::vector<std::string> texts;
};

/// All that the module holds.
struct Engine {
  std::unique_ptr<TaskEvaluator> task;
  std::vector<Field> fields;
  std::string error;
};

Engine& engine() {
  static Engine only;
  return only;
}

const Field& field_at(int i) { return engine().fields[static_cast<std::size_t>(i)]; }

void show(const char* name, double value) {
  engine().fields.push_back({name, 'n', Eigen::VectorXd::Constant(1, value), {}});
}
void show(const char* name, const Eigen::VectorXd& values) {
  engine().fields.push_back({name, 'N', values, {}});
}
void show(const char* name, const std::string& text) {
  engine().fields.push_back({name, 't', {}, {text}});
}
void show(const char* name, std::vector<std::string> texts) {
  engine().fields.push_back({name, 'T', {}, std::move(texts)});
}

/// Calls a function with no fields left. Returns the line of what it throws, or null.
template <class Function>
const char* line_of_error(Function&& function) {
  engine().fields.clear();
  try {
    function();
    return nullptr;
  } catch (const std::exception& thrown) {
    engine().error = thrown.what();
  }
  engine().fields.clear();
  return engine().error.c_str();
}

TaskEvaluator& loaded_task() {
  if (!engine().task) throw std::invalid_argument("engine: got no task, expected load before");
  return *engine().task;
}

nlohmann::ordered_json part_json(const Answer& answer, const std::string& part, int instant) {
  if (part == "shown") return shown_json({"own", answer}, 0);
  if (part == "explanation") return explanation_json(answer);
  if (part == "scenarios") return scenarios_json(answer);
  if (part != "sets") {
    throw std::invalid_argument("part: got '" + part +
                                "', expected shown, sets, explanation or scenarios");
  }
  const auto instants = static_cast<int>(answer.trajectory.instants.size());
  if (instant < 0 || instant >= instants) {
    throw std::invalid_argument("instant: got " + std::to_string(instant) + ", expected 0 to " +
                                std::to_string(instants - 1));
  }
  return sets_json(answer, static_cast<std::size_t>(instant));
}

bool supports(const Problem& problem, const char* measure, Wrench wrench) {
  if (problem.motion) return measure == Case().measure;
  try {
    Case c;
    c.measure = measure;
    c.wrench = wrench;
    resolve_lower_level(problem, c).make_measure();
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

/// Shows the measures that support the task, and whether they support any wrench.
void show_measures(const Problem& problem) {
  std::vector<std::string> names, summaries, units;
  std::vector<double> any;
  for (const MeasureEntry& entry : measures()) {
    if (!supports(problem, entry.name, Wrench::kPure)) continue;
    names.emplace_back(entry.name);
    summaries.emplace_back(entry.summary);
    units.emplace_back(entry.unit ? entry.unit : problem.unit());
    any.push_back(supports(problem, entry.name, Wrench::kAny) ? 1 : 0);
  }
  show("measure_names", names);
  show("measure_summaries", summaries);
  show("measure_units", units);
  show("measure_any", Eigen::Map<const Eigen::VectorXd>(any.data(), std::ssize(any)));
}

void show_theta_r(const Problem& problem) {
  std::vector<std::string> names, units;
  for (int i = 0; i < problem.redundancy(); ++i) {
    names.push_back(problem.theta_r_name(i));
    units.emplace_back(problem.theta_r_unit(i));
  }
  show("theta_r_names", names);
  show("theta_r_units", units);
  show("theta_r_min", problem.theta_r_min);
  show("theta_r_max", problem.theta_r_max);
  show("theta_r_default", problem.theta_r_default);
}

void show_robot(const Robot& robot) {
  std::vector<std::string> joints, actuators, links;
  const auto count = static_cast<Eigen::Index>(robot.joints.size());
  Eigen::VectorXd q_min(count), q_max(count);
  for (const Thruster& thruster : robot.thrusters) actuators.push_back(thruster.name);
  for (const Joint& joint : robot.joints) {
    const auto i = static_cast<Eigen::Index>(joints.size());
    q_min[i] = joint.q_min;
    q_max[i] = joint.q_max;
    joints.push_back(joint.name);
    actuators.push_back(joint.name);
  }
  for (const Link& link : robot.links) links.push_back(link.name);
  show("joints", joints);
  show("q_min", q_min);
  show("q_max", q_max);
  show("actuators", actuators);
  show("u_min", robot.actuation.u_min);
  show("u_max", robot.actuation.u_max);
  show("links", links);
}

void show_evaluation(const Evaluation& evaluation) {
  show("status", std::string(to_string(evaluation.status)));
  show("reason", evaluation.reason.str());
  show("beta", evaluation.beta);
  show("unit", std::string(evaluation.unit));
  show("theta", evaluation.theta);
  show("theta_r", evaluation.theta_r);
  show("base", evaluation.base);
  show("u", evaluation.u);
  show("h", evaluation.h);
  show("lambda", evaluation.lambda);
  show("tau_d", evaluation.tau_d);
  show("gradient", evaluation.gradient);
  show("links", evaluation.links);
  show("end_effector", evaluation.end_effector);
  show("c", evaluation.c);
  show("h_2", evaluation.h_2);
  show("contact", evaluation.contact);
  show("solutions", evaluation.solutions);
  show("solution", evaluation.solution);
}

Eigen::VectorXd vector_of(const double* values, int count) {
  return Eigen::Map<const Eigen::VectorXd>(values, count);
}

}  // namespace
}  // namespace maxwrench

using namespace maxwrench;

extern "C" {

const char* engine_load(const char* data, int size) {
  return line_of_error([&] {
    auto task = std::make_unique<TaskEvaluator>(
        read_problem(std::string_view(data, static_cast<std::size_t>(size))));
    const Problem& problem = task->problem();
    show("name", problem.name);
    show("unit", std::string(problem.unit()));
    show_theta_r(problem);
    show_robot(problem.robot);
    show_measures(problem);
    engine().task = std::move(task);
  });
}

const char* engine_evaluate(const double* theta_r, int count, const char* measure,
                            const char* wrench, int collision, int solution, const double* near,
                            int joints) {
  return line_of_error([&] {
    TaskEvaluator& task = loaded_task();
    const EvaluationChoice choice{measure, parse_wrench(wrench), collision != 0};
    show_evaluation(
        task.evaluate(vector_of(theta_r, count), choice, {solution, vector_of(near, joints)}));
  });
}

const char* engine_evaluate_knots(const double* knots, int count, const char* measure,
                                  const char* wrench, int collision) {
  return line_of_error([&] {
    TaskEvaluator& task = loaded_task();
    const int columns = std::max(task.problem().redundancy(), 1);
    using Table = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    task.evaluate_knots(Eigen::Map<const Table>(knots, count / columns, columns),
                        {measure, parse_wrench(wrench), collision != 0});
  });
}

const char* engine_part(const char* part, int instant) {
  return line_of_error(
      [&] { show("json", in_one_line(part_json(loaded_task().answer(), part, instant))); });
}

int engine_fields() { return static_cast<int>(engine().fields.size()); }
const char* engine_field_name(int field) { return field_at(field).name; }
int engine_field_kind(int field) { return field_at(field).kind; }
int engine_field_size(int field) {
  const Field& of = field_at(field);
  return static_cast<int>(of.texts.empty() ? of.numbers.size() : std::ssize(of.texts));
}
const double* engine_field_numbers(int field) { return field_at(field).numbers.data(); }
const char* engine_field_text(int field, int i) {
  return field_at(field).texts[static_cast<std::size_t>(i)].c_str();
}
}
