#include <cvodes/cvodes.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "solvers/integrator/check_request.h"
#include "solvers/integrator/makers.h"
#include "solvers/integrator/sundials.h"

namespace maxwrench {
namespace {

using sundials::Owned;
using sundials::view;

/// One integration by CVODE.
class CvodeSession : public sundials::Session {
 public:
  CvodeSession(Ode& ode, const IntegratorOptions& options, double t_0, int method)
      : Session(ode, options) {
    memory_ = {CVodeCreate(method, context_.get()), [](void* m) { CVodeFree(&m); }};
    void* m = memory_.get();
    CVodeSetErrHandlerFn(m, sundials::be_silent, nullptr);
    require(CVodeInit(m, derivative, t_0, state_.get()));
    require(CVodeSetUserData(m, static_cast<Session*>(this)));
    require(CVodeSStolerances(m, options.relative_tolerance, options.absolute_tolerance));
    if (method == CV_BDF) {
      use_newton(t_0);
    } else {
      use_fixed_point();
    }
    if (ode.roots() > 0) require(CVodeRootInit(m, ode.roots(), root));
  }

  int advance(double t, double end, double& reached) {
    if (failure_ != 0) return failure_;
    void* m = memory_.get();
    long used = 0;
    CVodeGetNumSteps(m, &used);
    if (used >= options_.max_steps) return CV_TOO_MUCH_WORK;
    CVodeSetMaxNumSteps(m, options_.max_steps - used);
    CVodeSetStopTime(m, end);
    return CVode(m, t, state_.get(), &reached, CV_NORMAL);
  }

  int found_root() const {
    std::vector<int> found(static_cast<std::size_t>(ode_.roots()));
    CVodeGetRootInfo(memory_.get(), found.data());
    return first_root(found);
  }

  static std::string words(int flag) {
    return sundials::words("cvode", CVodeGetReturnFlagName(flag));
  }

 private:
  void use_newton(double t_0) {
    make_linear_solver();
    require(CVodeSetLinearSolver(memory_.get(), linear_.get(), matrix_.get()));
    if (ode_.jacobian(t_0, y_, jacobian_)) require(CVodeSetJacFn(memory_.get(), jacobian));
  }

  void use_fixed_point() {
    nonlinear_ = {SUNNonlinSol_FixedPoint(state_.get(), 0, context_.get()), SUNNonlinSolFree};
    require(CVodeSetNonlinearSolver(memory_.get(), nonlinear_.get()));
  }

  static int jacobian(double t, N_Vector y, N_Vector /*y_dot*/, SUNMatrix df_dy, void* self,
                      N_Vector /*a*/, N_Vector /*b*/, N_Vector /*c*/) {
    auto& s = static_cast<CvodeSession&>(*static_cast<Session*>(self));
    return s.caught_.run<int>(kGiveUp, [&]() -> int {
      s.y_ = view(y);
      if (!s.ode_.jacobian(t, s.y_, s.jacobian_)) return kNoValue;
      const Eigen::Index d = s.y_.size();
      Eigen::Map<Eigen::MatrixXd>(SUNDenseMatrix_Data(df_dy), d, d) = s.jacobian_;
      return kValue;
    });
  }

  Eigen::MatrixXd jacobian_;
  Owned<_generic_SUNNonlinearSolver> nonlinear_;
  Owned<void> memory_;
};

/// CVODE of SUNDIALS with a family of multistep formulas.
class Cvode final : public Integrator {
 public:
  explicit Cvode(int method) : method_(method) {}

  Status integrate(Ode& ode, const IntegratorOptions& options, std::span<const double> times,
                   OdeSolution& trajectory) override {
    check_request(options, times);
    trajectory.start(times[0], ode.initial());
    CvodeSession session(ode, options, times[0], method_);
    return sundials::run(session, times, trajectory);
  }

 private:
  int method_;
};

}  // namespace

std::unique_ptr<Integrator> make_cvode() { return std::make_unique<Cvode>(CV_BDF); }
std::unique_ptr<Integrator> make_cvode_adams() { return std::make_unique<Cvode>(CV_ADAMS); }

}  // namespace maxwrench
