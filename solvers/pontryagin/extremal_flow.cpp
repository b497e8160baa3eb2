#include "solvers/pontryagin/extremal_flow.h"

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <stdexcept>
#include <type_traits>
#include <vector>

#include "solvers/caught.h"
#include "solvers/integrator/sundials.h"

namespace maxwrench {

using sundials::Owned;
using sundials::view;

/// The memory of CVODES, which all integrations share.
class ExtremalFlow::Session {
 public:
  explicit Session(CanonicalEquations& equations)
      : equations_(equations), d_(equations.size()), sensitivities_(d_ + 1) {
    SUNContext context = nullptr;
    if (SUNContext_Create(nullptr, &context) != 0) {
      throw std::runtime_error("SUNDIALS: got no context, expected one");
    }
    context_ = {context, [](SUNContext c) { SUNContext_Free(&c); }};
    state_ = new_vector();
    tolerance_ = new_vector();
    while (static_cast<int>(slopes_owned_.size()) < sensitivities_) {
      slopes_owned_.push_back(new_vector());
    }
    for (const Owned<_generic_N_Vector>& each : slopes_owned_) slopes_.push_back(each.get());
    view(state_.get()).setZero();
    for (N_Vector each : slopes_) view(each).setZero();
    memory_ = {CVodeCreate(CV_ADAMS, context), [](void* m) { CVodeFree(&m); }};
    prepare();
  }

  bool advance(double duration, Eigen::VectorXd& z, double m, double costate,
               Eigen::MatrixXd* slopes) {
    void* memory = memory_.get();
    m_ = m;
    view(state_.get()) = z;
    auto tolerance = view(tolerance_.get());
    tolerance.setConstant(kTolerance);
    tolerance.segment(d_ / 2, d_ / 2) *= costate;
    for (int i = 0; i < sensitivities_; ++i) {
      auto column = view(slopes_[static_cast<std::size_t>(i)]);
      column.setZero();
      if (i < d_) column[i] = 1;
    }
    double reached = 0;
    bool fine = CVodeReInit(memory, 0, state_.get()) == CV_SUCCESS &&
                CVodeSVtolerances(memory, kTolerance, tolerance_.get()) == CV_SUCCESS &&
                CVodeSetStopTime(memory, duration) == CV_SUCCESS;
    if (fine && slopes) {
      fine = CVodeSensReInit(memory, CV_STAGGERED, slopes_.data()) == CV_SUCCESS;
    } else if (fine) {
      fine = CVodeSensToggleOff(memory) == CV_SUCCESS;
    }
    const int flag = fine ? CVode(memory, duration, state_.get(), &reached, CV_NORMAL) : -1;
    caught_.rethrow();
    if (flag != CV_SUCCESS && flag != CV_TSTOP_RETURN) return false;
    z = view(state_.get());
    if (!slopes) return true;
    if (CVodeGetSens(memory, &reached, slopes_.data()) != CV_SUCCESS) return false;
    slopes->resize(d_, sensitivities_);
    for (int i = 0; i < sensitivities_; ++i) {
      slopes->col(i) = view(slopes_[static_cast<std::size_t>(i)]);
    }
    return slopes->allFinite();
  }

 private:
  static constexpr double kTolerance = 1e-8;
  static constexpr long kMostSteps = 5000;
  /// What callbacks return. kNoValue: try a shorter step.
  enum Answer { kValue = 0, kNoValue = 1, kGiveUp = -1 };

  Owned<_generic_N_Vector> new_vector() const {
    return {N_VNew_Serial(static_cast<sunindextype>(d_), context_.get()), N_VDestroy};
  }

  void prepare() {
    void* memory = memory_.get();
    CVodeSetErrHandlerFn(memory, sundials::be_silent, nullptr);
    int failure = CVodeInit(memory, rates, 0, state_.get());
    const auto require = [&failure](int flag) {
      if (failure == 0) failure = flag;
    };
    view(tolerance_.get()).setOnes();
    require(CVodeSVtolerances(memory, kTolerance, tolerance_.get()));
    require(CVodeSetUserData(memory, this));
    require(CVodeSetMaxNumSteps(memory, kMostSteps));
    const auto d = static_cast<sunindextype>(d_);
    matrix_ = {SUNDenseMatrix(d, d, context_.get()), SUNMatDestroy};
    linear_ = {SUNLinSol_Dense(state_.get(), matrix_.get(), context_.get()), SUNLinSolFree};
    require(CVodeSetLinearSolver(memory, linear_.get(), matrix_.get()));
    require(CVodeSetJacFn(memory, jacobian));
    require(CVodeSensInit(memory, sensitivities_, CV_STAGGERED, sensitivity_rates, slopes_.data()));
    std::vector<double> tolerances(static_cast<std::size_t>(sensitivities_), kTolerance);
    require(CVodeSensSStolerances(memory, kTolerance, tolerances.data()));
    if (failure != 0) throw std::runtime_error("CVODES: got an error, expected none");
  }

  static int rates(double /*t*/, N_Vector z, N_Vector z_dot, void* self) {
    auto& s = *static_cast<Session*>(self);
    return s.caught_.run<int>(kGiveUp, [&]() -> int {
      s.z_ = view(z);
      if (!s.equations_.rates(s.z_, s.m_, s.z_dot_)) return kNoValue;
      view(z_dot) = s.z_dot_;
      return kValue;
    });
  }

  static int jacobian(double /*t*/, N_Vector z, N_Vector /*z_dot*/, SUNMatrix J, void* self,
                      N_Vector /*a*/, N_Vector /*b*/, N_Vector /*c*/) {
    auto& s = *static_cast<Session*>(self);
    return s.caught_.run<int>(kGiveUp, [&]() -> int {
      s.z_ = view(z);
      if (!s.equations_.linearize(s.z_, s.m_, s.z_dot_, s.by_z_, s.by_m_)) return kNoValue;
      Eigen::Map<Eigen::MatrixXd>(SUNDenseMatrix_Data(J), s.d_, s.d_) = s.by_z_;
      return kValue;
    });
  }

  /// S' = F_z S, and + F_m for the column of m.
  static int sensitivity_rates(int count, double /*t*/, N_Vector z, N_Vector /*z_dot*/,
                               N_Vector* slopes, N_Vector* slopes_dot, void* self, N_Vector /*a*/,
                               N_Vector /*b*/) {
    auto& s = *static_cast<Session*>(self);
    return s.caught_.run<int>(kGiveUp, [&]() -> int {
      s.z_ = view(z);
      if (!s.equations_.linearize(s.z_, s.m_, s.z_dot_, s.by_z_, s.by_m_)) return kNoValue;
      for (int i = 0; i < count; ++i) {
        view(slopes_dot[i]).noalias() = s.by_z_ * view(slopes[i]);
        if (i == s.d_) view(slopes_dot[i]) += s.by_m_;
      }
      return kValue;
    });
  }

  CanonicalEquations& equations_;
  int d_, sensitivities_;
  double m_ = 0;
  Caught caught_;
  Eigen::VectorXd z_, z_dot_, by_m_;
  Eigen::MatrixXd by_z_;
  Owned<std::remove_pointer_t<SUNContext>> context_;  // destroyed last
  Owned<_generic_N_Vector> state_, tolerance_;
  std::vector<Owned<_generic_N_Vector>> slopes_owned_;
  std::vector<N_Vector> slopes_;
  Owned<_generic_SUNMatrix> matrix_;
  Owned<_generic_SUNLinearSolver> linear_;
  Owned<void> memory_;
};

ExtremalFlow::ExtremalFlow(CanonicalEquations& equations)
    : session_(std::make_unique<Session>(equations)) {}
ExtremalFlow::~ExtremalFlow() = default;

bool ExtremalFlow::advance(double duration, Eigen::VectorXd& z, double m, double costate,
                           Eigen::MatrixXd* slopes) {
  return session_->advance(duration, z, m, costate, slopes);
}

}  // namespace maxwrench
