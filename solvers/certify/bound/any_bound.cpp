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
        rows_(*model_, sizes_of(*model_), with_zeros(model_->j_min, model_->held),
              with_zeros(model_->j_max, model_->held)) {}

  double ceiling() const override { return rows_.ceiling(); }

  void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low, double high,
                BoxProof& proof) override {
    proof.forget(high);
    if (!(spread(model_->f.coordinates(), lower, upper) <= kMostSpread)) return;
    rows_.points() = box_.over(lower, upper).transpose();
    if (model_->held > 0) {
      rows_.points() = rows_along(rows_.points(), *model_, Eigen::VectorXd::Ones(1), kNone);
    }
    rows_.bound(low, proof);
  }

  std::unique_ptr<Bound> clone() const override { return std::make_unique<AnyWrenchBound>(model_); }

 private:
  static inline const Eigen::MatrixXd kNone = Eigen::MatrixXd(1, 0);  ///< only x_k is held

  static Eigen::VectorXd sizes_of(const AnyModel& model) {
    if (model.held == 0) return model.sizes;
    return rows_along(model.sizes.transpose(), model, Eigen::VectorXd::Ones(1), kNone).transpose();
  }

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
