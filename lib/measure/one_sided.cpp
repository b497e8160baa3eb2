#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/measure/closed_form.h"
#include "maxwrench/posture.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {
namespace {

/// Extends a closed form for free columns to programs in which some columns may only push (w_j >=
/// 0) or must be zero. The problem is convex. If the columns that are zero at the optimum are left
/// out, the closed form gives the optimum; for any other set its answer violates a sign or is no
/// better. The measure therefore takes the best answer over all sets of resting columns, which
/// needs 2^s closed forms for s one-sided columns. A resting column is optimal if its reduced slope
/// c_w + (J'W)'lambda does not point inwards.
///
/// Each number of columns has a closed form of its own, so that no matrix changes its size.
class OneSided : public Measure {
 public:
  explicit OneSided(std::function<std::unique_ptr<Measure>()> make) : make_(std::move(make)) {
    add_form();
  }

  void evaluate_well_formed(const Posture& posture, const WrenchProgram& program, bool efforts,
                            Capability& capability) override {
    sort_columns(program);
    if (!supported_) {
      without_answer(Status::kNumericalError,
                     "closed forms support at most 12 wrench columns, and contact limits of zero "
                     "or infinity only",
                     capability);
      return;
    }
    if (sided_.empty() && free_.size() == static_cast<std::size_t>(program.columns())) {
      return forms_[0]->measure->evaluate_well_formed(posture, program, efforts, capability);
    }
    const unsigned sets = 1U << sided_.size();
    unsigned best = 0;
    double most = -kInfinity;
    for (unsigned moving = 0; moving < sets; ++moving) {
      const Capability& answer = solve(posture, program, moving, false);
      const bool valid = answer.status == Status::kOptimal && signs_hold(program, answer);
      if (!valid || !(answer.beta > most)) continue;
      most = answer.beta;
      best = moving;
    }
    expand(program, solve(posture, program, best, efforts), efforts, capability);
  }

 private:
  /// The closed form for one number of columns.
  struct Form {
    std::unique_ptr<Measure> measure;
    WrenchProgram program;
    Capability capability;
  };

  void add_form() {
    forms_.push_back(std::make_unique<Form>());
    forms_.back()->measure = make_();
  }

  void sort_columns(const WrenchProgram& program) {
    free_.clear();
    sided_.clear();
    supported_ = true;
    for (int j = 0; j < program.columns(); ++j) {
      const double low = program.w_min[j], high = program.w_max[j];
      if (low == 0 && high == 0) continue;
      const bool free = low == -kInfinity && high == kInfinity;
      (free ? free_ : sided_).push_back(j);
      supported_ &= free || ((low == 0 || low == -kInfinity) && (high == 0 || high == kInfinity));
    }
    supported_ &= free_.size() + sided_.size() <= kMaxColumns;
  }

  /// The closed form on the free columns and on the one-sided columns whose bit in `moving` is set.
  const Capability& solve(const Posture& posture, const WrenchProgram& program, unsigned moving,
                          bool efforts) {
    kept_ = free_;
    for (std::size_t i = 0; i < sided_.size(); ++i) {
      if (moving >> i & 1U) kept_.push_back(sided_[i]);
    }
    std::sort(kept_.begin(), kept_.end());
    while (forms_.size() <= kept_.size()) add_form();
    Form& form = *forms_[kept_.size()];
    const auto own = static_cast<int>(program.W.cols());
    const auto k = static_cast<Eigen::Index>(kept_.size());
    WrenchProgram& reduced = form.program;
    reduced.actuation = program.actuation;
    reduced.W = program.W;
    reduced.C_2.resize(6, k - own);
    reduced.c_w.resize(k);
    reduced.JtW.resize(program.JtW.rows(), k);
    reduced.tau_d = program.tau_d;
    reduced.w_min.setConstant(k, -kInfinity);
    reduced.w_max.setConstant(k, kInfinity);
    for (Eigen::Index i = 0; i < k; ++i) {
      const int j = kept_[static_cast<std::size_t>(i)];
      if (j >= own) reduced.C_2.col(i - own) = program.C_2.col(j - own);
      reduced.c_w[i] = program.c_w[j];
      reduced.JtW.col(i) = program.JtW.col(j);
    }
    form.capability.clear();
    form.measure->evaluate_well_formed(posture, reduced, efforts, form.capability);
    return form.capability;
  }

  bool signs_hold(const WrenchProgram& program, const Capability& capability) const {
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      const double w = capability.w[static_cast<Eigen::Index>(i)];
      if (w < program.w_min[kept_[i]] || w > program.w_max[kept_[i]]) return false;
    }
    return true;
  }

  /// The answer on the kept columns, with zeros for the resting ones.
  void expand(const WrenchProgram& program, const Capability& answer, bool efforts,
              Capability& capability) const {
    capability.iterations = answer.iterations;
    if (answer.status != Status::kOptimal) {
      without_answer(answer.status, answer.reason.c_str(), capability);
      return;
    }
    capability.conclude(Status::kOptimal);
    const auto own = static_cast<int>(program.W.cols());
    capability.beta = answer.beta;
    capability.h = answer.h;
    capability.lambda = answer.lambda;
    capability.beta_J = answer.beta_J;
    capability.w.setZero(program.columns());
    capability.h_2.setZero();
    capability.beta_J2.setZero(6, answer.beta_J.cols());
    capability.beta_C2.setZero(6, program.columns() - own);
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      capability.w[kept_[i]] = answer.w[column];
      if (kept_[i] >= own) {
        capability.beta_C2.col(kept_[i] - own) = answer.beta_C2.col(column - own);
      }
    }
    if (static_cast<int>(kept_.size()) > own) {
      capability.h_2 = answer.h_2;
      capability.beta_J2 = answer.beta_J2;
    }
    if (!efforts) return;
    capability.u = answer.u;
    capability.residual = answer.residual;
    // d beta = load' d(J'W) w: if the measure depends on tau_d, load is lambda.
    Eigen::VectorXd load = answer.lambda;
    if (!answer.h.isZero(0)) load = answer.beta_J.transpose() * answer.h / answer.h.squaredNorm();
    for (const int j : sided_) {
      if (std::binary_search(kept_.begin(), kept_.end(), j)) continue;
      const double slope = program.c_w[j] + program.JtW.col(j).dot(load);
      const double inwards = program.w_min[j] == 0 ? slope : -slope;
      if (!(inwards <= capability.residual.dual)) capability.residual.dual = inwards;
      if (std::isnan(inwards)) break;
    }
  }

  std::function<std::unique_ptr<Measure>()> make_;
  /// Indexed by the number of columns. The first is for programs without one-sided columns.
  std::vector<std::unique_ptr<Form>> forms_;
  std::vector<int> free_, sided_, kept_;
  bool supported_ = true;
};

}  // namespace

std::unique_ptr<Measure> make_one_sided(std::function<std::unique_ptr<Measure>()> closed_form) {
  return std::make_unique<OneSided>(std::move(closed_form));
}

}  // namespace maxwrench
