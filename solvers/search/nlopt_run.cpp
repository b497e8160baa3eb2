#include "solvers/search/nlopt_run.h"

#include <memory>

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
  // Some methods take seconds to spend a large budget in vain.
  if (s.probe.left() == 0 || s.probe.ended()) {
    nlopt_force_stop(s.opt);
  } else {
    const Eigen::Map<const Eigen::VectorXd> point(x, n);
    value = s.probe.evaluate(s.box.theta_r(point), slope ? &s.gradient : nullptr);
  }
  if (value == -kInfinity) {
    if (slope) std::fill(slope, slope + n, 0.0);
    return -1;
  }
  const double reach = s.scale + std::abs(value);
  if (slope) {
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
  nlopt_set_lower_bounds1(opt.get(), 0);
  nlopt_set_upper_bounds1(opt.get(), 1);
  nlopt_set_xtol_abs1(opt.get(), options.x_tolerance);
  if (options.initial_step > 0) nlopt_set_initial_step1(opt.get(), options.initial_step);
  return opt;
}

}  // namespace

void run_nlopt(const NloptOptions& options, Probe& probe, const Box& box, const Sample& sample,
               Eigen::VectorXd x, Random& random) {
  const auto n = static_cast<unsigned>(box.free());
  const OwnedOptimizer opt = make(options.algorithm, options, n);
  Session session{probe, box, sample.scale, opt.get(), {}, {}};
  nlopt_set_max_objective(opt.get(), objective, &session);
  nlopt_set_maxeval(opt.get(), static_cast<int>(probe.left()));
  if (options.local != NLOPT_NUM_ALGORITHMS) {
    nlopt_set_local_optimizer(opt.get(), make(options.local, options, n).get());
    nlopt_set_xtol_abs1(opt.get(), 0);
  }
  nlopt_srand(static_cast<unsigned long>(random.next()));
  double value = 0;
  nlopt_optimize(opt.get(), x.data(), &value);  // however it ends, the probe has kept the best
  session.caught.rethrow();
}

Climb nlopt_restarts(const NloptOptions& options, long parts) {
  return [=](Probe& probe, const Box& box, const Sample& sample, long part, Random random) {
    for (auto next = static_cast<std::size_t>(part); probe.left() > 0 && !probe.ended();
         next += static_cast<std::size_t>(parts)) {
      Eigen::VectorXd x(box.free());
      for (double& x_j : x) x_j = random.uniform();
      if (next < sample.starts.size()) x = sample.starts[next];
      const long before = probe.left();
      run_nlopt(options, probe, box, sample, x, random);
      if (probe.left() == before) return;
    }
  };
}

}  // namespace maxwrench
