#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "lib/measure/closed_form.h"
#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/bound/box_support.h"
#include "solvers/certify/bound/ellipsoid_support.h"
#include "solvers/certify/bound/loop_box.h"
#include "solvers/certify/bound/loop_linear.h"
#include "solvers/certify/bound/multiplier_program.h"

namespace maxwrench {
namespace {

/// t <= (sum_k max |u_k| |B_k| + |tau|) / |J'c|, where only the base's free axes count: the linear
/// ones for a force and the angular ones for a torque. On all three axes of that kind, |J'c| is the
/// length of the force or torque of c. The share of axes that are not free is subtracted from its
/// square. The ceiling is infinite if the base does not follow in closed form, and where the second
/// contact may bear t c in place of the base.
double ceiling_of(const Problem& problem, const LoopCoordinates& coordinates) {
  constexpr double kLeastLength2 = 1e-6;
  if (!coordinates.base_is_dependent || coordinates.forces_grow()) return kInfinity;
  Problem wide = problem;
  wide.robot.base_axes = {0, 1, 2, 3, 4, 5};
  wide.theta_r_min.array() -= kCeilingMargin;
  wide.theta_r_max.array() += kCeilingMargin;
  const LoopModel model(wide);
  const Zonotope& set = problem.robot.actuation;
  const bool pushes = !problem.c.head<3>().isZero(0);
  const int kind = pushes ? 0 : 3;
  std::vector<int> rows;
  Eigen::Array3d taken = model.a.segment<3>(kind).array().square();
  double load2 = 0;
  for (std::size_t i = 0; i < problem.robot.base_axes.size(); ++i) {
    const int axis = problem.robot.base_axes[i] - kind;
    if (axis < 0 || axis >= 3) continue;
    rows.push_back(static_cast<int>(i));
    taken[axis] = 0;
    load2 += model.tau[kind + axis] * model.tau[kind + axis];
  }
  const double length2 = problem.c.segment<3>(kind).squaredNorm() - taken.sum();
  if (rows.empty() || !(length2 > kLeastLength2)) {
    throw std::invalid_argument(problem.name +
                                ": wrench.c: got a direction that the base's free axes do not "
                                "limit, expected one that they limit in all postures, for a proof");
  }
  double force = std::sqrt(load2);
  for (Eigen::Index k = 0; k < set.actuators(); ++k) {
    force += std::max(std::abs(set.u_min[k]), std::abs(set.u_max[k])) * set.B.col(k)(rows).norm();
  }
  return force / std::sqrt(length2) * (1 + kCeilingRounding);
}

enum class PureMeasure { kPolytope, kSmallestEffort, kEllipsoid };

class PureBound final : public Bound {
 public:
  /// K is B^+ for the L2 polytope and W_u B^+ for the ellipsoid; it is not used otherwise.
  PureBound(std::shared_ptr<const LoopModel> model, double ceiling, const Zonotope& set,
            const Eigen::MatrixXd& K, PureMeasure measure)
      : model_(std::move(model)),
        ceiling_(ceiling),
        set_(set),
        K_(K),
        measure_(measure),
        most_rank_(std::min<Eigen::Index>(model_->m, model_->coordinates.chain.count())),
        support_(set, by_effort()),
        box_(*model_),
        linear_(*model_),
        program_(extended_B(), set.u_min.head(found_by_program() ? set.actuators() : 0),
                 set.u_max.head(found_by_program() ? set.actuators() : 0), kMostPoints) {
    if (!found_by_program()) ellipsoid_.emplace(K);
    entries_.resize(free_rows() + most_rank_);
    at_.resize(2 * model_->size);
  }

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
    if (model_->coordinates.forces_grow() && low < 0) {  // only t >= 0 is known
      if (!(high > 0)) return;
      bound_from(lower, upper, 0, high, proof);
      proof.high = std::max(proof.high, 0.0);
      return;
    }
    bound_from(lower, upper, low, high, proof);
  }

  std::unique_ptr<Bound> clone() const override {
    return std::make_unique<PureBound>(model_, ceiling_, set_, K_, measure_);
  }

 private:
  void bound_from(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low,
                  double high, BoxProof& proof) {
    least_t_ = std::isfinite(low) ? low : std::min(-kWide, -2 * std::abs(high));
    if (!std::isfinite(least_t_)) least_t_ = -kWide;
    most_t_ = std::isfinite(high) ? high : kWide * std::max(1.0, std::abs(least_t_));
    const Eigen::Index rows = this->rows();
    if (proof.multiplier.size() == rows + model_->m) {
      lambda_ = proof.multiplier.head(rows);
      nu_ = proof.multiplier.tail(model_->m);
      take(value(low, high), proof);
      if (proof.high <= low) return;
    } else {
      lambda_.setZero(rows);
      nu_.setZero(model_->m);
      value(low, high);
    }
    if (model_->m > 0) linear_.precondition(lower, upper);
    rank_ = std::min<Eigen::Index>(linear_.rank(), most_rank_);
    if (ellipsoid_) aim(lower, upper, low, high, proof);
    if (proof.high <= low || entries_.size() == 0) return;
    improve_by_rounds(low, high, proof);
  }

  static constexpr Eigen::Index kMostPoints = 1024;
  static constexpr int kMostRounds = 24;
  static constexpr std::size_t kMostAdded = 8;
  static constexpr int kMostSteps = 120;
  static constexpr double kBelow = 1e-9;
  static constexpr double kClose = 0.1;
  static constexpr double kWide = 1e3;

  /// The length of lambda.
  Eigen::Index rows() const { return support_.B().rows(); }

  /// The lambda of the ellipsoid is its normal at the centre of the box, and the program finds nu.
  bool found_by_program() const { return measure_ != PureMeasure::kEllipsoid; }
  bool by_effort() const { return measure_ == PureMeasure::kSmallestEffort; }
  Eigen::Index free_rows() const { return found_by_program() ? rows() : 0; }

  Eigen::MatrixXd extended_B() const {
    const Eigen::Index columns = found_by_program() ? support_.B().cols() : 0;
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(free_rows() + most_rank_, columns);
    all.topRows(free_rows()) = support_.B().leftCols(columns).topRows(free_rows());
    return all;
  }

  /// Also sets the initial U, without nu.
  void aim(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low, double high,
           BoxProof& proof) {
    box_.evaluate((lower + upper) / 2);
    ellipsoid_->aim(box_.tau(), box_.a(), low, lambda_);
    nu_.setZero();
    take(value(low, high), proof);
  }

  void take(double U, BoxProof& proof) {
    both_.resize(lambda_.size() + nu_.size());
    both_ << lambda_, nu_;
    proof.improve(U, both_);
  }

  /// U(lambda, nu), rounding included. Leaves the violations in at_.
  double value(double low, double high) {
    const double s = ellipsoid_ ? ellipsoid_->of(lambda_) : support_.of(lambda_);
    if (by_effort()) {
      reach_.noalias() = K_.transpose() * lambda_;
      sizes_.noalias() = K_.cwiseAbs().transpose() * lambda_.cwiseAbs();
    } else {
      reach_ = lambda_;
      sizes_ = lambda_.cwiseAbs();
    }
    box_.weigh(reach_, nu_);
    const double T = std::max(std::abs(least_t_), std::abs(most_t_));
    const double share = kBoundRounding * kMostSpread;
    const double off = (ellipsoid_ ? ellipsoid_->rounding() : support_.rounding()) +
                       share * (sizes_.dot(model_->tau) + nu_.cwiseAbs().dot(model_->f));
    const double off_a = share * sizes_.dot(model_->a);
    s_ = s;
    at_.head(model_->size) = least_t_ * (1 - box_.h().array()) - box_.g().array();
    at_.tail(model_->size) = most_t_ * (1 - box_.h().array()) - box_.g().array();
    double U = kInfinity;
    if (std::isfinite(low) && std::isfinite(high)) {
      U = s + at_.maxCoeff() + off + T * (off_a + kBoundRounding);
    }
    // t <= (s - g)/h by convexity, where h > 0 at all points.
    if (U > low && box_.h().minCoeff() > 2 * off_a) {
      const double ratio = ((s + off - box_.g().array()) /
                            (box_.h().array() - (s + off - box_.g().array()).sign() * off_a))
                               .maxCoeff();
      U = std::min(U, ratio + 1e-14 * std::abs(ratio));
    }
    return U;
  }

  void improve_by_rounds(double low, double high, BoxProof& proof) {
    begin_points(proof.basis);
    for (int round = 0; round < kMostRounds; ++round) {
      const double least =
          program_.solve(least_t_ - kBelow * std::abs(least_t_), kMostSteps, local_, solved_);
      if (!ellipsoid_) lambda_ = solved_.head(rows());
      nu_.noalias() = linear_.M().topRows(rank_).transpose() * solved_.segment(free_rows(), rank_);
      take(value(low, high), proof);
      if (proof.high <= low) break;
      const double now = s_ + at_.maxCoeff();
      const bool finite = std::isfinite(proof.high);
      if (finite && now - least <= kClose * std::max(proof.high - least_t_, 0.0)) break;
      if (!add_points(least)) break;
    }
    keep_basis(proof.basis);
  }

  /// Begins with the points of a larger box's basis and those that are worst at its multiplier;
  /// without a basis, with the corners of the box.
  void begin_points(const std::vector<int>& basis) {
    ids_.clear();
    const auto first = program_.first_point();
    local_ = basis;
    for (int& column : local_) {
      if (column < first) continue;
      ids_.push_back(column - first);
      column = first + static_cast<int>(ids_.size()) - 1;
    }
    if (basis.empty()) add_corners();
    program_.set_points(static_cast<Eigen::Index>(ids_.size()));
    for (std::size_t i = 0; i < ids_.size(); ++i) write_point(static_cast<Eigen::Index>(i));
    if (!basis.empty()) add_points(-kInfinity);
  }

  void add_corners() {
    const Coordinates& chain = model_->coordinates.chain;
    for (Eigen::Index v = 0; v < model_->size && ids_.size() + 2 <= kMostPoints / 2; ++v) {
      Eigen::Index rest = v;
      bool corner = true;
      for (int i = chain.count(); i-- > 0;) {
        corner = corner && (chain.terms(i) == 2 || rest % 3 != 1);
        rest /= chain.terms(i);
      }
      if (!corner) continue;
      ids_.push_back(static_cast<int>(v));
      ids_.push_back(static_cast<int>(v + model_->size));
    }
  }

  /// Point v at least_t_, or point v + size at most_t_.
  void write_point(Eigen::Index i) {
    const Eigen::Index id = ids_[static_cast<std::size_t>(i)];
    const bool high = id >= model_->size;
    const double t = high ? most_t_ : least_t_;
    box_.read(high ? id - model_->size : id);
    const Eigen::Index rows = free_rows();
    load_ = box_.tau() + t * box_.a();
    double cost = t;
    if (ellipsoid_) {
      cost += s_ - lambda_.dot(load_);  // lambda and its support stay the same
    } else if (by_effort()) {
      entries_.head(rows).noalias() = K_ * load_;
    } else {
      entries_.head(rows) = load_;
    }
    entries_.tail(most_rank_).setZero();
    entries_.segment(rows, rank_).noalias() = linear_.M().topRows(rank_) * box_.f();
    for (Eigen::Index j = 0; j < entries_.size(); ++j) program_.row(j)[i] = entries_[j];
    program_.costs()[i] = cost;
  }

  /// Returns false if there are no points to add, or no room for them.
  bool add_points(double least) {
    list_largest(at_, least - s_, kMostAdded, order_);
    const std::size_t before = ids_.size();
    for (const int id : order_) {
      if (std::find(ids_.begin(), ids_.end(), id) == ids_.end()) ids_.push_back(id);
    }
    if (ids_.size() == before || ids_.size() > static_cast<std::size_t>(kMostPoints)) {
      ids_.resize(before);
      return false;
    }
    program_.set_points(static_cast<Eigen::Index>(ids_.size()));
    for (std::size_t i = before; i < ids_.size(); ++i) write_point(static_cast<Eigen::Index>(i));
    return true;
  }

  void keep_basis(std::vector<int>& basis) const {
    basis = local_;
    const auto first = program_.first_point();
    for (int& column : basis) {
      if (column >= first) column = first + ids_[static_cast<std::size_t>(column - first)];
    }
  }

  std::shared_ptr<const LoopModel> model_;
  const double ceiling_;
  const Zonotope& set_;
  const Eigen::MatrixXd K_;
  const PureMeasure measure_;
  const Eigen::Index most_rank_;
  BoxSupport support_;
  std::optional<EllipsoidSupport> ellipsoid_;
  LoopBox box_;
  LoopLinear linear_;
  MultiplierProgram program_;
  Eigen::Index rank_ = 0;
  double least_t_ = 0, most_t_ = 0, s_ = 0;
  Eigen::VectorXd lambda_, nu_, solved_, both_, reach_, sizes_, at_, entries_, load_;
  std::vector<int> ids_, local_, order_;
};

}  // namespace

std::unique_ptr<Bound> make_pure_bound(const Problem& problem, const std::string& measure) {
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
  auto model = std::make_shared<LoopModel>(problem);
  const double ceiling = ceiling_of(problem, model->coordinates);
  return std::make_unique<PureBound>(std::move(model), ceiling, problem.robot.actuation, K, kind);
}

}  // namespace maxwrench
