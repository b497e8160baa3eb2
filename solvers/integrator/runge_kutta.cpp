#include <cmath>

#include "solvers/integrator/check_request.h"
#include "solvers/integrator/makers.h"

namespace maxwrench {
namespace {

constexpr double kMostSteps = 1e15;
constexpr int kBisections = 60;  // halve a step down to rounding errors

/// One integration: its current state, and storage for a step.
class Walk {
 public:
  explicit Walk(Ode& ode, double t_0) : t(t_0), y(ode.initial()), ode_(ode) {
    for (Eigen::VectorXd* k : {&k1_, &k2_, &k3_, &k4_}) k->resize(y.size());
    g_.resize(ode.roots());
    if (ode.roots() > 0) ode.root(t, y, g_);
  }

  /// Advances by h. Returns false, and does not move, where the derivative has no value.
  bool step(double h) {
    if (!try_step(h)) return false;
    t += h;
    y.swap(next_);
    return true;
  }

  /// After a step of h from (t_0, y_0): the component of g that changed its sign, or -1. If there
  /// is one, goes back to the place of the change.
  int find_root(double t_0, const Eigen::VectorXd& y_0, double h) {
    if (ode_.roots() == 0) return -1;
    const Eigen::VectorXd g_0 = g_;
    int found = changed_sign(g_0);
    if (found < 0) return -1;
    double low = 0, high = h;
    for (int i = 0; i < kBisections; ++i) {
      const double middle = (low + high) / 2;
      t = t_0;
      y = y_0;
      step(middle);
      const int here = changed_sign(g_0);
      if (here >= 0) found = here;
      (here >= 0 ? high : low) = middle;
    }
    t = t_0;
    y = y_0;
    step(high);
    return found;
  }

  double t;
  Eigen::VectorXd y;

 private:
  bool try_step(double h) {
    if (!ode_.derivative(t, y, k1_)) return false;
    stage_ = y + h / 2 * k1_;
    if (!ode_.derivative(t + h / 2, stage_, k2_)) return false;
    stage_ = y + h / 2 * k2_;
    if (!ode_.derivative(t + h / 2, stage_, k3_)) return false;
    stage_ = y + h * k3_;
    if (!ode_.derivative(t + h, stage_, k4_)) return false;
    next_ = y + h / 6 * (k1_ + 2 * k2_ + 2 * k3_ + k4_);
    return true;
  }

  int changed_sign(const Eigen::VectorXd& g_0) {
    ode_.root(t, y, g_);
    for (Eigen::Index i = 0; i < g_.size(); ++i) {
      if (g_0[i] == 0) continue;  // it starts at zero
      if (g_[i] == 0 || (g_[i] > 0) != (g_0[i] > 0)) return static_cast<int>(i);
    }
    return -1;
  }

  Ode& ode_;
  Eigen::VectorXd k1_, k2_, k3_, k4_, stage_, next_, g_;
};

class RungeKutta final : public Integrator {
 public:
  Status integrate(Ode& ode, const IntegratorOptions& options, std::span<const double> times,
                   OdeSolution& trajectory) override {
    check_request(options, times);
    trajectory.start(times[0], ode.initial());
    Walk walk(ode, times[0]);
    long left = options.max_steps;
    for (std::size_t i = 1; i < times.size(); ++i) {
      const double length = times[i] - times[i - 1];
      if (!(length / options.step < kMostSteps)) {
        return trajectory.conclude(Status::kBudgetExhausted, "runge_kutta: the step is too short");
      }
      const auto steps = static_cast<long>(std::ceil(length / options.step * (1 - 1e-12)));
      const Status status = advance(walk, times[i - 1], length, steps, left, trajectory);
      if (walk.t > trajectory.t.back()) {
        const bool arrived = status == Status::kReached && trajectory.root < 0;
        trajectory.t.push_back(arrived ? times[i] : walk.t);
        trajectory.y.push_back(walk.y);
      }
      if (status != Status::kReached || trajectory.root >= 0) return status;
    }
    return trajectory.conclude(Status::kReached);
  }

 private:
  static Status advance(Walk& walk, double begin, double length, long steps, long& left,
                        OdeSolution& trajectory) {
    const double h = length / static_cast<double>(steps);
    for (long k = 0; k < steps; ++k) {
      if (left-- <= 0) {
        return trajectory.conclude(Status::kBudgetExhausted, "runge_kutta: no steps left");
      }
      walk.t = begin + static_cast<double>(k) * h;
      const double t_0 = walk.t;
      const Eigen::VectorXd y_0 = walk.y;
      if (!walk.step(h) || !walk.y.allFinite()) {
        walk.t = t_0;
        walk.y = y_0;
        return trajectory.conclude(Status::kNumericalError,
                                   "runge_kutta: no derivative within a step");
      }
      trajectory.root = walk.find_root(t_0, y_0, h);
      if (trajectory.root >= 0) return trajectory.conclude(Status::kReached);
    }
    return trajectory.conclude(Status::kReached);
  }
};

}  // namespace

std::unique_ptr<Integrator> make_runge_kutta() { return std::make_unique<RungeKutta>(); }

}  // namespace maxwrench
