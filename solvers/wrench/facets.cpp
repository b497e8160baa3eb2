#include <cmath>
#include <stdexcept>

#include "lib/math/simd_pack.h"
#include "solvers/lp/makers.h"
#include "solvers/wrench/efforts.h"
#include "solvers/wrench/makers.h"

namespace maxwrench {
namespace {

/// A facet with a slope n'a below this share of |a| counts as parallel to the ray.
constexpr double kSlopeTolerance = 1e-12;
/// The distance [N, N m] by which rounding may make the ray miss the set, relative to the widths
/// involved.
constexpr double kPairTolerance = 1e-9;

/// The part of the ray tau_d + a x inside the set, from the largest `enter` to the least `leave` of
/// its facet pairs. Four pairs at a time stay in registers.
class Ray {
 public:
  double low = 0, high = 0;
  int missed_pair = -1;    ///< a violated pair that is parallel to the ray
  double missed_side = 0;  ///< 1 if its upper bound is violated, -1 if its lower one is

  void shoot(const Zonotope& set, const Eigen::VectorXd& tau, const double* a) {
    const Eigen::Index pairs = set.facet_pairs();
    if (enter_.size() != pairs) {
      enter_.resize(pairs);
      leave_.resize(pairs);
    }
    double norm = 0;
    for (Eigen::Index i = 0; i < tau.size(); ++i) norm += a[i] * a[i];
    flat_ = kSlopeTolerance * std::sqrt(norm);
    missed_pair = -1;
    for_packs(pairs, [&]<int L>(Eigen::Index j) { cross<L>(set, tau, a, j); });
    find_ends();
  }

  int low_pair() const { return find(enter_, low); }
  int high_pair() const { return find(leave_, high); }

 private:
  void find_ends() {
    using Pack = SimdPack<kPackSize>;
    Pack last = Pack::Constant(-kInfinity), first = Pack::Constant(kInfinity);
    low = -kInfinity;
    high = kInfinity;
    for_packs(enter_.size(), [&]<int L>(Eigen::Index j) {
      if constexpr (L == kPackSize) {
        last = last.max(pack<L>(&enter_[j]));
        first = first.min(pack<L>(&leave_[j]));
      } else {
        low = std::max(low, enter_[j]);
        high = std::min(high, leave_[j]);
      }
    });
    low = std::max(low, last.maxCoeff());
    high = std::min(high, first.minCoeff());
  }

  static int find(const Eigen::VectorXd& bounds, double bound) {
    int j = 0;
    while (bounds[j] != bound) ++j;
    return j;
  }

  /// Where the ray enters and leaves the L pairs from j on.
  template <int L>
  void cross(const Zonotope& set, const Eigen::VectorXd& tau, const double* a, Eigen::Index j) {
    SimdPack<L> slope = SimdPack<L>::Zero(), value = SimdPack<L>::Zero();  // N'a, N'tau
    const Eigen::Index begin = set.N_begin[static_cast<std::size_t>(j)];
    const Eigen::Index end = set.N_end[static_cast<std::size_t>(j + L - 1)];
    const double* row = set.N.data() + begin * set.N.cols() + j;
    for (Eigen::Index i = begin; i < end; ++i, row += set.N.cols()) {
      slope += pack<L>(row) * a[i];
      value += pack<L>(row) * tau[i];
    }
    const SimdPack<L> inverse = 1 / slope;
    const SimdPack<L> first = (pack<L>(&set.b_min[j]) - value) * inverse;
    const SimdPack<L> second = (pack<L>(&set.b_max[j]) - value) * inverse;
    pack<L>(&enter_[j]) = first.min(second);
    pack<L>(&leave_[j]) = first.max(second);
    for (Eigen::Index k = 0; k < L; ++k) {
      if (!(std::abs(slope[k]) > flat_)) {
        stay_beside(set, value[k], j + k);
      } else if (!(enter_[j + k] <= leave_[j + k])) {  // an overflow
        enter_[j + k] = -kInfinity;
        leave_[j + k] = kInfinity;
      }
    }
  }

  /// The ray is parallel to a pair.
  void stay_beside(const Zonotope& set, double value, Eigen::Index pair) {
    enter_[pair] = -kInfinity;
    leave_[pair] = kInfinity;
    const double slack = kPairTolerance * (1 + std::abs(value));
    const bool below = set.b_min[pair] - value > slack;
    if (!below && set.b_max[pair] - value >= -slack) return;
    missed_pair = static_cast<int>(pair);
    missed_side = below ? -1 : 1;
  }

  Eigen::VectorXd enter_, leave_;
  double flat_ = 0;
};

class Facets : public WrenchSolver {
 public:
  void solve_well_formed(const WrenchProgram& program, bool efforts,
                         Capability& capability) override {
    if (program.columns() != 1) {
      throw std::invalid_argument("solver facets: got " + std::to_string(program.columns()) +
                                  " wrench columns, expected one (wrench pure)");
    }
    const Zonotope& set = *program.actuation;
    if (!set.has_facets) {
      throw std::invalid_argument(
          "solver facets: the actuators have too many facets to enumerate, expected another "
          "solver");
    }
    capability.iterations = 0;
    Ray& ray = ray_;
    ray.shoot(set, program.tau_d, program.JtW.data());
    const bool upwards = program.c_w[0] >= 0;
    double x = upwards ? std::min(ray.high, program.w_max[0]) : std::max(ray.low, program.w_min[0]);
    const double low = std::max(ray.low, program.w_min[0]);
    const double high = std::min(ray.high, program.w_max[0]);
    if (ray.missed_pair >= 0 || low > high + kPairTolerance * (1 + std::abs(high))) {
      capability.status = Status::kInfeasible;
      capability.reason = "no actuator efforts balance the posture";
      fill_contradiction(program, ray, capability.lambda);
      if (proves_infeasible(program, capability.lambda)) return;
      // The ray misses the set by about 1e-9 of its length, which is too little for a proof by two
      // facets.
      return assembled_->solve_well_formed(program, efforts, capability);
    }
    if (!std::isfinite(x)) {
      const double size = program.JtW.squaredNorm();
      // `size` overflows or underflows, so the computation above is not valid.
      if (size != 0 && !std::isnormal(size)) {
        return assembled_->solve_well_formed(program, efforts, capability);
      }
      capability.status = Status::kUnbounded;
      capability.reason = "the wrench does not load any actuator";
      return;
    }
    fill(program, upwards ? ray.high_pair() : ray.low_pair(), x == (upwards ? ray.high : ray.low),
         x, capability);
    if (efforts) fill_efforts(program, *simplex_, capability);
  }

 private:
  static void fill(const WrenchProgram& program, int pair, bool facet_active, double x,
                   Capability& capability) {
    capability.status = Status::kOptimal;
    capability.reason = "";
    capability.beta = program.c_w[0] * x;
    capability.w.setConstant(1, x);
    if (facet_active) {
      const auto normal = program.actuation->N.col(pair);
      capability.lambda = normal * (-program.c_w[0] / normal.dot(program.JtW.col(0)));
    } else {
      capability.lambda.setZero(program.tau_d.size());
    }
  }

  /// y with sup {y'(B u - J'W w)} < y'tau_d: the missed pair, or the difference of the two pairs
  /// that end the ray before it begins, n/(n'J'W) each.
  static void fill_contradiction(const WrenchProgram& program, const Ray& ray, Eigen::VectorXd& y) {
    const Zonotope& set = *program.actuation;
    y.setZero(program.tau_d.size());
    const auto a = program.JtW.col(0);
    const bool free = program.w_min[0] == -kInfinity || program.w_max[0] == kInfinity;
    // The slope y'a should be zero; its rounding error is removed, because w may have no bound to
    // limit its effect.
    const auto level = [&] {
      const double size = a.squaredNorm();
      if (free && size > 0) y -= a * (a.dot(y) / size);
    };
    if (ray.missed_pair >= 0) {
      y = ray.missed_side * set.N.col(ray.missed_pair);
      return level();
    }
    const auto add = [&](int pair, double sign) {
      y += set.N.col(pair) * (sign / set.N.col(pair).dot(program.JtW.col(0)));
    };
    if (ray.high < program.w_max[0]) add(ray.high_pair(), 1);
    if (ray.low > program.w_min[0]) add(ray.low_pair(), -1);
    if (ray.high < program.w_max[0] && ray.low > program.w_min[0]) level();
  }

  Ray ray_;
  std::unique_ptr<LpSolver> simplex_ = make_simplex();
  std::unique_ptr<WrenchSolver> assembled_ = make_assembled(make_simplex(), false);
};

}  // namespace

std::unique_ptr<WrenchSolver> make_facets() { return std::make_unique<Facets>(); }

}  // namespace maxwrench
