#include <arkode/arkode_erkstep.h>

#include "solvers/integrator/check_request.h"
#include "solvers/integrator/makers.h"
#include "solvers/integrator/sundials.h"

namespace maxwrench {
namespace {

constexpr int kOrder = 5;

/// One integration by ERKStep.
class ArkodeSession : public sundials::Session {
 public:
  ArkodeSession(Ode& ode, const IntegratorOptions& options, double t_0) : Session(ode, options) {
    memory_ = {ERKStepCreate(derivative, t_0, state_.get(), context_.get()),
               [](void* m) { ERKStepFree(&m); }};
    void* m = memory_.get();
    ERKStepSetErrHandlerFn(m, sundials::be_silent, nullptr);
    require(ERKStepSetOrder(m, kOrder));
    require(ERKStepSetUserData(m, static_cast<Session*>(this)));
    require(ERKStepSStolerances(m, options.relative_tolerance, options.absolute_tolerance));
    if (ode.roots() > 0) require(ERKStepRootInit(m, ode.roots(), root));
  }

  int advance(double t, double end, double& reached) {
    if (failure_ != 0) return failure_;
    void* m = memory_.get();
    long used = 0;
    ERKStepGetNumSteps(m, &used);
    if (used >= options_.max_steps) return ARK_TOO_MUCH_WORK;
    ERKStepSetMaxNumSteps(m, options_.max_steps - used);
    ERKStepSetStopTime(m, end);
    const double before = reached;
    const int flag = ERKStepEvolve(m, t, state_.get(), &reached, ARK_NORMAL);
    // After a failure, the state is that of a stage, not of the returned time.
    if (flag < 0 && flag != ARK_TOO_MUCH_WORK) reached = before;
    return flag;
  }

  int found_root() const {
    std::vector<int> found(static_cast<std::size_t>(ode_.roots()));
    ERKStepGetRootInfo(memory_.get(), found.data());
    return first_root(found);
  }

  static std::string words(int flag) {
    return sundials::words("arkode", ERKStepGetReturnFlagName(flag));
  }

 private:
  sundials::Owned<void> memory_;
};

class Arkode final : public Integrator {
 public:
  Status integrate(Ode& ode, const IntegratorOptions& options, std::span<const double> times,
                   OdeSolution& trajectory) override {
    check_request(options, times);
    trajectory.start(times[0], ode.initial());
    ArkodeSession session(ode, options, times[0]);
    return sundials::run(session, times, trajectory);
  }
};

}  // namespace

std::unique_ptr<Integrator> make_arkode() { return std::make_unique<Arkode>(); }

}  // namespace maxwrench
