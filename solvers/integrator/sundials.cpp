#include "solvers/integrator/sundials.h"

#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <stdexcept>

namespace maxwrench::sundials {

Eigen::Map<Eigen::VectorXd> view(N_Vector v) {
  return {N_VGetArrayPointer_Serial(v), static_cast<Eigen::Index>(N_VGetLength_Serial(v))};
}

void be_silent(int /*code*/, const char* /*module*/, const char* /*function*/, char* /*message*/,
               void* /*data*/) {}

Session::Session(Ode& ode, const IntegratorOptions& options)
    : ode_(ode), y_(ode.initial()), y_dot_(y_.size()), options_(options) {
  SUNContext context = nullptr;
  if (SUNContext_Create(nullptr, &context) != 0) {
    throw std::runtime_error("SUNDIALS: got no context, expected one");
  }
  context_ = {context, [](SUNContext c) { SUNContext_Free(&c); }};
  state_ = {new_vector(), N_VDestroy};
  view(state_.get()) = y_;
}

N_Vector Session::new_vector() const {
  return N_VNew_Serial(static_cast<sunindextype>(y_.size()), context_.get());
}

void Session::make_linear_solver() {
  const auto d = static_cast<sunindextype>(y_.size());
  matrix_ = {SUNDenseMatrix(d, d, context_.get()), SUNMatDestroy};
  linear_ = {SUNLinSol_Dense(state_.get(), matrix_.get(), context_.get()), SUNLinSolFree};
}

int Session::derivative(double t, N_Vector y, N_Vector y_dot, void* self) {
  auto& s = *static_cast<Session*>(self);
  return s.caught_.run<int>(kGiveUp, [&]() -> int {
    s.y_ = view(y);
    if (!s.ode_.derivative(t, s.y_, s.y_dot_)) return kNoValue;
    view(y_dot) = s.y_dot_;
    return kValue;
  });
}

int Session::root(double t, N_Vector y, double* g, void* self) {
  auto& s = *static_cast<Session*>(self);
  return s.caught_.run<int>(kGiveUp, [&]() -> int {
    s.y_ = view(y);
    s.g_.resize(s.ode_.roots());
    s.ode_.root(t, s.y_, s.g_);
    std::copy(s.g_.begin(), s.g_.end(), g);
    return kValue;
  });
}

int Session::first_root(const std::vector<int>& found) const {
  const auto is_root = [](int sign) { return sign != 0; };
  return static_cast<int>(std::find_if(found.begin(), found.end(), is_root) - found.begin());
}

std::string words(const char* library, char* name) {
  const std::unique_ptr<char, decltype(&std::free)> owned(name, std::free);
  return std::string(library) + ": " + owned.get();
}

}  // namespace maxwrench::sundials
