#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/measure/closed_form.h"
#include "lib/wrench_program.h"

namespace maxwrench {
namespace {

/// A closed form for free columns, where some may only push (w_j >= 0) or may do nothing. The
/// problem is convex: with the columns that rest at zero in the optimum left out, the closed form
/// gives the optimum, and what it gives for other sets either breaks a sign or is no better. So the
/// best over all sets of resting columns is taken, 2^s closed forms for s one-sided columns. A
/// column rests rightly if its reduced slope c_w + (J'W)'lambda does not point inwards.
class OneSided : public Measure {
 public:
  explicit OneSided(std::unique_ptr<Measure> closed_form) : inner_(std::move(closed_form)) {}

  void evaluate(const Posture& posture, const WrenchProgram& program, bool efforts,
                Capability& capability) override {
    sort_columns(program);
    if (sided_.empty() && free_.size() == static_cast<std::size_t>(program.columns())) {
      return inner_->evaluate(posture, program, efforts, capability);
    }
    if (!supported_) {
      capability.status = Status::kNumericalError;
      capability.reason = "closed forms serve limits of a contact at zero or infinity only";
      return;
    }
    const unsigned sets = 1U << sided_.size();
    unsigned best = 0;
    double most = -kInfinity;
    for (unsigned moving = 0; moving < sets; ++moving) {
      solve(posture, program, moving, false, capability);
      const bool valid = capability.status == Status::kOptimal && signs_hold(program, capability);
      if (!valid || capability.beta <= most) continue;
      most = capability.beta;
      best = moving;
    }
    solve(posture, program, best, efforts, capability);
    if (capability.status != Status::kOptimal) return;
    expand(program, efforts, capability);
  }

 private:
  static constexpr std::size_t kMostSided = 12;

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
    supported_ &= sided_.size() <= kMostSided;
  }

  /// The closed form on the free columns and those one-sided ones whose bit is set.
  void solve(const Posture& posture, const WrenchProgram& program, unsigned moving, bool efforts,
             Capability& capability) {
    kept_ = free_;
    for (std::size_t i = 0; i < sided_.size(); ++i) {
      if (moving >> i & 1U) kept_.push_back(sided_[i]);
    }
    std::sort(kept_.begin(), kept_.end());
    const auto own = static_cast<int>(program.W.cols());
    const auto split = std::lower_bound(kept_.begin(), kept_.end(), own);
    std::vector<int> second(split, kept_.end());
    for (int& j : second) j -= own;
    reduced_.actuation = program.actuation;
    reduced_.W = program.W(Eigen::all, std::vector<int>(kept_.begin(), split));
    reduced_.C_2 = program.C_2(Eigen::all, second);
    reduced_.c_w = program.c_w(kept_);
    reduced_.JtW = program.JtW(Eigen::all, kept_);
    reduced_.tau_d = program.tau_d;
    reduced_.w_min = Eigen::VectorXd::Constant(reduced_.c_w.size(), -kInfinity);
    reduced_.w_max = -reduced_.w_min;
    capability.h_2.setZero();
    inner_->evaluate(posture, reduced_, efforts, capability);
  }

  bool signs_hold(const WrenchProgram& program, const Capability& capability) const {
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      const double w = capability.w[static_cast<Eigen::Index>(i)];
      if (w < program.w_min[kept_[i]] || w > program.w_max[kept_[i]]) return false;
    }
    return true;
  }

  /// Zeros for the columns that rest.
  void expand(const WrenchProgram& program, bool efforts, Capability& capability) const {
    const Eigen::VectorXd w = capability.w;
    capability.w.setZero(program.columns());
    capability.w(kept_) = w;
    const auto own = static_cast<int>(program.W.cols());
    const Matrix6Xd seeds = capability.beta_C2;
    capability.beta_C2.setZero(6, program.columns() - own);
    Eigen::Index next = 0;
    for (const int j : kept_) {
      if (j >= own) capability.beta_C2.col(j - own) = seeds.col(next++);
    }
    if (next == 0) capability.beta_J2.setZero(6, capability.beta_J.cols());
    if (!efforts) return;
    const Eigen::VectorXd slope = program.c_w + program.JtW.transpose() * capability.lambda;
    for (const int j : sided_) {
      if (std::binary_search(kept_.begin(), kept_.end(), j)) continue;
      const double inwards = program.w_min[j] == 0 ? slope[j] : -slope[j];
      capability.residual.dual = std::max(capability.residual.dual, inwards);
    }
  }

  std::unique_ptr<Measure> inner_;
  std::vector<int> free_, sided_, kept_;
  bool supported_ = true;
  WrenchProgram reduced_;
};

}  // namespace

std::unique_ptr<Measure> make_one_sided(std::unique_ptr<Measure> closed_form) {
  return std::make_unique<OneSided>(std::move(closed_form));
}

}  // namespace maxwrench
