#include "solvers/search/multistart.h"

#include <algorithm>

#include "solvers/ipopt/ipopt_lock.h"
#include "solvers/ipopt/ipopt_nlp.h"
#include "solvers/search/knot_starts.h"
#include "solvers/search/local_search.h"
#include "solvers/search/makers.h"

namespace maxwrench {
namespace {

constexpr int kPostureIterations = 40;
constexpr int kTrajectoryIterations = 200;

/// min -f(theta_r(x)) subject to 0 <= x <= 1, with the exact gradient, and of a trajectory to the
/// rows of its knots. Where f has no value, Ipopt is told so and shortens its step.
class BoundedNlp final : public IpoptNlp {
 public:
  BoundedNlp(Probe& probe, const Box& box, const Eigen::VectorXd& start,
             const KnotRows* rows = nullptr)
      : BoundedNlp(probe, box, start, in_unit_cube(box, rows)) {}

 private:
  BoundedNlp(Probe& probe, const Box& box, const Eigen::VectorXd& start, const KnotRows& rows)
      : IpoptNlp({start, Eigen::VectorXd::Zero(box.free()), Eigen::VectorXd::Ones(box.free()),
                  rows.r_min, rows.r_max, entries_of(rows.R)}),
        probe_(probe),
        box_(box),
        R_(rows.R) {}

  static KnotRows in_unit_cube(const Box& box, const KnotRows* rows) {
    if (rows == nullptr) return {Eigen::SparseMatrix<double>(0, box.free()), {}, {}};
    const Eigen::VectorXd origin = box.theta_r(Eigen::VectorXd::Zero(box.free()));
    Eigen::MatrixXd reach(origin.size(), box.free());
    for (int j = 0; j < box.free(); ++j) {
      reach.col(j) = box.theta_r(Eigen::VectorXd::Unit(box.free(), j)) - origin;
    }
    return {(rows->R * reach).sparseView(), rows->r_min - rows->R * origin,
            rows->r_max - rows->R * origin};
  }

  bool value(const Point& x, double& f) override {
    if (!evaluate(x)) return false;
    f = -value_;
    return true;
  }
  bool gradient(const Point& x, Result slopes) override {
    if (!evaluate(x)) return false;
    slopes = -slope_;
    return slope_.allFinite();
  }
  bool rows(const Point& x, Result g) override {
    g = R_ * x;
    return true;
  }
  bool jacobian(const Point& /*x*/, Result values) override {
    std::copy_n(R_.valuePtr(), values.size(), values.data());
    return true;
  }
  bool ended() override { return probe_.left() == 0; }

  /// Value and gradient at x, once for each point: Ipopt asks for them one after the other.
  bool evaluate(const Point& x) {
    if (x_.size() != x.size() || x_ != x) {
      if (probe_.left() == 0 || !x.allFinite()) return false;
      x_ = x;
      value_ = probe_.evaluate(box_.theta_r(x_), &gradient_);
      slope_ = box_.slope(gradient_);
    }
    return value_ != -kInfinity;
  }

  Probe& probe_;
  const Box& box_;
  const Eigen::SparseMatrix<double> R_;  ///< rows on x; none unless of a trajectory
  Eigen::VectorXd x_, gradient_, slope_;
  double value_ = -kInfinity;
};

/// One solve from `start`; returns Ipopt's status.
std::string solve_by_ipopt(Probe& probe, const Box& box, const Eigen::VectorXd& start,
                           int iterations, const KnotRows* rows = nullptr) {
  const std::lock_guard guard(ipopt_lock());
  const auto application = make_ipopt_application("multistart", iterations);
  const Ipopt::SmartPtr<BoundedNlp> nlp = new BoundedNlp(probe, box, box.unit(start), rows);
  const auto status = minimize(*application, *nlp);
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
