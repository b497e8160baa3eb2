#include "solvers/integrator/cvode.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <functional>
#include <stdexcept>

namespace maxwrench {
namespace {

template <class T>
using Owned = std::unique_ptr<T, std::function<void(T*)>>;

Eigen::Map<Eigen::VectorXd> view(N_Vector v) {
  return {N_VGetArrayPointer_Serial(v), static_cast<Eigen::Index>(N_VGetLength_Serial(v))};
}

/// One integration: what SUNDIALS hands back to its callbacks.
class Session {
 public:
  Session(Ode& ode, const IntegratorOptions& options, double t_0)
      : ode_(ode), y_(ode.initial()), options_(options) {
    SUNContext context = nullptr;
    SUNContext_Create(nullptr, &context);
    context_ = {context, [](SUNContext c) { SUNContext_Free(&c); }};
    const auto d = static_cast<sunindextype>(y_.size());
    state_ = {N_VNew_Serial(d, context), N_VDestroy};
    view(state_.get()) = y_;
    matrix_ = {SUNDenseMatrix(d, d, context), SUNMatDestroy};
    linear_ = {SUNLinSol_Dense(state_.get(), matrix_.get(), context), SUNLinSolFree};
    memory_ = {CVodeCreate(CV_BDF, context), [](void* m) { CVodeFree(&m); }};
    void* m = memory_.get();
    // What goes wrong is reported by flags.
    CVodeSetErrHandlerFn(
        m, [](int, const char*, const char*, char*, void*) {}, nullptr);
    [[maybe_unused]] const bool ready =
        CVodeInit(m, derivative, t_0, state_.get()) == CV_SUCCESS &&
        CVodeSetUserData(m, this) == CV_SUCCESS &&
        CVodeSStolerances(m, options.relative_tolerance, options.absolute_tolerance) ==
            CV_SUCCESS &&
        CVodeSetLinearSolver(m, linear_.get(), matrix_.get()) == CV_SUCCESS;
    assert(ready);
    if (ode.jacobian(t_0, y_, jacobian_)) CVodeSetJacFn(m, jacobian);
    if (ode.roots() > 0) CVodeRootInit(m, ode.roots(), root);
  }

  /// On to the time `t`, never evaluating beyond `end`; a flag of CVODE.
  int advance(double t, double end, double& reached) {
    void* m = memory_.get();
    long used = 0;
    CVodeGetNumSteps(m, &used);
    if (used >= options_.max_steps) return CV_TOO_MUCH_WORK;
    CVodeSetMaxNumSteps(m, options_.max_steps - used);
    CVodeSetStopTime(m, end);
    return CVode(m, t, state_.get(), &reached, CV_NORMAL);
  }

  Eigen::VectorXd state() const { return view(state_.get()); }

  int found_root() const {
    std::vector<int> found(ode_.roots());
    CVodeGetRootInfo(memory_.get(), found.data());
    return static_cast<int>(
        std::find_if(found.begin(), found.end(), [](int sign) { return sign != 0; }) -
        found.begin());
  }

 private:
  /// CVODE takes a positive return for "try a shorter step".
  static int derivative(double t, N_Vector y, N_Vector y_dot, void* self) {
    auto& s = *static_cast<Session*>(self);
    s.y_ = view(y);
    if (!s.ode_.derivative(t, s.y_, s.y_dot_)) return 1;
    view(y_dot) = s.y_dot_;
    return 0;
  }
  static int jacobian(double t, N_Vector y, N_Vector /*y_dot*/, SUNMatrix df_dy, void* self,
                      N_Vector /*a*/, N_Vector /*b*/, N_Vector /*c*/) {
    auto& s = *static_cast<Session*>(self);
    s.y_ = view(y);
    if (!s.ode_.jacobian(t, s.y_, s.jacobian_)) return 1;
    Eigen::Map<Eigen::MatrixXd>(SUNDenseMatrix_Data(df_dy), s.y_.size(), s.y_.size()) = s.jacobian_;
    return 0;
  }
  static int root(double t, N_Vector y, double* g, void* self) {
    auto& s = *static_cast<Session*>(self);
    s.y_ = view(y);
    s.g_.resize(s.ode_.roots());
    s.ode_.root(t, s.y_, s.g_);
    std::copy(s.g_.begin(), s.g_.end(), g);
    return 0;
  }

  Ode& ode_;
  Eigen::VectorXd y_, y_dot_, g_;
  Eigen::MatrixXd jacobian_;
  const IntegratorOptions& options_;
  Owned<std::remove_pointer_t<SUNContext>> context_;  // destroyed last
  Owned<_generic_N_Vector> state_;
  Owned<_generic_SUNMatrix> matrix_;
  Owned<_generic_SUNLinearSolver> linear_;
  Owned<void> memory_;
};

std::string words(int flag) {
  const std::unique_ptr<char, decltype(&std::free)> name(CVodeGetReturnFlagName(flag), std::free);
  return std::string("cvode: ") + name.get();
}

void check(std::span<const double> times) {
  const bool increase =
      std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end();
  if (times.size() < 2 || !increase)
    throw std::invalid_argument("integrator times: expected at least two, increasing");
}

/// CVODE of SUNDIALS: backward differentiation formulas of orders 1 to 5 with Newton's method on a
/// dense Jacobian (Hindmarsh et al., 2005), for gradient flows are stiff near a maximum.
class Cvode final : public Integrator {
 public:
  Status integrate(Ode& ode, const IntegratorOptions& options, std::span<const double> times,
                   Trajectory& trajectory) override {
    check(times);
    trajectory = {{times[0]}, {ode.initial()}, -1, ""};
    Session session(ode, options, times[0]);
    for (const double t : times.subspan(1)) {
      double reached = trajectory.t.back();
      const int flag = session.advance(t, times.back(), reached);
      if (reached > trajectory.t.back()) {
        trajectory.t.push_back(reached);
        trajectory.y.push_back(session.state());
      }
      if (flag == CV_SUCCESS || flag == CV_TSTOP_RETURN) continue;
      if (flag == CV_ROOT_RETURN) {
        trajectory.root = session.found_root();
        return Status::kOptimal;
      }
      trajectory.reason = words(flag);
      return flag == CV_TOO_MUCH_WORK ? Status::kBudgetExhausted : Status::kNumericalError;
    }
    return Status::kOptimal;
  }
};

}  // namespace

std::unique_ptr<Integrator> make_cvode() { return std::make_unique<Cvode>(); }

}  // namespace maxwrench
