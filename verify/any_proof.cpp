#include <algorithm>
#include <stdexcept>

#include "verify/box_forms.h"
#include "verify/model.h"
#include "verify/value_proof.h"
#include "verify/weighted.h"

namespace maxwrench {
namespace {

struct AnyRows {
  double ceiling;
  FormRow o_0;
  std::vector<FormRow> tau_0;           ///< of each joint
  std::vector<FormRow> y;               ///< of each free base axis
  std::vector<std::vector<FormRow>> K;  ///< joints, then free base axes
};

std::vector<FormRow> on_free_axes(const Problem& problem, const FormModel& model,
                                  const std::array<FormVector, 2>& twist) {
  std::vector<FormRow> rows;
  for (const int axis : problem.robot.base_axes) {
    rows.emplace_back(twist[static_cast<std::size_t>(axis / 3)][static_cast<std::size_t>(axis % 3)],
                      model.far());
  }
  return rows;
}

/// An upper bound of what the thrusters exert along c: |o_0| + sum over axes |y| sum_k |B_k| max
/// |u_k|.
double any_ceiling(const Problem& problem, const FormModel& model) {
  const Zonotope& set = problem.robot.actuation;
  Wide most(model.weight_along_c().magnitude(model.far()));
  const std::array<FormVector, 2> y = model.carrying();
  for (std::size_t i = 0; i < problem.robot.base_axes.size(); ++i) {
    const auto axis = static_cast<std::size_t>(problem.robot.base_axes[i]);
    Wide force;
    for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(problem.robot.thrusters.size()); ++k) {
      force += Wide(std::abs(set.B(static_cast<Eigen::Index>(i), k))) *
               Wide(std::max(std::abs(set.u_min[k]), std::abs(set.u_max[k])));
    }
    most += Wide(y[axis / 3][axis % 3].magnitude(model.far())) * force;
  }
  return narrow(most).high;
}

std::shared_ptr<const AnyRows> any_rows(const Problem& problem, const FormModel& model) {
  AnyRows rows{any_ceiling(problem, model),
               FormRow(model.weight_along_c(), model.far()),
               {},
               on_free_axes(problem, model, model.carrying()),
               {}};
  for (std::size_t i = 0; i < problem.robot.joints.size(); ++i) {
    rows.tau_0.emplace_back(model.weight_at(i), model.far());
    rows.K.push_back(on_free_axes(problem, model, model.screw(i)));
  }
  return std::make_shared<const AnyRows>(std::move(rows));
}

class AnyProof final : public ValueProof {
 public:
  AnyProof(const Problem& problem, const FormModel& model, std::shared_ptr<const AnyRows> rows)
      : problem_(problem),
        model_(model),
        rows_(std::move(rows)),
        box_(model.shape()),
        g_(rows_->y.size()) {}

  int width() const override { return static_cast<int>(rows_->tau_0.size()); }
  double ceiling() const override { return rows_->ceiling; }

  double most(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, const double* mu,
              std::size_t /*parts*/, double low, double high) override {
    if (high <= low || !box_.set(lower, upper)) return high;
    const auto size = static_cast<std::size_t>(model_.shape().size);
    constant_.assign(size, 0.0);
    add_to(constant_, rows_->o_0, 1.0);
    for (std::size_t axis = 0; axis < g_.size(); ++axis) {
      g_[axis].assign(size, 0.0);
      add_to(g_[axis], rows_->y[axis], 1.0);
    }
    for (std::size_t i = 0; i < rows_->tau_0.size(); ++i) {
      add_to(constant_, rows_->tau_0[i], -mu[i]);
      for (std::size_t axis = 0; axis < g_.size(); ++axis)
        add_to(g_[axis], rows_->K[i][axis], -mu[i]);
    }
    box_.over_box(constant_);
    for (std::vector<Narrow>& g : g_) box_.over_box(g);
    double most = -kInfinity;
    for (std::size_t v = 0; v < size; ++v) {
      const double at = (constant_[v] + thrust(v)).high;
      if (!(at < kInfinity)) return high;  // or NaN
      most = std::max(most, at);
    }
    const double U = Narrow::above(most + joints(mu));
    return U < high ? U : high;
  }

  std::unique_ptr<ValueProof> clone() const override {
    return std::make_unique<AnyProof>(problem_, model_, rows_);
  }

 private:
  /// sum_k max over limits of u_k (B_b'g)_k at a control point.
  Narrow thrust(std::size_t v) const {
    const Zonotope& set = problem_.robot.actuation;
    Narrow sum;
    for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(problem_.robot.thrusters.size()); ++k) {
      Narrow d;
      for (std::size_t axis = 0; axis < g_.size(); ++axis) {
        const double b = set.B(static_cast<Eigen::Index>(axis), k);
        if (b != 0) d += b * g_[axis][v];
      }
      sum += larger(d, set.u_min[k], set.u_max[k]);
    }
    return sum;
  }

  /// The support of the joints' limits.
  double joints(const double* mu) const {
    const Zonotope& set = problem_.robot.actuation;
    Narrow sum;
    const auto first = static_cast<Eigen::Index>(problem_.robot.thrusters.size());
    for (Eigen::Index i = 0; i < width(); ++i) {
      sum += larger(Narrow(mu[i]), set.u_min[first + i], set.u_max[first + i]);
    }
    return sum.high;
  }

  const Problem& problem_;
  const FormModel& model_;
  std::shared_ptr<const AnyRows> rows_;
  BoxForms box_;
  std::vector<std::vector<Narrow>> g_;
  std::vector<Narrow> constant_;
};

}  // namespace

std::unique_ptr<ValueProof> make_any_proof(const Problem& problem, const FormModel& model) {
  if (!model.coordinates().base_is_dependent) {
    throw std::invalid_argument(
        problem.name +
        ": wrench: got 'any', expected pure: the base pose is not dependent in closed form");
  }
  const Eigen::MatrixXd& B = problem.robot.actuation.B;
  const auto joints = static_cast<Eigen::Index>(problem.robot.joints.size());
  if (!B.bottomRightCorner(joints, joints).isIdentity(0) ||
      !B.topRightCorner(B.rows() - joints, joints).isZero(0) ||
      !B.bottomLeftCorner(joints, B.cols() - joints).isZero(0)) {
    throw std::invalid_argument(
        problem.name + ": wrench: got 'any', expected pure: joints without motors of their own");
  }
  return std::make_unique<AnyProof>(problem, model, any_rows(problem, model));
}

std::unique_ptr<ValueProof> make_value_proof(const Problem& problem, const FormModel& model,
                                             const Equations& equations, const std::string& measure,
                                             Wrench wrench) {
  if (problem.contact_columns() > 0) {
    if (wrench != Wrench::kPure || measure == "ellipsoid" || !problem.scenarios.empty()) {
      throw std::invalid_argument(problem.name +
                                  ": got forces of a second contact, expected linf_polytope or "
                                  "l2_polytope and a single wrench, pure");
    }
    if (model.coordinates().has_shares()) {
      return make_pure_proof(problem, model, equations, measure);
    }
    if (measure != "linf_polytope" || !forces_follow_from_base(problem)) {
      throw std::invalid_argument(problem.name +
                                  ": got forces of a second contact that the base does not "
                                  "determine, expected coordinates for them");
    }
    return make_braced_proof(problem, model, equations);
  }
  if (!problem.scenarios.empty()) {
    if (wrench == Wrench::kPure && measure == "linf_polytope") {
      return make_list_proof(problem, model, equations);
    }
    throw std::invalid_argument(problem.name +
                                ": got a list of scenarios, expected linf_polytope and pure");
  }
  if (wrench == Wrench::kPure) return make_pure_proof(problem, model, equations, measure);
  if (measure == "linf_polytope") {
    if (problem.dependent.empty()) return make_any_proof(problem, model);
    return problem.W_any.cols() == 1 ? make_pure_proof(problem, model, equations, measure)
                                     : make_free_proof(problem, model, equations);
  }
  throw std::invalid_argument("wrench: got 'any', expected pure with measure " + measure);
}

}  // namespace maxwrench
