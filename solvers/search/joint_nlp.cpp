#include <IpTNLP.hpp>
#include <algorithm>

#include "solvers/caught.h"
#include "solvers/ipopt_lock.h"
#include "solvers/search/ipopt_run.h"
#include "solvers/search/joint_program.h"
#include "solvers/search/knot_starts.h"
#include "solvers/search/makers.h"

namespace maxwrench {
namespace {

using Ipopt::Index;
using Ipopt::Number;

constexpr std::size_t kJointStarts = 4;
constexpr int kJointIterations = 200;

/// A `JointProgram` in the form that Ipopt requires. The table of every iterate is evaluated like
/// that of any search, so results come from the lower level and do not depend on Ipopt's
/// tolerances. Evaluating a table counts as one evaluation, and so does evaluating the rows. The
/// rows are computed once more after each table.
class JointNlp : public Ipopt::TNLP {
 public:
  JointNlp(Objective& objective, JointProgram& program, long budget, SearchRun& run, Part& found)
      : objective_(objective), program_(program), budget_(budget), run_(run), found_(found) {}

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jac, Index& nnz_hessian,
                    IndexStyleEnum& style) override {
    n = static_cast<Index>(program_.start().size());
    m = static_cast<Index>(program_.row_min().size());
    nnz_jac = static_cast<Index>(program_.jacobian().nonZeros());
    nnz_hessian = 0;
    style = TNLP::C_STYLE;
    return true;
  }
  bool get_bounds_info(Index, Number* l, Number* u, Index, Number* g_l, Number* g_u) override {
    copy(program_.lower(), l);
    copy(program_.upper(), u);
    copy(program_.row_min(), g_l);
    copy(program_.row_max(), g_u);
    return true;
  }
  bool get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index, bool,
                          Number*) override {
    copy(program_.start(), x);
    return true;
  }
  bool eval_f(Index n, const Number* x, bool, Number& value) override {
    value = -program_.objective().dot(Eigen::Map<const Eigen::VectorXd>(x, n));
    return true;
  }
  bool eval_grad_f(Index, const Number*, bool, Number* gradient) override {
    copy(-program_.objective(), gradient);
    return true;
  }
  bool eval_g(Index n, const Number* x, bool, Index, Number* g) override {
    if (!look(n, x)) return false;
    copy(program_.rows(), g);
    return program_.rows().allFinite();
  }
  bool eval_jac_g(Index n, const Number* x, bool, Index, Index, Index* rows, Index* cols,
                  Number* values) override {
    if (values == nullptr) {
      fill_pattern(rows, cols);
      return true;
    }
    if (!look(n, x) || !judge()) return false;
    std::copy_n(program_.jacobian().valuePtr(), program_.jacobian().nonZeros(), values);
    return true;
  }
  bool intermediate_callback(Ipopt::AlgorithmMode, Index, Number, Number, Number, Number, Number,
                             Number, Number, Number, Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    return left() >= 2 && !caught_.any();
  }
  void finalize_solution(Ipopt::SolverReturn, Index, const Number*, const Number*, const Number*,
                         Index, const Number*, const Number*, Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    // `found` holds the best table.
  }

  void rethrow() { caught_.rethrow(); }

 private:
  static void copy(const Eigen::VectorXd& from, Number* to) {
    std::copy_n(from.data(), from.size(), to);
  }
  long left() const { return run_.ended() ? 0 : budget_ - found_.trace.evaluations(); }

  void fill_pattern(Index* rows, Index* cols) const {
    const Eigen::SparseMatrix<double>& jacobian = program_.jacobian();
    for (int column = 0; column < jacobian.outerSize(); ++column) {
      for (Eigen::SparseMatrix<double>::InnerIterator it(jacobian, column); it; ++it) {
        *rows++ = static_cast<Index>(it.row());
        *cols++ = static_cast<Index>(it.col());
      }
    }
  }

  bool look(Index n, const Number* x) {
    return caught_.run(false, [&] {
      const Eigen::Map<const Eigen::VectorXd> point(x, n);
      if (X_.size() == n && X_ == point) return true;
      if (left() == 0) return false;
      X_ = point;
      program_.evaluate(X_);
      found_.trace.add(-kInfinity);
      run_.show();
      return true;
    });
  }

  /// Evaluates the table of an iterate by the lower level.
  bool judge() {
    return caught_.run(false, [&] {
      if (left() == 0) return false;
      const Eigen::VectorXd x = program_.knots(X_);
      const double value = run_.evaluate(objective_, x);
      found_.trace.add(value);
      if (value > found_.best.value) found_.best = {x, value};
      program_.evaluate(X_);  // the lower level has changed the evaluator's motion
      return true;
    });
  }

  Objective& objective_;
  JointProgram& program_;
  long budget_;
  SearchRun& run_;
  Part& found_;
  Eigen::VectorXd X_;
  Caught caught_;
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
          options.SetStringValue("mu_strategy", "adaptive");
          options.SetNumericValue("tol", 1e-7);
        });
    const Ipopt::SmartPtr<JointNlp> nlp = new JointNlp(objective, program, until, run, found);
    application->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(nlp)));
    nlp->rethrow();
  }
};

}  // namespace

std::unique_ptr<Search> make_joint_nlp() { return std::make_unique<JointNlpSearch>(); }

}  // namespace maxwrench
