#include "solvers/certify/trajectory/instant_bound.h"

#include <algorithm>
#include <cmath>

#include "solvers/certify/bound/bound_points.h"
#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/bound/box_support.h"
#include "solvers/certify/bound/exact_posture.h"
#include "solvers/certify/bound/multiplier_program.h"
#include "solvers/certify/trajectory/instant_loads.h"
#include "solvers/certify/trajectory/quadratic_loads.h"

namespace maxwrench {
namespace {

/// The multi-affine rows [tau_0; a; m_1 .. m_r; d_1 .. d_r], n each; d only if the robot moves.
class InstantModel {
 public:
  explicit InstantModel(const PlanInstant& at)
      : at_(at),
        n_(at.task.robot.velocities()),
        r_(at.task.redundancy()),
        moves_(!at.rests()),
        f_(rows_of(at, n_, r_, moves_)) {
    const Eigen::VectorXd S = f_.magnitudes(at.task.theta_r_min.array() - kCeilingMargin,
                                            at.task.theta_r_max.array() + kCeilingMargin);
    tau = S.head(n_);
    a = S.segment(n_, n_);
    for (Eigen::Index j = 0; j < r_; ++j) {
      const auto most = [j](const NumberRanges& range) {
        return std::max(std::abs(range.low[j]), std::abs(range.high[j]));
      };
      tau += most(at.ranges.bend) * S.segment(bend(j), n_);
      if (moves_) tau += most(at.ranges.rate) * S.segment(rate(j), n_);
    }
  }

  const PlanInstant& at() const { return at_; }
  const MultiAffine& f() const { return f_; }
  Eigen::Index n() const { return n_; }
  Eigen::Index r() const { return r_; }
  bool moves() const { return moves_; }
  Eigen::Index bend(Eigen::Index j) const { return (2 + j) * n_; }       ///< where m_j begins
  Eigen::Index rate(Eigen::Index j) const { return (2 + r_ + j) * n_; }  ///< where d_j begins

  Eigen::VectorXd tau, a;  ///< magnitudes of tau without delta, and of a

 private:
  static MultiAffine rows_of(const PlanInstant& at, Eigen::Index n, Eigen::Index r, bool moves) {
    using Loads = InstantLoads<Extended>;
    ExactPosture posture(at.task);
    Loads loads(at.task, at.x);
    const ExtendedVector none = ExtendedVector::Zero(r);
    const ExtendedVector c = at.task.c.cast<Extended>();
    return {all_coordinates(at.task), at.task.theta_r_min, [&](const ExtendedVector& theta_r) {
              ExtendedVector rows((2 + (moves ? 2 : 1) * r) * n), load;
              posture.set(theta_r);
              loads.set(theta_r);
              loads.evaluate({true, true, false}, none, none, load);
              rows.head(n) = posture.tau_d() + load;
              rows.segment(n, n) = posture.J().transpose() * c;
              for (Eigen::Index j = 0; j < r; ++j) {
                const ExtendedVector unit = ExtendedVector::Unit(r, j);
                loads.evaluate({false, true, false}, none, unit, load);
                rows.segment((2 + j) * n, n) = load;
                if (!moves) continue;
                loads.evaluate({false, true, false}, unit, none, load);
                rows.segment((2 + r + j) * n, n) = load;
              }
              return rows;
            }};
  }

  const PlanInstant& at_;
  Eigen::Index n_, r_;
  bool moves_;
  MultiAffine f_;
};

class InstantBound final : public Bound {
 public:
  InstantBound(std::shared_ptr<const InstantModel> model, std::unique_ptr<Bound> collision)
      : model_(std::move(model)),
        collision_(std::move(collision)),
        set_(model_->at().task.robot.actuation),
        support_(set_, false),
        box_(model_->f()),
        program_(extended_B(), extended(set_.u_min), extended(set_.u_max),
                 2 * model_->f().size() + kMostRounds * static_cast<Eigen::Index>(kMostAdded)),
        quadratic_(model_->at()) {
    const PlanInstant& at = model_->at();
    if (model_->moves()) quadratic_.enclose(at.lower(), at.upper());
    CeilingSizes sizes = ceiling_sizes(at.task);
    const std::vector<int>& axes = at.task.robot.base_axes;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      sizes.tau[axes[i]] = model_->tau[row] + (model_->moves() ? quadratic_.sizes()[row] : 0);
    }
    ceiling_ = pure_ceiling(at.task, at.task.c, set_, sizes);
  }

  double ceiling() const override { return ceiling_; }

  void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low, double high,
                BoxProof& proof) override {
    const Eigen::Index r = model_->r();
    if (collision_) {
      collision_->evaluate(lower.head(r), upper.head(r), low, high, proof);
      if (proof.kind == BoxProof::Kind::kCollision) return;
    }
    const int cut = proof.axis;
    proof.forget(high);
    if (!(spread(model_->f().coordinates(), lower, upper) <= kMostSpread)) return;
    P_ = box_.over(lower, upper).transpose();
    set_motion(lower, upper);
    values_.set_ends(low, high);
    lambda_ = proof.multiplier;
    if (lambda_.size() != model_->n()) lambda_.setZero(model_->n());
    improve(low, proof);
    proof.axis = cut >= 0 || proof.high <= low ? cut : axis_of(lower, upper);
  }

  std::unique_ptr<Bound> clone() const override {
    return std::make_unique<InstantBound>(model_, collision_ ? collision_->clone() : nullptr);
  }

 private:
  static constexpr int kMostRounds = 30;
  static constexpr std::size_t kMostAdded = 16;
  static constexpr int kMostSteps = 400;
  static constexpr double kBelow = 1e-9;
  static constexpr double kClose = 0.02;

  /// The limits of the efforts, and room for those of delta.
  Eigen::VectorXd extended(const Eigen::VectorXd& u) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(u.size() + model_->n());
    all.head(u.size()) = u;
    return all;
  }
  Eigen::MatrixXd extended_B() const {
    const Eigen::Index n = model_->n();
    Eigen::MatrixXd all(n, set_.actuators() + n);
    all << set_.B, -Eigen::MatrixXd::Identity(n, n);
    return all;
  }

  /// Encloses delta over a box, by its mean value form where that is narrower, and moves the linear
  /// part of that form into the control points.
  void set_motion(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
    if (!model_->moves()) return;
    const Eigen::Index n = model_->n(), r = model_->r();
    rate_low_ = lower.tail(r);
    rate_high_ = upper.tail(r);
    quadratic_.enclose(lower, upper);
    for (Eigen::Index i = 0; i < n; ++i) {
      program_.set_limits(set_.actuators() + i, quadratic_.low()[i], quadratic_.high()[i]);
    }
    P_.leftCols(n).rowwise() += quadratic_.constant().transpose();
    const Coordinates& along = model_->f().coordinates();
    Eigen::Index step = P_.rows();
    for (int i = 0; i < along.count(); ++i) {
      const int terms = along.terms(i), at = along.index[static_cast<std::size_t>(i)];
      step /= terms;
      const double reach = quadratic_.reach(at);
      for (Eigen::Index v = 0; v < P_.rows(); ++v) {
        const auto digit = static_cast<int>(v / step % terms);
        const double s = digit == 0 ? -reach : digit + 1 == terms ? reach : 0;
        if (s != 0) P_.row(v).head(n) += s * quadratic_.slopes().col(at).transpose();
      }
    }
    for (Eigen::Index j = 0; j < r; ++j) {
      P_.middleCols(model_->rate(j), n).rowwise() += quadratic_.slopes().col(r + j).transpose();
    }
  }

  /// -lambda'tau at the best motion, for rows of values.
  void reach(const Eigen::MatrixXd& rows, Eigen::VectorXd& most) {
    const Eigen::Index n = model_->n();
    most.noalias() = -rows.leftCols(n) * lambda_;
    const auto add = [&](Eigen::Index from, double low, double high) {
      slopes_.noalias() = -rows.middleCols(from, n) * lambda_;
      most.array() += (low * slopes_.array()).max(high * slopes_.array());
    };
    const NumberRanges& bends = model_->at().ranges.bend;
    for (Eigen::Index j = 0; j < model_->r(); ++j) {
      add(model_->bend(j), bends.low[j], bends.high[j]);
      if (model_->moves()) add(model_->rate(j), rate_low_[j], rate_high_[j]);
    }
  }

  /// U(lambda), rounding included.
  double value() {
    const Eigen::Index n = model_->n();
    reach(P_, g_);
    g_ = -g_;
    h_.noalias() = P_.middleCols(n, n) * lambda_;
    s_ = support_.of(lambda_);
    double off = support_.rounding();
    if (model_->moves()) {
      s_ += (-lambda_.array() * quadratic_.low().array())
                .max(-lambda_.array() * quadratic_.high().array())
                .sum();
      off += kBoundRounding * lambda_.cwiseAbs().dot(quadratic_.sizes());
    }
    const double share = kBoundRounding * kMostSpread;
    off += share * lambda_.cwiseAbs().dot(model_->tau);
    const double off_a = share * lambda_.cwiseAbs().dot(model_->a);
    return values_.bound(s_, g_, h_, off, off_a);
  }

  void improve(double low, BoxProof& proof) {
    points_ = 0;
    double least = -kInfinity;
    for (int round = 0;; ++round) {
      proof.improve(value(), lambda_);
      if (proof.high <= low || round == kMostRounds) return;
      const double now = s_ + values_.at().maxCoeff();
      const bool useful = values_.is_useful(proof.high);
      if (useful && now - least <= kClose * std::max(proof.high - values_.least_t(), 0.0)) return;
      if (!add_points(least, round == 0)) return;
      least = program_.solve(values_.least_t() - kBelow * std::abs(values_.least_t()), kMostSteps,
                             proof.basis, lambda_);
    }
  }

  /// Adds control points with the largest values above `least`, each with the best motion.
  bool add_points(double least, bool first) {
    const auto count = first ? static_cast<std::size_t>(2 * P_.rows()) : kMostAdded;
    list_largest(values_.at(), least - s_, count, order_);
    if (order_.empty()) return false;
    program_.set_points(points_ + static_cast<Eigen::Index>(order_.size()));
    for (const int id : order_) add_point(id);
    return true;
  }

  void add_point(Eigen::Index id) {
    const Eigen::Index n = model_->n(), v = id % P_.rows();
    const double t = id < P_.rows() ? values_.least_t() : values_.most_t();
    load_ = P_.row(v).head(n) + t * P_.row(v).segment(n, n);
    const auto add = [&](Eigen::Index from, double low, double high) {
      const double slope = -P_.row(v).segment(from, n).dot(lambda_);
      load_ += (slope > 0 ? high : low) * P_.row(v).segment(from, n);
    };
    const NumberRanges& bends = model_->at().ranges.bend;
    for (Eigen::Index j = 0; j < model_->r(); ++j) {
      add(model_->bend(j), bends.low[j], bends.high[j]);
      if (model_->moves()) add(model_->rate(j), rate_low_[j], rate_high_[j]);
    }
    program_.costs()[points_] = t;
    for (Eigen::Index i = 0; i < n; ++i) program_.row(i)[points_] = load_[i];
    ++points_;
  }

  /// The widest coordinate, with rates in units of 1/kRateTime; -1: there are no rates. What costs
  /// most at lambda is no better guide: lambda avoids the rows of delta, at a price elsewhere.
  int axis_of(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) const {
    if (!model_->moves()) return -1;
    constexpr double kRateTime = 0.5;  // [s]
    Eigen::VectorXd widths = upper - lower;
    widths.tail(model_->r()) *= kRateTime;
    Eigen::Index axis = 0;
    widths.maxCoeff(&axis);
    return static_cast<int>(axis);
  }

  std::shared_ptr<const InstantModel> model_;
  std::unique_ptr<Bound> collision_;
  const Zonotope& set_;
  BoxSupport support_;
  ControlPoints box_;
  MultiplierProgram program_;
  QuadraticLoads quadratic_;
  Eigen::VectorXd rate_low_, rate_high_;
  PointValues values_;
  Eigen::MatrixXd P_;  ///< control points × rows
  Eigen::VectorXd lambda_, g_, h_, slopes_;
  Eigen::RowVectorXd load_;
  std::vector<int> order_;
  double s_ = 0, ceiling_ = kInfinity;
  Eigen::Index points_ = 0;
};

/// A limit of x, from those of theta_r and of its rate.
Eigen::VectorXd joined(const Eigen::VectorXd& place, const Eigen::VectorXd& rate, bool rests) {
  if (rests) return place;
  Eigen::VectorXd x(place.size() + rate.size());
  x << place, rate;
  return x;
}

}  // namespace

bool PlanInstant::rests() const {
  constexpr double kNoRate = 1e-12;  // the rows of a scheme's rates are rounded
  const auto zero = [](const Eigen::VectorXd& range) {
    return range.lpNorm<Eigen::Infinity>() <= kNoRate;
  };
  return x.twist.isZero(0) && zero(ranges.rate.low) && zero(ranges.rate.high);
}

Eigen::VectorXd PlanInstant::lower() const {
  return joined(task.theta_r_min, ranges.rate.low, rests());
}
Eigen::VectorXd PlanInstant::upper() const {
  return joined(task.theta_r_max, ranges.rate.high, rests());
}

std::unique_ptr<Bound> make_instant_bound(const PlanInstant& at) {
  require_few_control_points(at.task.name, all_coordinates(at.task));
  return std::make_unique<InstantBound>(std::make_shared<InstantModel>(at),
                                        at.knot ? make_collision_bound(at.task) : nullptr);
}

}  // namespace maxwrench
