#include <algorithm>
#include <stdexcept>

#include "verify/contact_limits.h"
#include "verify/proof_over_box.h"
#include "verify/weighted.h"

namespace maxwrench {
namespace {

struct PureRows {
  std::vector<FormRow> tau, a;  ///< n
  double ceiling;
  bool from_zero;  ///< these rows are those of values t >= 0 only
};

/// The common part of the proofs of one wrench.
class PureProof : public ProofOverBox {
 public:
  PureProof(const Problem& problem, const FormModel& model, const Equations& equations,
            std::shared_ptr<const PureRows> rows)
      : ProofOverBox(model, equations),
        problem_(problem),
        rows_(std::move(rows)),
        factors_(rows_->tau.size()) {}

  int width() const override { return own_width() + equations_.count(); }
  double ceiling() const override { return rows_->ceiling; }
  double most(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, const double* multiplier,
              std::size_t parts, double low, double high) override {
    if (rows_->from_zero && !(low >= 0)) return high;
    return ProofOverBox::most(lower, upper, multiplier, parts, low, high);
  }

 protected:
  /// The number of entries of lambda.
  virtual int own_width() const = 0;
  /// An upper bound of the support. `factors`: those of the n rows.
  virtual double reach(const double* lambda, std::vector<Narrow>& factors) = 0;

  double combine(const double* multiplier, std::size_t /*parts*/, std::vector<Narrow>& tau,
                 std::vector<Narrow>& a) override {
    const double support = reach(multiplier, factors_);
    for (std::size_t i = 0; i < factors_.size(); ++i) {
      add_to(tau, rows_->tau[i], factors_[i]);
      add_to(a, rows_->a[i], factors_[i]);
    }
    return support;
  }
  const double* nu(const double* multiplier, std::size_t /*parts*/) const override {
    return multiplier + own_width();
  }

  const Problem& problem_;
  std::shared_ptr<const PureRows> rows_;

 private:
  std::vector<Narrow> factors_;
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
    if (!rows_are_known(lambda)) return kInfinity;
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

  /// Without a joint about the yaw, only the rows of the chain's joints are those of the posture.
  bool rows_are_known(const double* lambda) const {
    const PostureCoordinates& coordinates = model_.coordinates();
    if (coordinates.resting < 0) return true;
    const auto axes = static_cast<int>(problem_.robot.base_axes.size());
    for (int row = 0; row < static_cast<int>(rows_->tau.size()); ++row) {
      const auto& chain = coordinates.chain;
      const bool of_chain = std::find(chain.begin(), chain.end(), row - axes) != chain.end();
      if (!of_chain && lambda[row] != 0) return false;
    }
    return true;
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

void add(const std::vector<Form>& rows, std::vector<Form>& sum) {
  for (std::size_t i = 0; i < rows.size(); ++i) sum[i] += rows[i];
}

}  // namespace

std::unique_ptr<ValueProof> make_pure_proof(const Problem& problem, const FormModel& model,
                                            const Equations& equations,
                                            const std::string& measure) {
  std::vector<Form> tau = model.tau_d(), a = model.exerted(problem.c);
  bool grows = false;
  if (model.coordinates().has_shares()) {
    const ContactLimits limits(problem);
    grows = limits.grow();
    add(model.contact_load(limits.w_min, limits.w_max), tau);
    if (grows) add(model.contact_load(limits.v_min, limits.v_max), a);
  }
  const bool has_ceiling = model.coordinates().base_is_dependent && !grows;
  const auto rows = std::make_shared<const PureRows>(
      PureRows{to_rows(tau, model.far()), to_rows(a, model.far()),
               has_ceiling ? pure_ceiling(problem, model, problem.c, problem.robot.actuation, tau)
                           : kInfinity,
               grows});
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
