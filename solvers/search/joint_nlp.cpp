#include <algorithm>

#include "solvers/ipopt/ipopt_lock.h"
#include "solvers/ipopt/ipopt_nlp.h"
#include "solvers/search/joint_program.h"
#include "solvers/search/knot_starts.h"
#include "solvers/search/makers.h"

namespace maxwrench {
namespace {

constexpr std::size_t kJointStarts = 4;
constexpr int kJointIterations = 200;

/// A `JointProgram` as Ipopt wants it. The table of every iterate is evaluated as any search does,
/// so what is found was found by the lower level and not by Ipopt's tolerances. An evaluation is
/// one of these or one of the rows; the rows are computed once more after each of the former.
class JointNlp final : public IpoptNlp {
 public:
  JointNlp(Objective& objective, JointProgram& program, long budget, SearchRun& run, Part& found)
      : IpoptNlp({program.start(), program.lower(), program.upper(), program.row_min(),
                  program.row_max(), entries_of(program.jacobian()), program.nonlinear()}),
        objective_(objective),
        program_(program),
        budget_(budget),
        run_(run),
        found_(found) {}

 private:
  bool value(const Point& X, double& f) override {
    f = -program_.objective().dot(X);
    return true;
  }
  bool gradient(const Point& /*X*/, Result slopes) override {
    slopes = -program_.objective();
    return true;
  }
  bool rows(const Point& X, Result g) override {
    if (!look(X)) return false;
    g = program_.rows();
    return g.allFinite();
  }
  bool jacobian(const Point& X, Result values) override {
    if (!look(X) || !judge()) return false;
    std::copy_n(program_.jacobian().valuePtr(), values.size(), values.data());
    return true;
  }
  bool ended() override { return left() < 2; }

  long left() const { return run_.ended() ? 0 : budget_ - found_.trace.evaluations(); }

  bool look(const Point& X) {
    if (X_.size() == X.size() && X_ == X) return true;
    if (left() == 0) return false;
    X_ = X;
    program_.evaluate(X_);
    found_.trace.add(-kInfinity);
    run_.show();
    return true;
  }

  /// Evaluates the table of an iterate by the lower level.
  bool judge() {
    if (left() == 0) return false;
    const Eigen::VectorXd x = program_.knots(X_);
    const double value = run_.evaluate(objective_, x);
    found_.trace.add(value);
    if (value > found_.best.value) found_.best = {x, value};
    program_.evaluate(X_);  // the lower level has moved the evaluator's motion
    return true;
  }

  Objective& objective_;
  JointProgram& program_;
  long budget_;
  SearchRun& run_;
  Part& found_;
  Eigen::VectorXd X_;
};

/// The trajectory, its efforts and its wrenches in one nonlinear program (`JointProgram`), solved
/// by Ipopt with exact sparse first derivatives. It starts from the starts of `slp`, one after the
/// other under Ipopt's lock. The program does not contain collisions: a trajectory that collides
/// has no value.
class JointNlpSearch : public Search {
 public:
  SearchResult maximize(Objective& given, const SearchOptions& options) override {
    check(options, given);
    TrajectoryObjective& objective = require_trajectories(given, "joint_nlp");
    SearchRun run(options);
    Part found;
    std::vector<Candidate> starts = find_knot_starts(objective, options, run, found);
    if (objective.dimension() == 0) starts.clear();
    for (std::size_t i = 0; i < std::min(starts.size(), kJointStarts); ++i) {
      const auto later = static_cast<long>(std::min(starts.size(), kJointStarts) - i);
      const long before = found.trace.evaluations(), left = options.budget - before;
      if (left < kFewestOfLocalSearch || run.ended()) break;
      // Each local search has its own copy of the objective, so its path depends only on its own
      // evaluations.
      optimise(*objective.copy(objective.counts()), starts[i],
               before + std::max(kFewestOfLocalSearch, left / later), run, found);
      run.add(found.trace.evaluations() - before);
    }
    return make_result(found, run);
  }

 private:
  static void optimise(TrajectoryObjective& objective, const Candidate& start, long until,
                       SearchRun& run, Part& found) {
    const double value = run.evaluate(objective, start.theta_r);
    found.trace.add(value);
    if (value == -kInfinity) return;
    JointProgram program(objective.trajectories(), objective.lower(), objective.upper());
    const std::lock_guard guard(ipopt_lock());
    const auto application =
        make_ipopt_application("joint_nlp", kJointIterations, [](Ipopt::OptionsList& options) {
          options.SetStringValue("mu_strategy", "monotone");
          options.SetNumericValue("tol", 1e-7);
        });
    const Ipopt::SmartPtr<JointNlp> nlp = new JointNlp(objective, program, until, run, found);
    minimize(*application, *nlp);
  }
};

}  // namespace

std::unique_ptr<Search> make_joint_nlp() { return std::make_unique<JointNlpSearch>(); }

}  // namespace maxwrench
