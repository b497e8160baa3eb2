#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "lib/measure/closed_form.h"
#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/bound/box_support.h"
#include "solvers/certify/bound/ellipsoid_support.h"
#include "solvers/certify/bound/equation_program.h"
#include "solvers/certify/bound/loop_box.h"
#include "solvers/certify/bound/loop_linear.h"
#include "solvers/certify/bound/program_rounds.h"
#include "solvers/certify/bound/thrust_points.h"

namespace maxwrench {
namespace {

enum class PureMeasure { kPolytope, kSmallestEffort, kEllipsoid };

class PureBound final : public Bound {
 public:
  /// K is B^+ for the L2 polytope and W_u B^+ for the ellipsoid; it is not used otherwise. With
  /// `thrust`, the set has no thrusters.
  PureBound(std::shared_ptr<const LoopModel> model, double ceiling,
            std::shared_ptr<const Zonotope> set, const Eigen::MatrixXd& K, PureMeasure measure,
            std::optional<ThrustPoints> thrust)
      : model_(std::move(model)),
        ceiling_(ceiling),
        set_(std::move(set)),
        K_(K),
        measure_(measure),
        equation_rows_(equation_rows(*model_)),
        support_(*set_, by_effort()),
        thrust_(std::move(thrust)),
        box_(*model_),
        linear_(*model_),
        equations_(*model_),
        program_(extended_B(), set_->u_min.head(found_by_program() ? set_->actuators() : 0),
                 set_->u_max.head(found_by_program() ? set_->actuators() : 0),
                 ProgramPoints::kMost),
        rounds_(
            program_, [this](Eigen::Index i, Eigen::Index id) { write_point(i, id); },
            [this](int id) { return numbered(id); }) {
    if (!found_by_program()) ellipsoid_.emplace(K);
    entries_.setZero(free_rows() + equation_rows_);
  }

  int left_out() const override { return model_->coordinates.left_out; }
  double ceiling() const override { return ceiling_; }

  void extend(Eigen::VectorXd& lower, Eigen::VectorXd& upper) const override {
    if (model_->m == 0) return;  // x is theta_r
    lower = model_->coordinates.lower.array() - kLimitTolerance;
    upper = model_->coordinates.upper.array() + kLimitTolerance;
  }

  bool shrink(Eigen::VectorXd& lower, Eigen::VectorXd& upper, std::vector<BoxCut>* cuts) override {
    return model_->m == 0 || linear_.shrink(lower, upper, cuts);
  }

  void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low, double high,
                BoxProof& proof) override {
    proof.forget(high);
    if (!box_.set(lower, upper)) return;
    if (thrust_) thrust_->set(lower, upper);
    if (model_->coordinates.forces_grow() && low < 0) {  // only t >= 0 is known
      if (!(high > 0)) return;
      bound_from(lower, upper, 0, high, proof);
      if (proof.kind != BoxProof::Kind::kNoPosture) proof.high = std::max(proof.high, 0.0);
      return;
    }
    bound_from(lower, upper, low, high, proof);
  }

  std::unique_ptr<Bound> clone() const override {
    return std::make_unique<PureBound>(model_, ceiling_, set_, K_, measure_, thrust_);
  }

 private:
  void bound_from(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low,
                  double high, BoxProof& proof) {
    values_.set_ends(low, high);
    const Eigen::Index rows = this->rows();
    if (proof.multiplier.size() == rows + model_->m) {
      lambda_ = proof.multiplier.head(rows);
      nu_ = proof.multiplier.tail(model_->m);
      take(value(), proof);
      if (proof.high <= low) return;
    } else {
      lambda_.setZero(rows);
      nu_.setZero(model_->m);
      value();
    }
    if (model_->m > 0) linear_.precondition(lower, upper);
    const bool known = values_.is_useful(proof.high);
    if (!known && equations_.exclude(lower, upper, box_, linear_, proof)) return;
    rows_used_ = model_->size > kFew ? equation_rows_
                                     : std::min<Eigen::Index>(linear_.rank(), equation_rows_);
    if (ellipsoid_) aim(lower, upper, low, proof);
    if (proof.high <= low || entries_.size() == 0) return;
    improve_by_rounds(low, proof);
  }

  static constexpr int kMostRounds = 24;
  static constexpr int kMostSteps = 120;
  static constexpr double kBelow = 1e-9;
  static constexpr double kClose = 0.1;
  static constexpr Eigen::Index kFew = 1000;  ///< control points

  /// The rows of M f in the program. Those after the rank of M have no linear terms; in large boxes
  /// their terms of second order help. A box with few control points is cheaper to cut than to
  /// bound with them.
  static Eigen::Index equation_rows(const LoopModel& model) {
    const Eigen::Index linear = model.coordinates.chain.count();
    return model.size <= kFew ? std::min(model.m, linear) : model.m;
  }

  /// The length of lambda.
  Eigen::Index rows() const { return support_.B().rows(); }

  /// The lambda of the ellipsoid is its normal at the centre of the box, and the program finds nu.
  bool found_by_program() const { return measure_ != PureMeasure::kEllipsoid; }
  bool by_effort() const { return measure_ == PureMeasure::kSmallestEffort; }
  Eigen::Index free_rows() const { return found_by_program() ? rows() : 0; }

  Eigen::MatrixXd extended_B() const {
    const Eigen::Index columns = found_by_program() ? support_.B().cols() : 0;
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(free_rows() + equation_rows_, columns);
    all.topRows(free_rows()) = support_.B().leftCols(columns).topRows(free_rows());
    return all;
  }

  /// Also sets the initial U, without nu.
  void aim(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low,
           BoxProof& proof) {
    box_.evaluate((lower + upper) / 2);
    ellipsoid_->aim(box_.tau(), box_.a(), low, lambda_);
    nu_.setZero();
    take(value(), proof);
  }

  void take(double U, BoxProof& proof) {
    both_.resize(lambda_.size() + nu_.size());
    both_ << lambda_, nu_;
    proof.improve(U, both_);
  }

  /// U(lambda, nu), rounding included. Leaves the violations in at_.
  double value() {
    const double s = ellipsoid_ ? ellipsoid_->of(lambda_) : support_.of(lambda_);
    if (by_effort()) {
      reach_.noalias() = K_.transpose() * lambda_;
      sizes_.noalias() = K_.cwiseAbs().transpose() * lambda_.cwiseAbs();
    } else {
      reach_ = lambda_;
      sizes_ = lambda_.cwiseAbs();
    }
    box_.weigh(reach_, nu_);
    const double share = kBoundRounding * kMostSpread;
    double off = (ellipsoid_ ? ellipsoid_->rounding() : support_.rounding()) +
                 share * (sizes_.dot(model_->tau) + nu_.cwiseAbs().dot(model_->f));
    const double off_a = share * sizes_.dot(model_->a);
    if (thrust_) {
      thrust_->weigh(lambda_, box_.g());
      off += share * lambda_.cwiseAbs().dot(thrust_->sizes());
    }
    s_ = s;
    return values_.bound(s, box_.g(), box_.h(), off, off_a);
  }

  void improve_by_rounds(double low, BoxProof& proof) {
    rounds_.begin(proof.basis, *model_, values_.at());
    const double least_t = values_.least_t();
    for (int round = 0; round < kMostRounds; ++round) {
      const double least = program_.solve(least_t - kBelow * std::abs(least_t), kMostSteps,
                                          rounds_.columns(), solved_);
      if (!ellipsoid_) lambda_ = solved_.head(rows());
      for (const int row : model_->dropped) lambda_[row] = 0;
      nu_.noalias() =
          linear_.M().topRows(rows_used_).transpose() * solved_.segment(free_rows(), rows_used_);
      take(value(), proof);
      if (proof.high <= low) break;
      const double now = s_ + values_.at().maxCoeff();
      const bool useful = values_.is_useful(proof.high);
      if (useful && now - least <= kClose * std::max(proof.high - least_t, 0.0)) break;
      if (!rounds_.add(values_.at(), least - s_)) break;
    }
    proof.basis = rounds_.basis();
  }

  void write_point(Eigen::Index i, Eigen::Index id) {
    const Eigen::Index size = model_->size;
    const double t = id / size % 2 != 0 ? values_.most_t() : values_.least_t();
    const Eigen::Index v = id % size;
    box_.read(v);
    const Eigen::Index rows = free_rows();
    load_ = box_.tau() + t * box_.a();
    if (thrust_) thrust_->add(v, static_cast<int>(id / (2 * size)), load_);
    double cost = t;
    if (ellipsoid_) {
      cost += s_ - lambda_.dot(load_);  // lambda and its support stay the same
    } else if (by_effort()) {
      entries_.head(rows).noalias() = K_ * load_;
    } else {
      entries_.head(rows) = load_;
    }
    entries_.tail(equation_rows_).setZero();
    entries_.segment(rows, rows_used_).noalias() = linear_.M().topRows(rows_used_) * box_.f();
    for (Eigen::Index j = 0; j < entries_.size(); ++j) program_.row(j)[i] = entries_[j];
    program_.costs()[i] = cost;
  }

  /// The number of a point with the thrusters' forces that are worst for lambda.
  int numbered(int id) const {
    if (!thrust_) return id;
    const auto size = static_cast<int>(model_->size);
    return id + 2 * size * thrust_->pattern(id % size);
  }

  std::shared_ptr<const LoopModel> model_;
  const double ceiling_;
  const std::shared_ptr<const Zonotope> set_;
  const Eigen::MatrixXd K_;
  const PureMeasure measure_;
  const Eigen::Index equation_rows_;
  BoxSupport support_;
  std::optional<EllipsoidSupport> ellipsoid_;
  std::optional<ThrustPoints> thrust_;
  LoopBox box_;
  LoopLinear linear_;
  EquationProgram equations_;
  MultiplierProgram program_;
  Eigen::Index rows_used_ = 0;
  PointValues values_;
  ProgramRounds rounds_;
  double s_ = 0;
  Eigen::VectorXd lambda_, nu_, solved_, both_, reach_, sizes_, entries_, load_;
};

}  // namespace

std::unique_ptr<Bound> make_pure_bound(const Problem& problem, const std::string& measure,
                                       std::optional<int> left_out) {
  PureMeasure kind = PureMeasure::kPolytope;
  Eigen::MatrixXd K;
  if (measure == "l2_polytope") {
    kind = PureMeasure::kSmallestEffort;
    require_full_row_rank(problem.robot, measure);
    K = problem.robot.actuation.B_pinv;
  } else if (measure == "ellipsoid") {
    kind = PureMeasure::kEllipsoid;
    K = weighted_inverse(problem.robot, measure);
  }
  auto set = std::make_shared<Zonotope>(problem.robot.actuation);
  const auto thrusters = static_cast<Eigen::Index>(problem.robot.thrusters.size());
  const bool of_base = kind == PureMeasure::kPolytope && base_determines_forces(problem);
  auto model = std::make_shared<LoopModel>(
      problem, of_base ? ContactForces::kOfBase : ContactForces::kShares, left_out);
  for (const int row : model->dropped) set->B.row(row).setZero();
  std::optional<ThrustPoints> thrust;
  if (of_base) {
    thrust.emplace(*model, *set, thrusters);
    set->B.leftCols(thrusters).setZero();
  }
  double ceiling = kInfinity;
  if (of_base) {
    ceiling = braced_ceiling(problem);
  } else if (model->coordinates.base_is_dependent && !model->coordinates.forces_grow()) {
    ceiling = pure_ceiling(problem, problem.c, problem.robot.actuation, ceiling_sizes(problem));
  }
  return std::make_unique<PureBound>(std::move(model), ceiling, std::move(set), K, kind,
                                     std::move(thrust));
}

}  // namespace maxwrench
