#include <algorithm>
#include <atomic>
#include <limits>
#include <stdexcept>

#include "maxwrench/batch.h"
#include "maxwrench/evaluations.h"
#include "maxwrench/measure.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/format.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

/// The number of rows that one evaluator takes. It is made anew for each chunk, so that values do
/// not depend on the number of threads; beside so many rows that costs nothing. Of several IK
/// solutions with equal values, an evaluator may choose by the row before, so there each row has
/// its own.
Eigen::Index chunk_size(const Problem& task) {
  return task.dependent.empty() && !task.contact ? 64 : 1;
}

Evaluations make_evaluations(const Problem& task, Eigen::Index count) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Robot& robot = task.robot;
  Evaluations result;
  result.status.assign(static_cast<std::size_t>(count), Status::kBudgetExhausted);
  result.beta = Eigen::VectorXd::Constant(count, none);
  result.gradient.setConstant(count, task.redundancy(), none);
  result.q.setConstant(count, static_cast<Eigen::Index>(robot.joints.size()), none);
  result.base.setConstant(count, 6, none);
  result.u.setConstant(count, robot.actuators(), none);
  result.h.setConstant(count, 6, none);
  return result;
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
    result.q.row(row) = posture.q;
    result.base.row(row) << posture.base.p.transpose(), rpy(posture.base.R).transpose();
    result.status[static_cast<std::size_t>(row)] = conclude(posture);
    if (result.status[static_cast<std::size_t>(row)] != Status::kOptimal) return;
    result.beta[row] = capability_.beta;
    measure_->differentiate(posture, program_, capability_);
    model_.pull_back(theta_r, capability_, gradient_);
    result.gradient.row(row) = gradient_;
    if (capability_.u.size() > 0) result.u.row(row) = capability_.u;
    if (capability_.w.size() > 0) result.h.row(row) = capability_.h;
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
                          const Options& options) {
  require_rows(task, theta_r);
  const int threads = thread_count(options.threads);
  Case c = options;
  c.search.clear();  // the postures are given, not searched
  const Method method = resolve(task, c);
  Evaluations result = make_evaluations(task, theta_r.rows());
  std::atomic<bool> ended = false;
  std::atomic<long> done = 0;
  const Eigen::Index size = chunk_size(task);
  const long chunks = (theta_r.rows() + size - 1) / size;
  parallel_for(threads, chunks, [&](long chunk) {
    RowEvaluator evaluator(task, method, options.check_collision);
    const Eigen::Index end = std::min(theta_r.rows(), (chunk + 1) * size);
    for (Eigen::Index row = chunk * size; row < end; ++row) {
      if (ended || (options.interrupted && options.interrupted())) {
        ended = true;
        return;
      }
      evaluator.evaluate(theta_r.row(row), row, result);
    }
    done += end - chunk * size;
    if (options.progress) options.progress(done);
  });
  return result;
}

}  // namespace maxwrench
