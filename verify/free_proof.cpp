#include <Eigen/QR>
#include <cmath>
#include <stdexcept>

#include "verify/centred_rows.h"
#include "verify/free_wrench_limits.h"
#include "verify/proof_over_box.h"
#include "verify/weighted.h"

namespace maxwrench {
namespace {

struct FreeRows {
  std::vector<FormRow> tau, a;          ///< n
  std::vector<std::vector<FormRow>> A;  ///< of each free component, n
};

/// tau, a and all columns of A, one after the other.
std::vector<FormRow> all_rows(const FreeRows& rows) {
  std::vector<FormRow> all = rows.tau;
  all.insert(all.end(), rows.a.begin(), rows.a.end());
  for (const std::vector<FormRow>& column : rows.A) {
    all.insert(all.end(), column.begin(), column.end());
  }
  return all;
}

class FreeProof final : public ProofOverBox {
 public:
  FreeProof(const Problem& problem, const FormModel& model, const Equations& equations,
            std::shared_ptr<const FreeRows> rows)
      : ProofOverBox(model, equations),
        problem_(problem),
        rows_(std::move(rows)),
        centred_(model.shape(), all_rows(*rows_)),
        box_(model.shape()),
        q_(rows_->A.size()) {}

  int width() const override { return 2 * n() + equations_.count(); }
  double ceiling() const override { return kInfinity; }
  std::unique_ptr<ValueProof> clone() const override {
    return std::make_unique<FreeProof>(problem_, model_, equations_, rows_);
  }

  double most(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, const double* multiplier,
              std::size_t parts, double low, double high) override {
    if (high <= low || !centred_.set(lower, upper)) return high;
    const FreeWrenchLimits limits = limits_over_box();
    const Eigen::VectorXd Z = limits.find(std::max(std::abs(low), std::abs(high)));
    if (Z.size() == 0) return high;
    const double top = std::min(high, Z[0]);
    if (!(top > low)) return top;
    const double* centre = nu(multiplier, parts) + equations_.count();
    law_ = limits.law(Eigen::Map<const Eigen::VectorXd>(centre, n()), Z);
    if (!law_.R.allFinite() || !law_.M.allFinite() || !law_.p.allFinite()) return top;
    return ProofOverBox::most(lower, upper, multiplier, parts, std::max(low, -Z[0]), top);
  }

 private:
  int n() const { return problem_.robot.actuation.dimension(); }

  FreeWrenchLimits limits_over_box() const {
    const Eigen::Index count = n(), columns = 2 + static_cast<Eigen::Index>(rows_->A.size());
    Eigen::MatrixXd middle(count, columns), off(count, columns);
    for (Eigen::Index j = 0; j < columns; ++j) {
      for (Eigen::Index i = 0; i < count; ++i) {
        const auto row = static_cast<std::size_t>(j * count + i);
        middle(i, j) = centred_.middle(row);
        off(i, j) = centred_.off(row);
      }
    }
    return {problem_.robot.actuation, middle.col(0), middle.rightCols(columns - 1), off};
  }

  /// lambda'B u is subtracted at the control points.
  double combine(const double* lambda, std::size_t /*parts*/, std::vector<Narrow>& tau,
                 std::vector<Narrow>& a) override {
    for (std::size_t i = 0; i < rows_->tau.size(); ++i) {
      add_to(tau, rows_->tau[i], lambda[i]);
      add_to(a, rows_->a[i], lambda[i]);
    }
    return 0;
  }

  /// Subtracts the largest lambda'B u - q'(M u - p + rho), q = A'lambda, from g.
  bool add_at_points(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                     const double* lambda, std::vector<Narrow>& g) override {
    if (!box_.set(lower, upper)) return false;
    for (std::size_t j = 0; j < q_.size(); ++j) {
      q_[j].assign(g.size(), 0.0);
      for (std::size_t i = 0; i < rows_->A[j].size(); ++i) {
        add_to(q_[j], rows_->A[j][i], lambda[i]);
      }
      box_.over_box(q_[j]);
      const auto at = static_cast<Eigen::Index>(j);
      for (std::size_t v = 0; v < g.size(); ++v) {
        g[v] -= law_.p[at] * q_[j][v] + Narrow(law_.R[at]) * Narrow(q_[j][v].magnitude());
      }
    }
    const Zonotope& set = problem_.robot.actuation;
    for (Eigen::Index k = 0; k < set.actuators(); ++k) {
      Narrow own;
      for (Eigen::Index i = 0; i < set.dimension(); ++i) {
        if (set.B(i, k) != 0) own += Narrow(set.B(i, k)) * Narrow(lambda[i]);
      }
      for (std::size_t v = 0; v < g.size(); ++v) {
        Narrow slope = own;
        for (std::size_t j = 0; j < q_.size(); ++j) {
          slope -= law_.M(static_cast<Eigen::Index>(j), k) * q_[j][v];
        }
        g[v] -= larger(slope, set.u_min[k], set.u_max[k]);
      }
    }
    return true;
  }

  const double* nu(const double* multiplier, std::size_t /*parts*/) const override {
    return multiplier + n();
  }

  const Problem& problem_;
  std::shared_ptr<const FreeRows> rows_;
  CentredRows centred_;
  BoxForms box_;
  FreeWrenchLimits::Law law_;
  std::vector<std::vector<Narrow>> q_;
};

/// The wrenches of the task across c.
Matrix6Xd free_components(const Problem& problem) {
  const Eigen::MatrixXd along_c = problem.W_any.transpose() * problem.c;
  const Eigen::MatrixXd Q = Eigen::HouseholderQR<Eigen::MatrixXd>(along_c).householderQ();
  return problem.W_any * Q.rightCols(Q.cols() - 1);
}

}  // namespace

std::unique_ptr<ValueProof> make_free_proof(const Problem& problem, const FormModel& model,
                                            const Equations& equations) {
  const Zonotope& set = problem.robot.actuation;
  if (model.coordinates().resting >= 0) {
    throw std::invalid_argument(problem.name +
                                ": wrench: got 'any' without the joint about the yaw, expected "
                                "all coordinates");
  }
  if (!set.u_min.allFinite() || !set.u_max.allFinite()) {
    throw std::invalid_argument(problem.name +
                                ": wrench: got 'any' with efforts without limits, expected pure "
                                "or limits");
  }
  FreeRows rows{
      to_rows(model.tau_d(), model.far()), to_rows(model.exerted(problem.c), model.far()), {}};
  const Matrix6Xd W = free_components(problem);
  for (Eigen::Index j = 0; j < W.cols(); ++j) {
    rows.A.push_back(to_rows(model.exerted(W.col(j)), model.far()));
  }
  return std::make_unique<FreeProof>(problem, model, equations,
                                     std::make_shared<const FreeRows>(std::move(rows)));
}

}  // namespace maxwrench
