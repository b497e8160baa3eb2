#include <memory>

#include "solvers/certify/bound/any_rows.h"
#include "solvers/certify/bound/bounds.h"

namespace maxwrench {
namespace {

class AnyWrenchBound final : public Bound {
 public:
  explicit AnyWrenchBound(std::shared_ptr<const AnyModel> model)
      : model_(std::move(model)),
        box_(model_->f),
        rows_(*model_, model_->sizes, model_->j_min, model_->j_max) {}

  double ceiling() const override { return rows_.ceiling(); }

  void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low, double high,
                BoxProof& proof) override {
    proof.forget(high);
    if (!(spread(model_->f.coordinates(), lower, upper) <= kMostSpread)) return;
    rows_.points() = box_.over(lower, upper).transpose();
    rows_.bound(low, proof);
  }

  std::unique_ptr<Bound> clone() const override { return std::make_unique<AnyWrenchBound>(model_); }

 private:
  std::shared_ptr<const AnyModel> model_;
  ControlPoints box_;
  AnyRows rows_;
};

}  // namespace

std::unique_ptr<Bound> make_any_wrench_bound(const Problem& problem) {
  return std::make_unique<AnyWrenchBound>(
      std::make_shared<const AnyModel>(make_any_model(problem, problem.c)));
}

}  // namespace maxwrench
