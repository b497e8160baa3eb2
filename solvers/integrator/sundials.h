#pragma once

#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nvector.h>

#include <cstdlib>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "maxwrench/integrator.h"
#include "solvers/caught.h"

// Code that the integrators of SUNDIALS share (Hindmarsh et al., 2005).

namespace maxwrench::sundials {

/// Flags that have the same meaning in CVODE, ARKODE and IDA.
enum Flag { kReached = 0, kReachedStop = 1, kFoundRoot = 2, kTooMuchWork = -1 };

template <class T>
using Owned = std::unique_ptr<T, std::function<void(T*)>>;

Eigen::Map<Eigen::VectorXd> view(N_Vector v);

/// Suppresses messages on stderr: flags report the errors.
void be_silent(int code, const char* module, const char* function, char* message, void* data);

/// A problem in the form that SUNDIALS expects: storage, and callbacks whose last argument is this
/// object.
class Session {
 public:
  Session(Ode& ode, const IntegratorOptions& options);

  Eigen::VectorXd state() const { return view(state_.get()); }
  void rethrow() { caught_.rethrow(); }

 protected:
  /// What callbacks return. kNoValue: there is no value here, try a shorter step.
  enum Answer { kValue = 0, kNoValue = 1, kGiveUp = -1 };

  static int derivative(double t, N_Vector y, N_Vector y_dot, void* self);
  static int root(double t, N_Vector y, double* g, void* self);

  N_Vector new_vector() const;
  /// A dense linear solver, for the implicit methods.
  void make_linear_solver();
  /// Stores the first failure of a call that prepares the integration.
  void require(int flag) {
    if (failure_ == 0) failure_ = flag;
  }
  /// The first component of g that has a sign in `found`.
  int first_root(const std::vector<int>& found) const;

  Ode& ode_;
  Caught caught_;  ///< from the callbacks
  Eigen::VectorXd y_, y_dot_, g_;
  const IntegratorOptions& options_;
  int failure_ = 0;                                   ///< a flag, which `advance` then returns
  Owned<std::remove_pointer_t<SUNContext>> context_;  // destroyed last
  Owned<_generic_N_Vector> state_;
  Owned<_generic_SUNMatrix> matrix_;
  Owned<_generic_SUNLinearSolver> linear_;
};

/// The loop over the times. A session must have
///   int advance(double t, double end, double& reached)  integrates to t, evaluates up to end only;
///   void rethrow()  rethrows exceptions of the callbacks;
///   Eigen::VectorXd state() const;   int found_root() const;   std::string words(int flag) const.
template <class S>
Status run(S& session, std::span<const double> times, OdeSolution& trajectory) {
  for (const double t : times.subspan(1)) {
    double reached = trajectory.t.back();
    const int flag = session.advance(t, times.back(), reached);
    session.rethrow();
    if (reached > trajectory.t.back()) {
      trajectory.t.push_back(reached);
      trajectory.y.push_back(session.state());
    }
    if (flag == kReached || flag == kReachedStop) continue;
    if (flag == kFoundRoot) {
      trajectory.root = session.found_root();
      break;
    }
    return trajectory.conclude(
        flag == kTooMuchWork ? Status::kBudgetExhausted : Status::kNumericalError,
        session.words(flag));
  }
  return trajectory.conclude(Status::kReached);
}

/// "library: NAME_OF_FLAG"; takes the name, which SUNDIALS allocates.
std::string words(const char* library, char* name);

}  // namespace maxwrench::sundials
