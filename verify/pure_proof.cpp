#include <algorithm>
#include <stdexcept>

#include "verify/equations.h"
#include "verify/model.h"
#include "verify/value_proof.h"
#include "verify/weighted.h"

namespace maxwrench {
namespace {

struct PureRows {
  std::vector<FormRow> tau, a;  ///< n
  double ceiling;
};

std::vector<FormRow> to_rows(const std::vector<Form>& forms, const std::vector<double>& far) {
  std::vector<FormRow> rows;
  for (const Form& form : forms) rows.emplace_back(form, far);
  return rows;
}

/// t <= (sum_k max |u_k| |B_k| + |tau_d|) / |J'c|, on the base's free axes, linear ones for a force
/// and angular ones for a torque. There |J'c| is at least |c|, reduced by the share that rotations
/// with rounded entries may take and by the part along axes that are not free. Infinite if the
/// base's pose has no closed form, because other axes may then bear the wrench.
double pure_ceiling(const Problem& problem, const FormModel& model) {
  if (!model.coordinates().base_is_dependent) return kInfinity;
  const Zonotope& set = problem.robot.actuation;
  const bool pushes = !problem.c.head<3>().isZero(0);
  const std::vector<Form> tau = model.tau_d();
  Wide length2, load2;
  for (int i = 0; i < 3; ++i) {
    const Wide x(problem.c[pushes ? i : 3 + i]);
    length2 += x * x;
  }
  length2 = length2 * (Wide(1.0L) - Wide(model.shrinking()));
  std::array<bool, 3> free{};
  Wide force;
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < problem.robot.base_axes.size(); ++i) {
    const int axis = problem.robot.base_axes[i];
    if ((axis < 3) != pushes) continue;
    free[static_cast<std::size_t>(axis % 3)] = true;
    rows.push_back(static_cast<Eigen::Index>(i));
    const Wide size(tau[i].magnitude(model.far()));
    load2 += size * size;
  }
  const FormVector at_base = model.along_at_base(pushes);
  for (std::size_t i = 0; i < 3; ++i) {
    if (free[i]) continue;
    const Wide lost(at_base[i].magnitude(model.far()));
    length2 -= lost * lost;
  }
  if (rows.empty() || !(length2.low > 1e-6L)) {
    throw std::invalid_argument(problem.name + ": the base's free axes do not limit c");
  }
  for (Eigen::Index k = 0; k < set.actuators(); ++k) {
    Wide column2;
    for (const Eigen::Index row : rows) column2 += Wide(set.B(row, k)) * Wide(set.B(row, k));
    force += Wide(root_above(column2.high)) *
             Wide(std::max(std::abs(set.u_min[k]), std::abs(set.u_max[k])));
  }
  force += Wide(root_above(load2.high));
  const Wide length = Wide::below(std::sqrt(length2.low));
  return narrow(force / length).high;
}

/// The common part of the proofs for all sets.
class PureProof : public ValueProof {
 public:
  PureProof(const Problem& problem, const FormModel& model, const Equations& equations,
            std::shared_ptr<const PureRows> rows)
      : problem_(problem),
        model_(model),
        equations_(equations),
        rows_(std::move(rows)),
        box_(model.shape()),
        off_postures_(equations),
        factors_(rows_->tau.size()) {}

  int width() const override { return own_width() + equations_.count(); }
  double ceiling() const override { return rows_->ceiling; }

  double most(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, const double* multiplier,
              double low, double high) override {
    if (high <= low || !box_.set(lower, upper) || !off_postures_.set(lower, upper)) return high;
    const double support = reach(multiplier, factors_);
    const auto size = static_cast<std::size_t>(model_.shape().size);
    tau_.assign(size, 0.0);
    a_.assign(size, 0.0);
    for (std::size_t i = 0; i < factors_.size(); ++i) {
      add_to(tau_, rows_->tau[i], factors_[i]);
      add_to(a_, rows_->a[i], factors_[i]);
    }
    box_.over_box(tau_);
    box_.over_box(a_);
    off_postures_.add_to(tau_, multiplier + own_width());
    double U = by_ends(support, low, high);
    if (U > low) U = std::min(U, by_ratio(support));
    return U < high ? U : high;
  }

 protected:
  /// The number of entries of lambda.
  virtual int own_width() const = 0;
  /// An upper bound of the support. `factors`: those of the n rows.
  virtual double reach(const double* lambda, std::vector<Narrow>& factors) = 0;

  const Problem& problem_;
  const FormModel& model_;
  const Equations& equations_;
  std::shared_ptr<const PureRows> rows_;

 private:
  double by_ends(double support, double low, double high) const {
    double most = -kInfinity;
    for (std::size_t v = 0; v < tau_.size(); ++v) {
      const Narrow slope = Narrow(1.0) - a_[v];
      const Narrow at_low = Narrow(low) * slope - tau_[v], at_high = Narrow(high) * slope - tau_[v];
      if (!(at_low.high < kInfinity && at_high.high < kInfinity)) return kInfinity;  // or NaN
      most = std::max(most, std::max(at_low.high, at_high.high));
    }
    return Narrow::above(support + most);
  }

  double by_ratio(double support) const {
    double most = -kInfinity;
    for (std::size_t v = 0; v < tau_.size(); ++v) {
      if (!(a_[v].low > 0)) return kInfinity;
      const Narrow ratio = (Narrow(support) - tau_[v]) / a_[v];
      if (!(ratio.high < kInfinity)) return kInfinity;
      most = std::max(most, ratio.high);
    }
    return most;
  }

  BoxForms box_;
  EquationsOverBox off_postures_;
  std::vector<Narrow> factors_, tau_, a_;
};

/// The set {B u}: s = sum_k max over limits of u_k lambda'B_k.
class PolytopeProof final : public PureProof {
 public:
  using PureProof::PureProof;
  std::unique_ptr<ValueProof> clone() const override {
    return std::make_unique<PolytopeProof>(problem_, model_, equations_, rows_);
  }

 private:
  int own_width() const override { return problem_.robot.actuation.dimension(); }
  double reach(const double* lambda, std::vector<Narrow>& factors) override {
    const Zonotope& set = problem_.robot.actuation;
    Narrow sum;
    for (Eigen::Index k = 0; k < set.actuators(); ++k) {
      Narrow slope;
      for (Eigen::Index i = 0; i < set.dimension(); ++i) {
        if (set.B(i, k) != 0) slope += Narrow(set.B(i, k)) * Narrow(lambda[i]);
      }
      sum += larger(slope, set.u_min[k], set.u_max[k]);
    }
    for (std::size_t i = 0; i < factors.size(); ++i) factors[i] = lambda[i];
    return sum.high;
  }
};

/// The set {tau: u_min <= B^+ tau <= u_max}: rows B^+ tau and B^+ a, s = sum_k max over limits of
/// u_k lambda_k.
class SmallestEffortProof final : public PureProof {
 public:
  SmallestEffortProof(const Problem& problem, const FormModel& model, const Equations& equations,
                      std::shared_ptr<const PureRows> rows)
      : PureProof(problem, model, equations, std::move(rows)),
        B_pinv_(enclose_pseudoinverse(problem.robot.actuation.B)) {}
  std::unique_ptr<ValueProof> clone() const override {
    return std::make_unique<SmallestEffortProof>(problem_, model_, equations_, rows_);
  }

 private:
  int own_width() const override { return problem_.robot.actuation.actuators(); }
  double reach(const double* lambda, std::vector<Narrow>& factors) override {
    const Zonotope& set = problem_.robot.actuation;
    std::vector<Wide> rows(factors.size());
    Narrow sum;
    for (std::size_t k = 0; k < B_pinv_.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(k);
      sum += larger(Narrow(lambda[k]), set.u_min[at], set.u_max[at]);
      for (std::size_t i = 0; i < rows.size(); ++i) rows[i] += B_pinv_[k][i] * Wide(lambda[k]);
    }
    for (std::size_t i = 0; i < rows.size(); ++i) factors[i] = narrow(rows[i]);
    return sum.high;
  }

  WideRows B_pinv_;
};

/// The set {tau: |W_u B^+ tau| <= 1}: s = sqrt(lambda'Q^-1 lambda), Q = (W_u B^+)'(W_u B^+).
class EllipsoidProof final : public PureProof {
 public:
  EllipsoidProof(const Problem& problem, const FormModel& model, const Equations& equations,
                 std::shared_ptr<const PureRows> rows)
      : PureProof(problem, model, equations, std::move(rows)) {
    const WideRows K = weighted_pseudoinverse(problem.robot.actuation);
    Q_inverse_ = enclose_inverse(transposed(K) * K);
  }
  std::unique_ptr<ValueProof> clone() const override {
    return std::make_unique<EllipsoidProof>(problem_, model_, equations_, rows_);
  }

 private:
  int own_width() const override { return problem_.robot.actuation.dimension(); }
  double reach(const double* lambda, std::vector<Narrow>& factors) override {
    Wide square;
    for (std::size_t i = 0; i < factors.size(); ++i) {
      factors[i] = lambda[i];
      Wide row;
      for (std::size_t j = 0; j < factors.size(); ++j) row += Q_inverse_[i][j] * Wide(lambda[j]);
      square += row * Wide(lambda[i]);
    }
    return narrow(Wide(root_above(square.high))).high;
  }

  WideRows Q_inverse_;
};

}  // namespace

std::unique_ptr<ValueProof> make_pure_proof(const Problem& problem, const FormModel& model,
                                            const Equations& equations,
                                            const std::string& measure) {
  const auto rows = std::make_shared<const PureRows>(
      PureRows{to_rows(model.tau_d(), model.far()), to_rows(model.exerted(problem.c), model.far()),
               pure_ceiling(problem, model)});
  if (measure == "linf_polytope") {
    return std::make_unique<PolytopeProof>(problem, model, equations, rows);
  }
  if (measure == "l2_polytope") {
    return std::make_unique<SmallestEffortProof>(problem, model, equations, rows);
  }
  if (measure == "ellipsoid") {
    return std::make_unique<EllipsoidProof>(problem, model, equations, rows);
  }
  throw std::invalid_argument("measure: got '" + measure +
                              "', expected linf_polytope, l2_polytope or ellipsoid");
}

}  // namespace maxwrench
