#include <cmath>
#include <stdexcept>

#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/bound/equation_program.h"
#include "solvers/certify/bound/free_points.h"
#include "solvers/certify/bound/loop_linear.h"
#include "solvers/certify/bound/program_rounds.h"

namespace maxwrench {
namespace {

class FreeBound final : public Bound {
 public:
  FreeBound(std::shared_ptr<const LoopModel> model, std::shared_ptr<const FreeColumns> columns,
            std::shared_ptr<const Zonotope> set)
      : model_(std::move(model)),
        columns_(std::move(columns)),
        set_(std::move(set)),
        own_rows_(model_->n - columns_->k),
        box_(*model_),
        linear_(*model_),
        equations_(*model_),
        free_(columns_, *model_, set_),
        program_(Eigen::MatrixXd::Zero(own_rows_ + model_->m, set_->actuators()), set_->u_min,
                 set_->u_max, ProgramPoints::kMost),
        rounds_(
            program_, [this](Eigen::Index i, Eigen::Index id) { write_point(i, id); },
            [this](int id) {
              const auto size = static_cast<int>(model_->size);
              return id + 2 * size * free_.pattern(id % size);
            }) {
    entries_.setZero(own_rows_ + model_->m);
  }

  double ceiling() const override { return kInfinity; }

  void extend(Eigen::VectorXd& lower, Eigen::VectorXd& upper) const override {
    lower = model_->coordinates.lower.array() - kLimitTolerance;
    upper = model_->coordinates.upper.array() + kLimitTolerance;
  }

  bool shrink(Eigen::VectorXd& lower, Eigen::VectorXd& upper, std::vector<BoxCut>* cuts) override {
    return linear_.shrink(lower, upper, cuts);
  }

  void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low, double high,
                BoxProof& proof) override {
    proof.forget(high);
    if (!box_.set(lower, upper)) return;
    if (!free_.set(box_, lower, upper, low, high)) {
      linear_.precondition(lower, upper);
      equations_.exclude(lower, upper, box_, linear_, proof);
      return;
    }
    low_ = free_.least_t();
    high_ = free_.most_t();
    values_.set_ends(low_, high_);
    if (proof.multiplier.size() == 2 * model_->n + model_->m) {
      lambda_ = proof.multiplier.head(model_->n);
      nu_ = proof.multiplier.segment(model_->n, model_->m);
    } else {
      lambda_.setZero(model_->n);
      nu_.setZero(model_->m);
    }
    take(value(), proof);
    lambda_.setZero();
    nu_.setZero();
    take(high_, proof);
    if (proof.high <= low) return;
    linear_.precondition(lower, upper);
    const bool known = values_.is_useful(proof.high);
    if (!known && equations_.exclude(lower, upper, box_, linear_, proof)) return;
    program_.set_columns(free_.N().transpose() * set_->B);
    improve_by_rounds(low, proof);
  }

  std::unique_ptr<Bound> clone() const override {
    return std::make_unique<FreeBound>(model_, columns_, set_);
  }

 private:
  static constexpr int kMostRounds = 24;
  static constexpr int kMostSteps = 120;
  static constexpr double kBelow = 1e-9;
  static constexpr double kClose = 0.1;

  void take(double U, BoxProof& proof) {
    both_.resize(2 * model_->n + model_->m);
    both_ << lambda_, nu_, free_.centre_lambda();
    proof.improve(U, both_);
  }

  /// U(lambda, nu), rounding included. Leaves the violations in `values_`.
  double value() {
    box_.weigh(lambda_, nu_);
    free_.weigh(lambda_, box_.g());
    sizes_ = lambda_.cwiseAbs();
    const double share = kBoundRounding * kMostSpread;
    const double off =
        share * (sizes_.dot(model_->tau + free_.sizes()) + nu_.cwiseAbs().dot(model_->f));
    return values_.bound(0, box_.g(), box_.h(), off, share * sizes_.dot(model_->a));
  }

  void improve_by_rounds(double low, BoxProof& proof) {
    rounds_.begin(proof.basis, *model_, values_.at());
    for (int round = 0; round < kMostRounds; ++round) {
      const double least =
          program_.solve(low_ - kBelow * std::abs(low_), kMostSteps, rounds_.columns(), solved_);
      lambda_.noalias() = free_.N() * solved_.head(own_rows_);
      nu_.noalias() = linear_.M().transpose() * solved_.tail(model_->m);
      take(value(), proof);
      if (proof.high <= low) break;
      const bool useful = values_.is_useful(proof.high);
      const double off = values_.at().maxCoeff() - least;
      if (useful && off <= kClose * std::max(proof.high - low_, 0.0)) break;
      if (!rounds_.add(values_.at(), least)) break;
    }
    proof.basis = rounds_.basis();
  }

  void write_point(Eigen::Index i, Eigen::Index id) {
    const Eigen::Index size = model_->size;
    const double t = id / size % 2 != 0 ? values_.most_t() : values_.least_t();
    const Eigen::Index v = id % size;
    box_.read(v);
    load_ = box_.tau() + t * box_.a();
    free_.add(v, static_cast<int>(id / (2 * size)), load_);
    entries_.head(own_rows_).noalias() = free_.N().transpose() * load_;
    entries_.tail(model_->m).noalias() = linear_.M() * box_.f();
    for (Eigen::Index j = 0; j < entries_.size(); ++j) program_.row(j)[i] = entries_[j];
    program_.costs()[i] = t;
  }

  std::shared_ptr<const LoopModel> model_;
  std::shared_ptr<const FreeColumns> columns_;
  std::shared_ptr<const Zonotope> set_;
  const Eigen::Index own_rows_;  ///< multipliers lambda = N y: the length of y
  LoopBox box_;
  LoopLinear linear_;
  EquationProgram equations_;
  FreePoints free_;
  MultiplierProgram program_;
  PointValues values_;
  ProgramRounds rounds_;
  double low_ = 0, high_ = 0;
  Eigen::VectorXd lambda_, nu_, solved_, both_, sizes_, entries_, load_;
};

}  // namespace

std::unique_ptr<Bound> make_free_bound(const Problem& problem) {
  auto model = std::make_shared<const LoopModel>(problem);
  auto columns = std::make_shared<const FreeColumns>(problem, *model);
  auto set = std::make_shared<const Zonotope>(problem.robot.actuation);
  if (model->n < 1 + columns->k) {
    throw std::invalid_argument(problem.name +
                                ": wrench: got 'any' with more components than the robot has "
                                "coordinates, expected pure for a proof: nothing limits them");
  }
  if (!set->u_min.allFinite() || !set->u_max.allFinite()) {
    throw std::invalid_argument(problem.name +
                                ": wrench: got 'any' with efforts without limits, expected pure "
                                "or limits for a proof: nothing limits the other components");
  }
  if (!FreePoints::few_patterns(*model, set->actuators())) {
    throw std::invalid_argument(problem.name +
                                ": wrench: got 'any', expected pure for a proof with so many "
                                "actuators and coordinates");
  }
  return std::make_unique<FreeBound>(std::move(model), std::move(columns), std::move(set));
}

}  // namespace maxwrench
