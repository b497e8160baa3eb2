#include <algorithm>
#include <stdexcept>

#include "verify/list_forms.h"

namespace maxwrench {
namespace {

/// Sums over some scenarios, each with its own limits. What is no scenario of the list proves
/// nothing.
class ListProof final : public ProofOverBox {
 public:
  ListProof(const Problem& problem, const FormModel& model, const Equations& equations,
            std::shared_ptr<const ListForms> forms)
      : ProofOverBox(model, equations), problem_(problem), forms_(std::move(forms)) {}

  int width() const override {
    return static_cast<int>(forms_->entries()) + problem_.robot.actuation.dimension();
  }
  int shared() const override { return equations_.count(); }
  double ceiling() const override { return forms_->ceiling(); }
  std::unique_ptr<ValueProof> clone() const override {
    return std::make_unique<ListProof>(problem_, model_, equations_, forms_);
  }

 private:
  double combine(const double* multiplier, std::size_t parts, std::vector<Narrow>& g,
                 std::vector<Narrow>& h) override {
    Narrow support;
    off_ = 0.0;
    for (std::size_t i = 0; i < parts; ++i) {
      if (!add(multiplier + i * static_cast<std::size_t>(width()), support, g, h)) {
        return kInfinity;
      }
    }
    // A value t may be below another scenario's lower end by kToleratedEnd (1 + |t|). The constant
    // coefficient changes all control points by as much.
    const double off = (Narrow(kToleratedEnd) * off_).high;
    h[0] += Narrow(-off, off);
    return (support + Narrow(off)).high;
  }

  const double* nu(const double* multiplier, std::size_t parts) const override {
    return multiplier + parts * static_cast<std::size_t>(width());
  }

  bool add(const double* part, Narrow& support, std::vector<Narrow>& g, std::vector<Narrow>& h) {
    const auto scenario = forms_->read(part);
    if (!scenario) return false;
    Narrow length2;
    for (const double z : scenario->z) length2 += Narrow(z) * Narrow(z);
    if (!(length2.high <= 1)) return false;
    const double* lambda = part + forms_->entries();
    const Zonotope& limits =
        problem_.scenarios.limits[static_cast<std::size_t>(scenario->limits)].actuation;
    if (!limits.u_min.allFinite() || !limits.u_max.allFinite()) return false;
    support += support_of(lambda, limits);
    const auto n = static_cast<std::size_t>(problem_.robot.actuation.dimension());
    const std::array<Narrow, 6> c = forms_->wrench(*scenario);
    for (std::size_t i = 0; i < n; ++i) {
      if (lambda[i] == 0) continue;
      add_to(g, forms_->nominal()[i], lambda[i]);
      for (std::size_t load = 0; load < scenario->cases.size(); ++load) {
        const auto number = static_cast<std::size_t>(scenario->cases[load]);
        add_to(g, forms_->of_case(load, number)[i], lambda[i]);
      }
      for (std::size_t k = 0; k < c.size(); ++k) {
        if (c[k].is_zero()) continue;
        const Narrow factor = lambda[i] * c[k];
        add_to(h, forms_->along(k)[i], factor);
        off_ += Narrow(factor.magnitude()) * Narrow(forms_->sizes(k)[i]);
      }
    }
    return true;
  }

  Narrow support_of(const double* lambda, const Zonotope& limits) const {
    const Eigen::MatrixXd& B = problem_.robot.actuation.B;
    Narrow sum;
    for (Eigen::Index k = 0; k < B.cols(); ++k) {
      Narrow slope;
      for (Eigen::Index i = 0; i < B.rows(); ++i) {
        if (B(i, k) != 0) slope += Narrow(B(i, k)) * Narrow(lambda[i]);
      }
      sum += larger(slope, limits.u_min[k], limits.u_max[k]);
    }
    return sum;
  }

  const Problem& problem_;
  std::shared_ptr<const ListForms> forms_;
  Narrow off_;
};

}  // namespace

std::unique_ptr<ValueProof> make_list_proof(const Problem& problem, const FormModel& model,
                                            const Equations& equations) {
  return std::make_unique<ListProof>(problem, model, equations,
                                     std::make_shared<const ListForms>(problem, model));
}

}  // namespace maxwrench
