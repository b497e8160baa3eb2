#include "solvers/search/nlopt_run.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "solvers/caught.h"

namespace maxwrench {
namespace {

using OwnedOptimizer = std::unique_ptr<std::remove_pointer_t<nlopt_opt>, decltype(&nlopt_destroy)>;

struct Session {
  Probe& probe;
  const Box& box;
  double scale;
  nlopt_opt opt;
  Eigen::VectorXd gradient;
  Caught caught;
};

/// phi(f) at x.
double look(Session& s, unsigned n, const double* x, double* slope) {
  double value = -kInfinity;
  const Eigen::Map<const Eigen::VectorXd> point(x, n);
  // Some methods take seconds to use up a large budget to no effect, and some leave the finite
  // numbers.
  if (s.probe.left() == 0 || !point.allFinite()) {
    nlopt_force_stop(s.opt);
  } else {
    value = s.probe.evaluate(s.box.theta_r(point), slope ? &s.gradient : nullptr);
  }
  const bool local_searches = slope && value > -kInfinity && s.gradient.allFinite();
  if (slope && !local_searches) std::fill(slope, slope + n, 0.0);
  if (value == -kInfinity) return -1;
  const double reach = s.scale + std::abs(value);
  if (local_searches) {
    Eigen::Map<Eigen::VectorXd>(slope, n) = s.scale / (reach * reach) * s.box.slope(s.gradient);
  }
  return value / reach;
}

double objective(unsigned n, const double* x, double* slope, void* data) {
  Session& s = *static_cast<Session*>(data);
  const double value = s.caught.run(-1.0, [&] { return look(s, n, x, slope); });
  if (s.caught.any()) {
    if (slope) std::fill(slope, slope + n, 0.0);
    nlopt_force_stop(s.opt);
  }
  return value;
}

OwnedOptimizer make(nlopt_algorithm algorithm, const NloptOptions& options, unsigned n) {
  OwnedOptimizer opt(nlopt_create(algorithm, n), nlopt_destroy);
  const auto take = [&](nlopt_result result) { require_taken(result, options.method); };
  take(nlopt_set_lower_bounds1(opt.get(), 0));
  take(nlopt_set_upper_bounds1(opt.get(), 1));
  take(nlopt_set_xtol_abs1(opt.get(), options.x_tolerance));
  take(nlopt_set_ftol_rel(opt.get(), options.f_tolerance));
  if (options.initial_step > 0) take(nlopt_set_initial_step1(opt.get(), options.initial_step));
  return opt;
}

std::string optimise_by_nlopt(const NloptOptions& options, Probe& probe, const Box& box,
                              const Candidate& start, Random& random) {
  const auto n = static_cast<unsigned>(box.free());
  const OwnedOptimizer opt = make(options.algorithm, options, n);
  Session session{probe, box, std::max(1.0, std::abs(start.value)), opt.get(), {}, {}};
  const auto take = [&](nlopt_result result) { require_taken(result, options.method); };
  take(nlopt_set_max_objective(opt.get(), objective, &session));
  take(nlopt_set_maxeval(opt.get(), static_cast<int>(probe.left())));
  if (options.local != NLOPT_NUM_ALGORITHMS) {
    take(nlopt_set_local_optimizer(opt.get(), make(options.local, options, n).get()));
    take(nlopt_set_xtol_abs1(opt.get(), 0));
  }
  nlopt_srand(static_cast<unsigned long>(random.next()));
  Eigen::VectorXd x = box.unit(start.theta_r);
  double value = 0;
  // Whatever the status, the probe has stored the best point.
  const nlopt_result result = nlopt_optimize(opt.get(), x.data(), &value);
  session.caught.rethrow();
  return probe.left() == 0 ? kBudgetUsed : word_of(result);
}

class NloptSearch final : public Search {
 public:
  explicit NloptSearch(const NloptOptions& method) : method_(method) {}
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    NloptOptions method = method_;
    if (options.starts_wanted > 0 && method.x_rough > 0) method.x_tolerance = method.x_rough;
    LocalSearch local_search{method.method};
    local_search.evaluations_per_run = method.evaluations_per_run;
    local_search.max_parallel = method.max_parallel;
    local_search.optimise = [&method](Probe& probe, const Box& box, const Candidate& start,
                                      Random& random) {
      return optimise_by_nlopt(method, probe, box, start, random);
    };
    return multistart_search(objective, options, local_search);
  }

 private:
  NloptOptions method_;
};

}  // namespace

void require_taken(nlopt_result result, const char* search) {
  if (result >= 0) return;
  throw std::runtime_error(std::string(search) + ": NLopt reports " + word_of(result));
}

std::string word_of(nlopt_result result) {
  std::string word = nlopt_result_to_string(result);
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word;
}

std::unique_ptr<Search> make_nlopt_search(const NloptOptions& method) {
  return std::make_unique<NloptSearch>(method);
}

}  // namespace maxwrench
