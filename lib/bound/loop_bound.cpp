#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "lib/bound/bounds.h"
#include "lib/bound/loop_box.h"
#include "lib/bound/loop_linear.h"
#include "lib/bound/multiplier_program.h"
#include "lib/measure/closed_form.h"

namespace maxwrench {
namespace {

/// Where the base follows from the joints, c on its linear axes, or a torque on the angular ones,
/// is as long in all postures; so the base's forces limit t. Else infinite.
double loop_ceiling(const Problem& problem, const LoopModel& model) {
  if (!model.coordinates.base_follows) return kInfinity;
  const Zonotope& set = problem.robot.actuation;
  const bool pushes = problem.c.head<3>().norm() > 0;
  const Eigen::Index row = pushes ? 0 : 3;
  double most = model.tau.segment<3>(row).norm();
  for (Eigen::Index k = 0; k < set.actuators(); ++k) {
    const double u = std::max(std::abs(set.u_min[k]), std::abs(set.u_max[k]));
    most += u * set.B.col(k).segment<3>(row).norm();
  }
  return most / problem.c.segment<3>(row).norm() * (1 + 1e-6);
}

/// As `make_polytope_bound`, with nu'f added to the rows.
class LoopBound final : public Bound {
 public:
  LoopBound(std::shared_ptr<const LoopModel> model, double ceiling, const Zonotope& set,
            const Eigen::MatrixXd& K, bool l2)
      : model_(std::move(model)),
        ceiling_(ceiling),
        set_(set),
        K_(K),
        l2_(l2),
        most_rank_(std::min<Eigen::Index>(model_->m, model_->coordinates.chain.count())),
        B_(l2 ? Eigen::MatrixXd::Identity(set.actuators(), set.actuators()) : set.B),
        farthest_(set.u_min.cwiseAbs().cwiseMax(set.u_max.cwiseAbs())),
        box_(*model_),
        linear_(*model_),
        program_(extended_B(), set.u_min, set.u_max, kMostPoints) {
    entries_.resize(B_.rows() + most_rank_);
  }

  double ceiling() const override { return ceiling_; }

  void extend(Eigen::VectorXd& lower, Eigen::VectorXd& upper) const override {
    lower = model_->coordinates.lower.array() - kLimitTolerance;
    upper = model_->coordinates.upper.array() + kLimitTolerance;
  }

  bool shrink(Eigen::VectorXd& lower, Eigen::VectorXd& upper) override {
    return linear_.shrink(lower, upper);
  }

  void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low, double high,
                BoxProof& proof) override {
    proof.kind = BoxProof::Kind::kNone;
    proof.high = high;
    proof.pair = -1;
    if (!box_.set(lower, upper)) return;
    least_t_ = std::isfinite(low) ? low : std::min(-kWide, -2 * std::abs(high));
    if (!std::isfinite(least_t_)) least_t_ = -kWide;
    most_t_ = std::isfinite(high) ? high : kWide * std::max(1.0, std::abs(least_t_));
    const Eigen::Index rows = B_.rows();
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
    linear_.precondition(lower, upper);
    rank_ = std::min<Eigen::Index>(linear_.rank(), most_rank_);
    improve_by_rounds(low, high, proof);
  }

  std::unique_ptr<Bound> clone() const override {
    return std::make_unique<LoopBound>(model_, ceiling_, set_, K_, l2_);
  }

 private:
  static constexpr Eigen::Index kMostPoints = 1024;
  static constexpr int kMostRounds = 24;
  static constexpr std::size_t kMostAdded = 24;
  static constexpr int kMostSteps = 120;
  static constexpr double kBelow = 1e-9;
  static constexpr double kClose = 0.02;
  static constexpr double kWide = 1e3;

  Eigen::MatrixXd extended_B() const {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(B_.rows() + most_rank_, B_.cols());
    all.topRows(B_.rows()) = B_;
    return all;
  }

  void take(double U, BoxProof& proof) const {
    if (!(U < proof.high)) return;
    proof.kind = BoxProof::Kind::kMultiplier;
    proof.high = U;
    proof.multiplier.resize(lambda_.size() + nu_.size());
    proof.multiplier << lambda_, nu_;
  }

  /// U(lambda, nu), rounding included; what is violated is left in at_low_ and at_high_.
  double value(double low, double high) {
    slope_.noalias() = B_.transpose() * lambda_;
    double s = 0;
    for (Eigen::Index k = 0; k < slope_.size(); ++k) {
      s += slope_[k] * (slope_[k] > 0 ? set_.u_max[k] : set_.u_min[k]);
    }
    reach_ = l2_ ? Eigen::VectorXd(K_.transpose() * lambda_) : lambda_;
    box_.weigh(reach_, nu_);
    sizes_.noalias() = B_.cwiseAbs().transpose() * lambda_.cwiseAbs();
    own_sizes_ = l2_ ? Eigen::VectorXd(K_.cwiseAbs().transpose() * lambda_.cwiseAbs())
                     : Eigen::VectorXd(lambda_.cwiseAbs());
    const double T = std::max(std::abs(least_t_), std::abs(most_t_));
    const double by_a = own_sizes_.dot(model_->a);
    const double off =
        kBoundRounding * (sizes_.dot(farthest_) + kMostSpread * (own_sizes_.dot(model_->tau) +
                                                                 nu_.cwiseAbs().dot(model_->f)));
    const double off_a = kBoundRounding * kMostSpread * by_a;
    support_ = s;
    at_low_ = least_t_ * (1 - box_.h().array()) - box_.g().array();
    at_high_ = most_t_ * (1 - box_.h().array()) - box_.g().array();
    double U = kInfinity;
    if (std::isfinite(low) && std::isfinite(high)) {
      U = s + std::max(at_low_.maxCoeff(), at_high_.maxCoeff()) + off +
          T * (off_a + kBoundRounding);
    }
    // t <= (s - g)/h by convexity, where h > 0 at all points.
    if (box_.h().minCoeff() > 2 * off_a) {
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
      lambda_ = solved_.head(B_.rows());
      nu_.noalias() = linear_.M().topRows(rank_).transpose() * solved_.segment(B_.rows(), rank_);
      take(value(low, high), proof);
      if (proof.high <= low) break;
      const double now = support_ + std::max(at_low_.maxCoeff(), at_high_.maxCoeff());
      if (now - least <= kClose * std::max(proof.high - least_t_, 0.0)) break;
      if (!add_points(least)) break;
    }
    keep_basis(proof.basis);
  }

  /// Those of the basis of a larger box, and those that are worst at its multiplier; without one
  /// the corners of the box.
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
        const int values = chain.turns[static_cast<std::size_t>(i)] != 0 ? 3 : 2;
        corner = corner && (values == 2 || rest % 3 != 1);
        rest /= values;
      }
      if (!corner) continue;
      ids_.push_back(static_cast<int>(v));
      ids_.push_back(static_cast<int>(v + model_->size));
    }
  }

  /// Point v at least_t_, or v + size at most_t_.
  void write_point(Eigen::Index i) {
    const Eigen::Index id = ids_[static_cast<std::size_t>(i)];
    const bool high = id >= model_->size;
    const double t = high ? most_t_ : least_t_;
    box_.read(high ? id - model_->size : id);
    const Eigen::Index rows = B_.rows();
    load_ = box_.tau() + t * box_.a();
    if (l2_) {
      entries_.head(rows).noalias() = K_ * load_;
    } else {
      entries_.head(rows) = load_;
    }
    entries_.tail(most_rank_).setZero();
    entries_.segment(rows, rank_).noalias() = linear_.M().topRows(rank_) * box_.f();
    for (Eigen::Index j = 0; j < entries_.size(); ++j) program_.row(j)[i] = entries_[j];
    program_.costs()[i] = t;
  }

  /// False if there is none, or no room.
  bool add_points(double least) {
    order_.clear();
    const Eigen::Index N = model_->size;
    const auto at = [&](Eigen::Index id) { return id < N ? at_low_[id] : at_high_[id - N]; };
    for (Eigen::Index id = 0; id < 2 * N; ++id) {
      if (support_ + at(id) > least) order_.push_back(id);
    }
    if (order_.size() > kMostAdded) {
      std::nth_element(order_.begin(), order_.begin() + kMostAdded, order_.end(),
                       [&](Eigen::Index i, Eigen::Index j) { return at(i) > at(j); });
      order_.resize(kMostAdded);
    }
    const std::size_t before = ids_.size();
    for (const Eigen::Index id : order_) {
      const int one = static_cast<int>(id);
      if (std::find(ids_.begin(), ids_.end(), one) == ids_.end()) ids_.push_back(one);
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
  const bool l2_;
  const Eigen::Index most_rank_;
  const Eigen::MatrixXd B_;
  const Eigen::VectorXd farthest_;
  LoopBox box_;
  LoopLinear linear_;
  MultiplierProgram program_;
  Eigen::Index rank_ = 0;
  double least_t_ = 0, most_t_ = 0, support_ = 0;
  Eigen::VectorXd lambda_, nu_, solved_, slope_, reach_, sizes_, own_sizes_, at_low_, at_high_,
      entries_, load_;
  std::vector<int> ids_, local_;
  std::vector<Eigen::Index> order_;
};

}  // namespace

std::unique_ptr<Bound> make_loop_bound(const Problem& problem, bool l2) {
  const Zonotope& set = problem.robot.actuation;
  if (l2) require_full_row_rank(problem.robot, "l2_polytope");
  auto model = std::make_shared<LoopModel>(problem);
  const double ceiling = loop_ceiling(problem, *model);
  return std::make_unique<LoopBound>(std::move(model), ceiling, set,
                                     l2 ? set.B_pinv : Eigen::MatrixXd(), l2);
}

}  // namespace maxwrench
