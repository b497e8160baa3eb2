#include "solvers/search/probe.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace maxwrench {
namespace {

/// Evaluations between two reports of the progress.
constexpr long kReportEvery = 256;

}  // namespace

Probe::Probe(const Objective& objective, long budget, SearchRun& run, const Box* box)
    : box_(box), objective_(objective.clone()), budget_(budget), run_(run) {}

Probe::~Probe() {
  try {
    report();
  } catch (...) {  // a destructor must not throw: the evaluations are counted but not shown
  }
}

double Probe::evaluate(const Eigen::VectorXd& theta_r, Eigen::VectorXd* gradient) {
  if (run_.ended()) {
    if (gradient) gradient->setConstant(theta_r.size(), std::numeric_limits<double>::quiet_NaN());
    return -kInfinity;
  }
  assert(granted() > 0);
  const double value = run_.evaluate(*objective_, theta_r, gradient);
  last_ = theta_r;
  found_.trace.add(value);
  if (value > found_.best.value) found_.best = {theta_r, value};
  if (box_ != nullptr && value > -kInfinity) {
    Candidate& best = cells_[cell(theta_r)];
    if (value > best.value) best = {theta_r, value};
  }
  if (found_.trace.evaluations() - reported_ >= kReportEvery) report();
  return value;
}

void Probe::spend() {
  assert(granted() > 0);
  found_.trace.add(-kInfinity);
  run_.show();
  if (found_.trace.evaluations() - reported_ >= kReportEvery) report();
}

Part Probe::take() {
  report();
  for (const auto& [cell, best] : cells_) found_.starts.push_back(best);
  cells_.clear();
  reported_ = budget_ = 0;
  return std::exchange(found_, {});
}

/// Beyond 21 coordinates the numbers wrap, and a few cells share a number.
std::uint64_t Probe::cell(const Eigen::VectorXd& theta_r) const {
  std::uint64_t number = 0;
  for (const double x : box_->unit(theta_r))
    number = 8 * number + static_cast<std::uint64_t>(std::clamp(8 * x, 0.0, 7.0));
  return number;
}

void Probe::report() {
  const long evaluations = found_.trace.evaluations();
  const long news = evaluations - reported_;
  reported_ = evaluations;
  if (news > 0) run_.add(news);
}

void join(const std::vector<Part>& parts, Part& found) {
  std::vector<Trace> traces;
  for (const Part& part : parts) {
    traces.push_back(part.trace);
    if (part.best.value > found.best.value) found.best = part.best;
    found.starts.insert(found.starts.end(), part.starts.begin(), part.starts.end());
    found.calls.insert(found.calls.end(), part.calls.begin(), part.calls.end());
  }
  found.trace.append(traces);
}

Eigen::VectorXd random_point(const Box& box, Random& random) {
  Eigen::VectorXd x(box.free());
  for (double& x_j : x) x_j = random.uniform();
  return box.theta_r(x);
}

std::vector<Candidate> select_apart(const Box& box, std::vector<Candidate> candidates,
                                    double separation, long count) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.value > b.value; });
  std::vector<Candidate> selected;
  for (Candidate& candidate : candidates) {
    if (static_cast<long>(selected.size()) == count || candidate.value == -kInfinity) break;
    const bool close = std::any_of(selected.begin(), selected.end(), [&](const Candidate& other) {
      return box.distance(other.theta_r, candidate.theta_r) < separation;
    });
    if (!close) selected.push_back(std::move(candidate));
  }
  return selected;
}

void add(std::vector<double>& values, const std::function<Eigen::VectorXd(long)>& point,
         Part& found) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) {
      values[i] = -kInfinity;
      continue;
    }
    found.trace.add(values[i]);
    if (values[i] > found.best.value) found.best = {point(static_cast<long>(i)), values[i]};
  }
}

SearchResult make_result(const Part& found, const SearchRun& run) {
  SearchResult result;
  result.interrupted = run.interrupted();
  result.evaluations = found.trace.evaluations();
  result.calls = found.calls;
  if (found.best.value == -kInfinity) return result;
  result.conclude(Status::kBestFound);
  result.theta_r = found.best.theta_r;
  result.value = found.best.value;
  result.history = found.trace.improvements();
  return result;
}

SearchResult make_result(Part found, const Box& box, const SearchOptions& options,
                         const SearchRun& run) {
  SearchResult result = make_result(found, run);
  if (options.starts_wanted == 0) return result;
  found.starts.insert(found.starts.begin(), found.best);
  result.starts = select_apart(box, std::move(found.starts), kApart, options.starts_wanted);
  return result;
}

}  // namespace maxwrench
