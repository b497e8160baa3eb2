#include "solvers/certify/bound/equation_program.h"

#include <cmath>
#include <numbers>

#include "solvers/certify/bound/loop_model.h"

namespace maxwrench {

EquationProgram::EquationProgram(const LoopModel& model)
    : model_(model),
      program_(Eigen::MatrixXd(model.m, 0), Eigen::VectorXd(), Eigen::VectorXd(),
               ProgramPoints::kMost),
      signs_(model),
      no_lambda_(Eigen::VectorXd::Zero(model.n)),
      entries_(model.m) {
  ProgramPoints at_both_ends;
  at_both_ends.add_corners(model.coordinates.chain, model.size);
  for (const int id : at_both_ends.ids()) {
    if (id < model.size) corners_.add(id);  // f does not depend on t
  }
}

bool EquationProgram::exclude(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                              LoopBox& box, const LoopLinear& linear, BoxProof& proof) {
  if (model_.m == 0 || !find(lower, upper, box, linear)) return false;
  proof.exclude(nu_);
  return true;
}

bool EquationProgram::find(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, LoopBox& box,
                           const LoopLinear& linear) {
  constexpr int kMostRounds = 24;
  constexpr int kMostSteps = 120;
  constexpr double kEnough = -1;  // any negative number: nu has no unit
  basis_.clear();
  points_ = corners_;
  write_points(0, box, linear);
  for (int round = 0; round < kMostRounds; ++round) {
    const double least = program_.solve(kEnough, kMostSteps, basis_, solved_);
    if (least > kEnough) return false;
    nu_.noalias() = linear.M().transpose() * solved_;
    nu_ = nu_.cast<float>().cast<double>();  // enough, and compresses better
    box.weigh(no_lambda_, nu_);
    violations_ = -box.g();
    if (violations_.maxCoeff() < 0) return signs_.sign(lower, upper, nu_) > 0;
    const Eigen::Index before = points_.count();
    if (!points_.add_largest(violations_, 0)) return false;
    write_points(before, box, linear);
  }
  return false;
}

/// Writes the columns of the points from `first` on. Their costs are in [0, 1) and differ: with
/// equal costs the simplex stalls.
void EquationProgram::write_points(Eigen::Index first, LoopBox& box, const LoopLinear& linear) {
  program_.set_points(points_.count());
  for (Eigen::Index i = first; i < points_.count(); ++i) {
    const int id = points_.ids()[static_cast<std::size_t>(i)];
    box.read(id);
    entries_.noalias() = linear.M() * box.f();
    for (Eigen::Index j = 0; j < model_.m; ++j) program_.row(j)[i] = entries_[j];
    program_.costs()[i] = std::fmod(id * std::numbers::phi, 1.0);
  }
}

}  // namespace maxwrench
