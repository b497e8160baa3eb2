#include <ida/ida.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "solvers/integrator/check_request.h"
#include "solvers/integrator/makers.h"
#include "solvers/integrator/sundials.h"

namespace maxwrench {
namespace {

using sundials::view;

/// One integration by IDA from a consistent y'(t_0).
class IdaSession : public sundials::Session {
 public:
  IdaSession(Ode& ode, const IntegratorOptions& options, double t_0, const Eigen::VectorXd& y_dot_0)
      : Session(ode, options), F_(y_.size()) {
    rate_ = {new_vector(), N_VDestroy};
    view(rate_.get()) = y_dot_0;
    make_linear_solver();
    memory_ = {IDACreate(context_.get()), [](void* m) { IDAFree(&m); }};
    void* m = memory_.get();
    IDASetErrHandlerFn(m, sundials::be_silent, nullptr);
    require(IDAInit(m, residual, t_0, state_.get(), rate_.get()));
    require(IDASetUserData(m, static_cast<Session*>(this)));
    require(IDASStolerances(m, options.relative_tolerance, options.absolute_tolerance));
    require(IDASetLinearSolver(m, linear_.get(), matrix_.get()));
    if (ode.residual_jacobian(t_0, y_, y_dot_0, 1, dF_)) require(IDASetJacFn(m, jacobian));
    if (ode.roots() > 0) require(IDARootInit(m, ode.roots(), root_of_pair));
  }

  int advance(double t, double end, double& reached) {
    if (failure_ != 0) return failure_;
    void* m = memory_.get();
    long used = 0;
    IDAGetNumSteps(m, &used);
    if (used >= options_.max_steps) return IDA_TOO_MUCH_WORK;
    IDASetMaxNumSteps(m, options_.max_steps - used);
    IDASetStopTime(m, end);
    return IDASolve(m, t, &reached, state_.get(), rate_.get(), IDA_NORMAL);
  }

  int found_root() const {
    std::vector<int> found(static_cast<std::size_t>(ode_.roots()));
    IDAGetRootInfo(memory_.get(), found.data());
    return first_root(found);
  }

  static std::string words(int flag) { return sundials::words("ida", IDAGetReturnFlagName(flag)); }

 private:
  static int residual(double t, N_Vector y, N_Vector y_dot, N_Vector F, void* self) {
    auto& s = static_cast<IdaSession&>(*static_cast<Session*>(self));
    return s.caught_.run<int>(kGiveUp, [&]() -> int {
      s.y_ = view(y);
      s.y_dot_ = view(y_dot);
      if (!s.ode_.residual(t, s.y_, s.y_dot_, s.F_)) return kNoValue;
      view(F) = s.F_;
      return kValue;
    });
  }
  static int jacobian(double t, double alpha, N_Vector y, N_Vector y_dot, N_Vector /*F*/,
                      SUNMatrix dF, void* self, N_Vector /*a*/, N_Vector /*b*/, N_Vector /*c*/) {
    auto& s = static_cast<IdaSession&>(*static_cast<Session*>(self));
    return s.caught_.run<int>(kGiveUp, [&]() -> int {
      s.y_ = view(y);
      s.y_dot_ = view(y_dot);
      if (!s.ode_.residual_jacobian(t, s.y_, s.y_dot_, alpha, s.dF_)) return kNoValue;
      const Eigen::Index d = s.y_.size();
      Eigen::Map<Eigen::MatrixXd>(SUNDenseMatrix_Data(dF), d, d) = s.dF_;
      return kValue;
    });
  }
  static int root_of_pair(double t, N_Vector y, N_Vector /*y_dot*/, double* g, void* self) {
    return root(t, y, g, self);
  }

  Eigen::VectorXd F_;
  Eigen::MatrixXd dF_;
  sundials::Owned<_generic_N_Vector> rate_;
  sundials::Owned<void> memory_;
};

class Ida final : public Integrator {
 public:
  Status integrate(Ode& ode, const IntegratorOptions& options, std::span<const double> times,
                   OdeSolution& trajectory) override {
    check_request(options, times);
    trajectory.start(times[0], ode.initial());
    Eigen::VectorXd y_dot(ode.dimension());
    if (!ode.derivative(times[0], ode.initial(), y_dot)) {
      return trajectory.conclude(Status::kNumericalError, "ida: no derivative at the first time");
    }
    IdaSession session(ode, options, times[0], y_dot);
    return sundials::run(session, times, trajectory);
  }
};

}  // namespace

std::unique_ptr<Integrator> make_ida() { return std::make_unique<Ida>(); }

}  // namespace maxwrench
