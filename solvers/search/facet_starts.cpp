#include "solvers/search/facet_starts.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "lib/math/random.h"
#include "solvers/search/local_search.h"

namespace maxwrench {
namespace {

/// Limits of the scale of a column of w, at any start [N, N m].
constexpr double kLeastScale = 1e-2, kMostScale = 1e4;

/// The fewest evaluations of a local solve: at its start, for a move, and at its end.
constexpr long kFewest = 3;

long facet_parts_of(long budget) { return std::clamp(budget / 200, 1L, 8L); }

/// Solves from each IK solution of theta_r; appends how each solve ended.
void solve_all(Probe& probe, FacetProgram& program, const Box& box, const Eigen::VectorXd& theta_r,
               const char* name, const FacetSolve& solve, std::vector<Call>& calls) {
  const auto spent = [&] { return probe.found().trace.evaluations(); };
  probe.spend();
  const int ik_solutions = program.ik_solutions(theta_r);
  for (int k = 0; k < ik_solutions && probe.left() >= kFewest; ++k) {
    const long before = spent();
    Call call{name, ""};
    solve_from(probe, program, box, theta_r, k, solve, &call.status);
    call.evaluations = spent() - before;
    calls.push_back(std::move(call));
  }
}

/// The only place that checks whether an objective has facets. Throws if it has none.
std::unique_ptr<FacetProgram> require_facets(const Objective& objective, const char* search) {
  const auto* of_postures = dynamic_cast<const FacetObjective*>(&objective);
  auto program = of_postures ? of_postures->make_facet_program() : nullptr;
  if (program) return program;
  throw std::invalid_argument(std::string("search: got '") + search +
                              "', which supports only linf_polytope of a static task with few "
                              "actuator facets, of a list with pure wrenches, expected another "
                              "search");
}

}  // namespace

FacetView::FacetView(Probe& probe, FacetProgram& program, const Box& box)
    : probe_(probe), box_(box), program_(program), d_(box.free()), unit_(program_.row_unit()) {
  row_min_ = program_.row_min().cwiseQuotient(unit_);
  row_max_ = program_.row_max().cwiseQuotient(unit_);
}

bool FacetView::set_out(const Eigen::VectorXd& theta_r, int ik_solution) {
  probe_.spend();
  Eigen::VectorXd w;
  if (!program_.set_out(theta_r, ik_solution, w) || !program_.evaluate(theta_r, w)) return false;
  program_.linearize();
  scale(w);
  start_.resize(d_ + w.size());
  start_ << box_.unit(theta_r), w.cwiseQuotient(w_scale_);
  y_.resize(0);
  return true;
}

/// Sets s and the data that depend on it.
void FacetView::scale(const Eigen::VectorXd& w) {
  const Eigen::Index k = w.size();
  w_scale_.resize(k);
  for (Eigen::Index j = 0; j < k; ++j) {
    const double borne =
        1 / (program_.by_w().col(j).cwiseQuotient(unit_)).lpNorm<Eigen::Infinity>();
    w_scale_[j] = std::clamp(std::max(std::abs(w[j]), borne), kLeastScale, kMostScale);
  }
  lower_ = Eigen::VectorXd::Zero(d_ + k);
  upper_ = Eigen::VectorXd::Ones(d_ + k);
  lower_.tail(k) = program_.w_min().cwiseQuotient(w_scale_);
  upper_.tail(k) = program_.w_max().cwiseQuotient(w_scale_);
  c_y_ = Eigen::VectorXd::Zero(d_ + k);
  c_y_.tail(k) = program_.c_w().cwiseProduct(w_scale_);
  c_y_ /= c_y_.lpNorm<Eigen::Infinity>();
}

bool FacetView::look(const Eigen::VectorXd& y) {
  if (y_.size() == y.size() && y_ == y) return valid_;
  if (ended() || !y.allFinite()) return false;
  probe_.spend();
  y_ = y;
  linear_ = false;
  valid_ = program_.evaluate(theta_r(y), y.tail(w_scale_.size()).cwiseProduct(w_scale_));
  if (valid_) rows_ = program_.rows().cwiseQuotient(unit_);
  return valid_;
}

const RowProgram::Jacobian& FacetView::jacobian() {
  if (linear_) return jacobian_;
  linear_ = true;
  program_.linearize();
  const Eigen::Index k = w_scale_.size();
  jacobian_.resize(rows_.size(), d_ + k);
  for (Eigen::Index j = 0; j < rows_.size(); ++j) {
    jacobian_.row(j).head(d_) = box_.slope(program_.by_theta_r().row(j).transpose()).transpose();
  }
  jacobian_.rightCols(k) = program_.by_w() * w_scale_.asDiagonal();
  jacobian_ = unit_.cwiseInverse().asDiagonal() * jacobian_;
  return jacobian_;
}

double solve_from(Probe& probe, FacetProgram& program, const Box& box,
                  const Eigen::VectorXd& theta_r, int ik_solution, const FacetSolve& solve,
                  std::string* status) {
  FacetView view(probe, program, box);
  if (!view.set_out(theta_r, ik_solution)) return -kInfinity;
  const FacetEnd end = solve(view);
  if (status) *status = view.ended() ? kBudgetUsed : end.status;
  return probe.evaluate(view.theta_r(end.y));
}

SearchResult search_from_facet_starts(const char* name, Objective& objective,
                                      const SearchOptions& options, const FacetSolve& solve,
                                      long most) {
  check(options, objective);
  require_facets(objective, name);
  const Box box(objective);
  const Eigen::VectorXd start = box.start(options.start);
  const long givens = std::max<long>(1, static_cast<long>(options.starts.size()));
  const auto given = [&](long i) -> const Eigen::VectorXd& {
    return options.starts.empty() ? start : options.starts[static_cast<std::size_t>(i)].theta_r;
  };
  SearchRun run(options);
  const long parts = facet_parts_of(options.budget);
  std::vector<Part> found(static_cast<std::size_t>(parts));
  parallel_for(options.threads, parts, [&](long part) {
    Probe probe(objective, options.budget / parts + (part < options.budget % parts ? 1 : 0), run,
                options.starts_wanted > 0 ? &box : nullptr);
    const std::unique_ptr<FacetProgram> program = require_facets(objective, name);
    if (part == 0) probe.evaluate(given(0));
    std::vector<Call> calls;
    const auto enough = [&] { return static_cast<long>(calls.size()) > most / parts; };
    for (long i = part; box.free() > 0 && probe.left() > 0 && !enough(); i += parts) {
      Random random(options.seed, RandomUse::kLocalSearch, static_cast<std::uint64_t>(i));
      solve_all(probe, *program, box, i < givens ? given(i) : random_point(box, random), name,
                solve, calls);
    }
    found[static_cast<std::size_t>(part)] = probe.take();
    found[static_cast<std::size_t>(part)].calls = std::move(calls);
  });
  Part all;
  join(found, all);
  return make_result(std::move(all), box, options, run);
}

}  // namespace maxwrench
