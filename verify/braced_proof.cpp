#include <array>
#include <cmath>
#include <stdexcept>

#include "verify/proof_over_box.h"
#include "verify/weighted.h"

namespace maxwrench {
namespace {

constexpr std::size_t kLinear = 3;  ///< the base's linear rows, which come first

struct BracedForms {
  std::vector<FormRow> tau, a;               ///< n
  std::unique_ptr<const FormShape> arm;      ///< of the levers: the variables of the second arm
  int repeat = 1;                            ///< control points with the same levers
  std::vector<std::vector<FormRow>> levers;  ///< n rows of three
  double ceiling = kInfinity;
};

/// The sum over thrusters of |K_i,k| max |u_k|.
Wide most_thrust(const Problem& problem, const FormModel& model, const FormVector& lever,
                 Eigen::Index row) {
  const Zonotope& set = problem.robot.actuation;
  Wide sum;
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(problem.robot.thrusters.size()); ++k) {
    Wide size(std::abs(set.B(row, k)));
    for (std::size_t i = 0; i < kLinear; ++i) {
      size += Wide(lever[i].magnitude(model.far())) *
              Wide(std::abs(set.B(static_cast<Eigen::Index>(i), k)));
    }
    sum += size * Wide(std::max(std::abs(set.u_min[k]), std::abs(set.u_max[k])));
  }
  return sum;
}

double braced_ceiling(const Problem& problem, const FormModel& model, const BracedRows& rows) {
  if (!problem.c.head<3>().isZero(0)) return kInfinity;
  Wide torque2, length2;
  for (Eigen::Index i = 3; i < 6; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Wide torque =
        Wide(rows.tau[at].magnitude(model.far())) + most_thrust(problem, model, rows.levers[at], i);
    torque2 += torque * torque;
    length2 += Wide(problem.c[i]) * Wide(problem.c[i]);
  }
  length2 = length2 * (Wide(1.0L) - Wide(model.shrinking()));
  return narrow(Wide(root_above(torque2.high)) / Wide::below(std::sqrt(length2.low))).high;
}

class BracedProof final : public ProofOverBox {
 public:
  BracedProof(const Problem& problem, const FormModel& model, const Equations& equations,
              std::shared_ptr<const BracedForms> forms)
      : ProofOverBox(model, equations),
        problem_(problem),
        forms_(std::move(forms)),
        arm_(*forms_->arm) {}

  int width() const override { return problem_.robot.actuation.dimension() + equations_.count(); }
  double ceiling() const override { return forms_->ceiling; }
  std::unique_ptr<ValueProof> clone() const override {
    return std::make_unique<BracedProof>(problem_, model_, equations_, forms_);
  }

 private:
  double combine(const double* lambda, std::size_t /*parts*/, std::vector<Narrow>& tau,
                 std::vector<Narrow>& a) override {
    const Zonotope& set = problem_.robot.actuation;
    Narrow support;
    for (Eigen::Index k = thrusters(); k < set.actuators(); ++k) {
      support += larger(weighted_column(k, lambda), set.u_min[k], set.u_max[k]);
    }
    for (std::size_t i = kLinear; i < forms_->tau.size(); ++i) {
      add_to(tau, forms_->tau[i], lambda[i]);
      add_to(a, forms_->a[i], lambda[i]);
    }
    return support.high;
  }

  /// Subtracts the largest -lambda'K u from g.
  bool add_at_points(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                     const double* lambda, std::vector<Narrow>& g) override {
    if (!arm_.set(lower, upper)) return false;
    const auto size = static_cast<std::size_t>(forms_->arm->size);
    for (std::size_t k = 0; k < kLinear; ++k) {
      weights_[k].assign(size, 0.0);
      for (std::size_t i = kLinear; i < forms_->levers.size(); ++i) {
        add_to(weights_[k], forms_->levers[i][k], lambda[i]);
      }
      arm_.over_box(weights_[k]);
    }
    const auto repeat = static_cast<std::size_t>(forms_->repeat);
    for (std::size_t p = 0; p < size; ++p) {
      const Narrow most = thrust(p, lambda);
      for (std::size_t v = p * repeat; v < (p + 1) * repeat; ++v) g[v] -= most;
    }
    return true;
  }

  const double* nu(const double* multiplier, std::size_t /*parts*/) const override {
    return multiplier + problem_.robot.actuation.dimension();
  }

  Eigen::Index thrusters() const {
    return static_cast<Eigen::Index>(problem_.robot.thrusters.size());
  }
  /// lambda'B_k without the base's linear rows.
  Narrow weighted_column(Eigen::Index k, const double* lambda) const {
    const Zonotope& set = problem_.robot.actuation;
    Narrow slope;
    for (auto i = static_cast<Eigen::Index>(kLinear); i < set.dimension(); ++i) {
      if (set.B(i, k) != 0) slope += Narrow(set.B(i, k)) * Narrow(lambda[i]);
    }
    return slope;
  }
  /// The largest -lambda'K u at a control point of the arm.
  Narrow thrust(std::size_t p, const double* lambda) const {
    const Zonotope& set = problem_.robot.actuation;
    Narrow sum;
    for (Eigen::Index k = 0; k < thrusters(); ++k) {
      Narrow slope = weighted_column(k, lambda);
      for (std::size_t i = 0; i < kLinear; ++i) {
        slope -= Narrow(set.B(static_cast<Eigen::Index>(i), k)) * weights_[i][p];
      }
      sum += larger(slope, set.u_min[k], set.u_max[k]);
    }
    return sum;
  }

  const Problem& problem_;
  std::shared_ptr<const BracedForms> forms_;
  BoxForms arm_;
  std::array<std::vector<Narrow>, kLinear> weights_;
};

}  // namespace

BracedRows braced_rows(const FormModel& model, const Vector6d& c) {
  BracedRows rows{model.tau_d(), model.exerted(c), model.levers()};
  for (std::vector<Form>* each : {&rows.tau, &rows.a}) {
    const FormVector linear = {(*each)[0], (*each)[1], (*each)[2]};
    for (std::size_t i = 0; i < each->size(); ++i) {
      (*each)[i] = i < kLinear ? Form(model.shape()) : (*each)[i] - dot(rows.levers[i], linear);
    }
  }
  return rows;
}

std::unique_ptr<ValueProof> make_braced_proof(const Problem& problem, const FormModel& model,
                                              const Equations& equations) {
  const BracedRows rows = braced_rows(model, problem.c);
  const int count = model.coordinates().yaw;  // the second arm's variables are the first
  BracedForms forms;
  forms.tau = to_rows(rows.tau, model.far());
  forms.a = to_rows(rows.a, model.far());
  forms.arm = std::make_unique<FormShape>(model.shape().stretch(0, count));
  forms.repeat = repeat_after(model.shape(), count);
  for (const FormVector& row : rows.levers) {
    std::vector<FormRow> three;
    for (const Form& form : row) {
      three.push_back(on_stretch(FormRow(form, model.far()), model.shape(), 0, count));
    }
    forms.levers.push_back(std::move(three));
  }
  forms.ceiling = braced_ceiling(problem, model, rows);
  return std::make_unique<BracedProof>(problem, model, equations,
                                       std::make_shared<const BracedForms>(std::move(forms)));
}

}  // namespace maxwrench
