#include "solvers/search/multistart.h"

#include <IpTNLP.hpp>
#include <algorithm>

#include "solvers/caught.h"
#include "solvers/ipopt_lock.h"
#include "solvers/search/ipopt_run.h"
#include "solvers/search/knot_starts.h"
#include "solvers/search/local_search.h"
#include "solvers/search/makers.h"

namespace maxwrench {
namespace {

using Ipopt::Index;
using Ipopt::Number;

constexpr int kPostureIterations = 40;
constexpr int kTrajectoryIterations = 200;

/// min -f(theta_r(x)) subject to 0 <= x <= 1 with the exact gradient; for a trajectory, also
/// subject to the rows of its knots. Where f has no value, Ipopt gets a failure code and shortens
/// its step.
class BoundedNlp : public Ipopt::TNLP {
 public:
  BoundedNlp(Probe& probe, const Box& box, Eigen::VectorXd start, const KnotRows* rows = nullptr)
      : probe_(probe), box_(box), start_(std::move(start)) {
    if (rows == nullptr) return;
    const Eigen::VectorXd origin = box_.theta_r(Eigen::VectorXd::Zero(box_.free()));
    Eigen::MatrixXd reach(origin.size(), box_.free());
    for (int j = 0; j < box_.free(); ++j) {
      reach.col(j) = box_.theta_r(Eigen::VectorXd::Unit(box_.free(), j)) - origin;
    }
    R_ = (rows->R * reach).sparseView();
    r_min_ = rows->r_min - rows->R * origin;
    r_max_ = rows->r_max - rows->R * origin;
  }

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jac, Index& nnz_hessian,
                    IndexStyleEnum& style) override {
    n = box_.free();
    m = static_cast<Index>(R_.rows());
    nnz_jac = static_cast<Index>(R_.nonZeros());
    nnz_hessian = 0;
    style = TNLP::C_STYLE;
    return true;
  }
  bool get_bounds_info(Index n, Number* l, Number* u, Index m, Number* g_l, Number* g_u) override {
    std::fill(l, l + n, 0.0);
    std::fill(u, u + n, 1.0);
    std::copy_n(r_min_.data(), m, g_l);
    std::copy_n(r_max_.data(), m, g_u);
    return true;
  }
  bool get_starting_point(Index n, bool, Number* x, bool, Number*, Number*, Index, bool,
                          Number*) override {
    std::copy(start_.data(), start_.data() + n, x);
    return true;
  }
  bool eval_f(Index n, const Number* x, bool, Number& value) override {
    if (!look(n, x)) return false;
    value = -value_;
    return true;
  }
  bool eval_grad_f(Index n, const Number* x, bool, Number* gradient) override {
    if (!look(n, x)) return false;
    Eigen::Map<Eigen::VectorXd>(gradient, n) = -slope_;
    return slope_.allFinite();
  }
  bool eval_g(Index n, const Number* x, bool, Index m, Number* g) override {
    Eigen::Map<Eigen::VectorXd>(g, m) = R_ * Eigen::Map<const Eigen::VectorXd>(x, n);
    return true;
  }
  bool eval_jac_g(Index, const Number*, bool, Index, Index, Index* rows, Index* cols,
                  Number* values) override {
    if (values != nullptr) {
      std::copy_n(R_.valuePtr(), R_.nonZeros(), values);
      return true;
    }
    for (int column = 0; column < R_.outerSize(); ++column) {
      for (Eigen::SparseMatrix<double>::InnerIterator it(R_, column); it; ++it) {
        *rows++ = static_cast<Index>(it.row());
        *cols++ = static_cast<Index>(it.col());
      }
    }
    return true;
  }
  bool intermediate_callback(Ipopt::AlgorithmMode, Index, Number, Number, Number, Number, Number,
                             Number, Number, Number, Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    return probe_.left() > 0 && !caught_.any();
  }
  void finalize_solution(Ipopt::SolverReturn, Index, const Number*, const Number*, const Number*,
                         Index, const Number*, const Number*, Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    // The probe has stored the best point.
  }

  /// Rethrows an exception of the objective, which Ipopt would suppress.
  void rethrow() { caught_.rethrow(); }

 private:
  bool look(Index n, const Number* x) {
    return caught_.run(false, [&] { return evaluate(n, x); });
  }

  /// Value and gradient at x, computed once for each point: Ipopt requests them one after the
  /// other.
  bool evaluate(Index n, const Number* x) {
    const Eigen::Map<const Eigen::VectorXd> point(x, n);
    if (x_.size() != n || x_ != point) {
      if (probe_.left() == 0 || !point.allFinite()) return false;
      x_ = point;
      value_ = probe_.evaluate(box_.theta_r(x_), &gradient_);
      slope_ = box_.slope(gradient_);
    }
    return value_ != -kInfinity;
  }

  Probe& probe_;
  const Box& box_;
  const Eigen::VectorXd start_;
  Eigen::SparseMatrix<double> R_;  ///< rows on x; empty except for a trajectory
  Eigen::VectorXd r_min_, r_max_;
  Eigen::VectorXd x_, gradient_, slope_;
  double value_ = -kInfinity;
  Caught caught_;
};

/// One solve from `start`; returns Ipopt's status.
std::string solve_by_ipopt(Probe& probe, const Box& box, const Eigen::VectorXd& start,
                           int iterations, const KnotRows* rows = nullptr) {
  const std::lock_guard guard(ipopt_lock());
  const auto application = make_ipopt_application("multistart", iterations);
  const Ipopt::SmartPtr<BoundedNlp> nlp = new BoundedNlp(probe, box, box.unit(start), rows);
  const auto status = application->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(nlp)));
  nlp->rethrow();
  return probe.left() == 0 ? kBudgetUsed : word_of(status);
}

}  // namespace

void optimise_by_ipopt(Probe& probe, const Box& box, const Eigen::VectorXd& theta_r) {
  solve_by_ipopt(probe, box, theta_r, kPostureIterations);
}

namespace {

/// Local solves by Ipopt (interior point, limited-memory quasi-Newton, exact gradient) from many
/// random points, like fmincon with MultiStart. There is one start for each 500 evaluations of the
/// budget, at most 64, because a start takes far more time than its evaluations. The solves run one
/// after the other under one lock. At a kink of the objective, the line search fails.
///
/// For a trajectory it is the paper's bilevel method: from the best of the drawn tables, or from
/// points of an earlier search, one start after the other, subject to the rows of the knots.
class Multistart final : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    if (auto* trajectories = as_trajectories(objective))
      return maximize_trajectory(*trajectories, options);
    LocalSearch local_search{"multistart"};
    local_search.starts = std::clamp(options.budget / 500, 1L, 64L);
    local_search.max_parallel = 1;
    local_search.optimise = [](Probe& probe, const Box& box, const Candidate& start,
                               Random& /*random*/) {
      return solve_by_ipopt(probe, box, start.theta_r, kPostureIterations);
    };
    return multistart_search(objective, options, local_search);
  }

 private:
  static SearchResult maximize_trajectory(TrajectoryObjective& objective,
                                          const SearchOptions& options) {
    check(options, objective);
    SearchRun run(options);
    Part found;
    const std::vector<Candidate> starts =
        options.starts.empty() ? draw_knot_starts(objective, options, run, found) : options.starts;
    const Box box(objective);
    Probe probe(objective, 0, run, options.starts_wanted > 0 ? &box : nullptr);
    for (const Candidate& start : starts) {
      const long left = options.budget - found.trace.evaluations();
      if (left <= 0 || run.ended()) break;
      probe.grant(left);
      const std::string word =
          solve_by_ipopt(probe, box, start.theta_r, kTrajectoryIterations, objective.rows());
      const Part part = probe.take();
      join({part}, found);
      found.calls.push_back({"multistart", word, part.trace.evaluations()});
    }
    return make_result(std::move(found), box, options, run);
  }
};

}  // namespace

std::unique_ptr<Search> make_multistart() { return std::make_unique<Multistart>(); }

}  // namespace maxwrench
