#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <stdexcept>

#include "maxwrench/batch.h"
#include "maxwrench/evaluations.h"
#include "maxwrench/measure.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/format.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

/// Whether a row may depend on the row before, if one evaluator takes both: solvers of linear
/// programs start where they ended, and of several IK solutions with equal values an evaluator may
/// choose by the row before.
bool remembers(const Problem& task, const Method& method) {
  const auto solvers = lp_solvers();
  return !task.dependent.empty() || task.contact ||
         std::any_of(solvers.begin(), solvers.end(), [&method](const LpEntry& solver) {
           return solver.name == method.choice.solver;
         });
}

/// The number of rows that one evaluator takes. It is made anew for each chunk; beside so many rows
/// that costs nothing.
constexpr Eigen::Index kChunk = 64;

/// Rows without numbers: `clear_rows` is the first to write them.
Evaluations make_evaluations(const Problem& task, Eigen::Index count, bool gradients) {
  const Robot& robot = task.robot;
  Evaluations result;
  result.status.assign(static_cast<std::size_t>(count), Status::kBudgetExhausted);
  result.beta.resize(count);
  if (gradients) result.gradient.resize(count, task.redundancy());
  result.q.resize(count, static_cast<Eigen::Index>(robot.joints.size()));
  result.base.resize(count, 6);
  result.u.resize(count, robot.actuators());
  result.h.resize(count, 6);
  return result;
}

/// Each thread clears the rows that it fills. If one did for all, it would wait for the memory of
/// all.
void clear_rows(Eigen::Index begin, Eigen::Index count, Evaluations& result) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  result.beta.segment(begin, count).setConstant(none);
  for (Evaluations::Rows* each :
       {&result.gradient, &result.q, &result.base, &result.u, &result.h}) {
    if (each->rows() > 0) each->middleRows(begin, count).setConstant(none);
  }
}

void write_posture(const Posture& posture, Eigen::Index row, Evaluations& result) {
  result.q.row(row) = posture.q;
  result.base.row(row) << posture.base.p.transpose(), rpy(posture.base.R).transpose();
}

void write_capability(const Capability& capability, Eigen::Index row, Evaluations& result) {
  result.beta[row] = capability.beta;
  if (capability.u.size() > 0) result.u.row(row) = capability.u;
  if (capability.w.size() > 0) result.h.row(row) = capability.h;
}

/// What evaluates the rows of a chunk, one after another.
class RowEvaluator {
 public:
  RowEvaluator(const Problem& task, const Method& method, bool check_collision)
      : model_(task, check_collision),
        program_(make_wrench_program(task, method.choice.wrench)),
        measure_(method.make_measure()) {}

  void evaluate(const Eigen::VectorXd& theta_r, Eigen::Index row, Evaluations& result) {
    const Posture& posture = evaluate_best(model_, theta_r, *measure_, true, program_, capability_);
    write_posture(posture, row, result);
    result.status[static_cast<std::size_t>(row)] = conclude(posture);
    if (result.status[static_cast<std::size_t>(row)] != Status::kOptimal) return;
    write_capability(capability_, row, result);
    if (result.gradient.rows() > 0) {
      measure_->differentiate(posture, program_, capability_);
      model_.pull_back(theta_r, capability_, gradient_);
      result.gradient.row(row) = gradient_;
    }
  }

 private:
  Status conclude(const Posture& posture) const {
    if (posture.status != Status::kValid) return posture.status;
    if (capability_.status != Status::kOptimal) return capability_.status;
    return satisfies_program(capability_) ? Status::kOptimal : Status::kNumericalError;
  }

  PostureEvaluator model_;
  WrenchProgram program_;
  std::unique_ptr<Measure> measure_;
  Capability capability_;
  Eigen::VectorXd gradient_;
};

/// Reports the number of finished rows, which grows from call to call.
class Progress {
 public:
  explicit Progress(const Options& options) : report_(options.progress) {}
  void add(long rows) {
    if (!report_) return;
    const std::lock_guard lock(mutex_);
    report_(done_ += rows);
  }

 private:
  const std::function<void(long)>& report_;
  std::mutex mutex_;
  long done_ = 0;
};

/// Calls make()(row) for all rows of `result` in parallel. Each chunk of `size` rows has a function
/// of its own, which `make` makes and which gets them in order.
template <class Make>
void evaluate_chunks(Eigen::Index size, int threads, const Options& options, Evaluations& result,
                     const Make& make) {
  std::atomic<bool> ended = false;
  Progress progress(options);
  const Eigen::Index rows = result.beta.size();
  parallel_for(threads, (rows + size - 1) / size, [&](long chunk) {
    const Eigen::Index begin = chunk * size, end = std::min(rows, begin + size);
    clear_rows(begin, end - begin, result);
    if (ended) return;
    const auto evaluate_row = make();
    for (Eigen::Index row = begin; row < end; ++row) {
      if (ended || (options.interrupted && options.interrupted())) {
        ended = true;
        return;
      }
      evaluate_row(row);
    }
    progress.add(end - begin);
  });
}

void require_rows(const Problem& task, const Evaluations::Rows& theta_r) {
  const auto reject = [&task](const std::string& got, const std::string& expected) {
    throw std::invalid_argument("theta_r: got " + got + ", expected " + expected + " (" +
                                task.name + ")");
  };
  if (task.motion) reject("a task in time", "a static task");
  if (theta_r.cols() != task.redundancy()) {
    reject(std::to_string(theta_r.cols()) + " numbers in a row", std::to_string(task.redundancy()));
  }
  if (!theta_r.allFinite()) reject("a value that is not a finite number", "finite numbers");
}

}  // namespace

Evaluations evaluate_each(const Problem& task, const Evaluations::Rows& theta_r,
                          const Options& options, bool gradients) {
  require_rows(task, theta_r);
  const int threads = thread_count(options.threads);
  Case c = options;
  c.search.clear();  // the postures are given, not searched
  const Method method = resolve(task, c);
  Evaluations result = make_evaluations(task, theta_r.rows(), gradients);
  const Eigen::Index size = remembers(task, method) ? 1 : kChunk;
  evaluate_chunks(size, threads, options, result, [&] {
    const auto evaluator = std::make_shared<RowEvaluator>(task, method, options.check_collision);
    return [&, evaluator](Eigen::Index row) { evaluator->evaluate(theta_r.row(row), row, result); };
  });
  return result;
}

Evaluations evaluate_each_posture(const Problem& task, const Evaluations::Rows& q,
                                  const Options& options) {
  require_joints(task, Eigen::VectorXd::Zero(q.cols()));
  for (Eigen::Index row = 0; row < q.rows(); ++row) require_joints(task, q.row(row));
  const int threads = thread_count(options.threads);
  Evaluations result = make_evaluations(task, q.rows(), false);
  evaluate_chunks(1, threads, options, result, [&] {
    return [&](Eigen::Index row) {
      const Answer answer = evaluate_posture(task, q.row(row), options);
      result.status[static_cast<std::size_t>(row)] = answer.status;
      write_posture(answer.posture, row, result);
      if (answer.has_value()) write_capability(answer.capability, row, result);
    };
  });
  return result;
}

}  // namespace maxwrench
