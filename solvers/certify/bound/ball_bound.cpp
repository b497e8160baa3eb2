#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "solvers/certify/bound/any_rows.h"
#include "solvers/certify/bound/bounds.h"

namespace maxwrench {
namespace {

using Eigen::Vector2d;

/// The rays with which the search at the centre of a box begins, and the largest number of them.
constexpr int kFirstRays = 8;
constexpr std::size_t kMostRays = 60;
/// The largest number of directions of a box that follow one another.
constexpr int kMostTurns = 4;
/// A turn below this ends the search for a direction.
constexpr double kSmallTurn = 1e-7;
/// Beyond the rounding of a length and a quotient.
constexpr double kTurnRounding = 8 * std::numeric_limits<double>::epsilon();

Vector2d across(const Vector2d& d) { return {-d[1], d[0]}; }

/// What a direction d proves, and with which multiplier mu; the normal of the edge of P that the
/// ray along d meets, and how far along d.
struct Turned {
  double high = kInfinity;
  Eigen::VectorXd mu;
  Vector2d normal;
  double along_d = kInfinity;
};

/// Where the ray at an angle leaves P.
struct RayEnd {
  double angle;
  Vector2d point;
};

class BallAnyBound final : public Bound {
 public:
  explicit BallAnyBound(std::shared_ptr<const AnyModel> model)
      : model_(std::move(model)),
        box_(model_->f),
        rows_(*model_, sizes_of(*model_), with_zeros(model_->j_min, 1 + model_->held),
              with_zeros(model_->j_max, 1 + model_->held)) {}

  double ceiling() const override { return rows_.ceiling(); }

  void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low, double high,
                BoxProof& proof) override {
    const Eigen::VectorXd known = proof.multiplier;
    proof.forget(high);
    if (!(spread(model_->f.coordinates(), lower, upper) <= kMostSpread)) return;
    Q_ = box_.over(lower, upper).transpose();
    Vector2d d = Vector2d::Zero();
    if (known.size() == 2 + numbers()) {
      d = known.head<2>();
      turn(d, known.tail(numbers()), low, proof);
      if (proof.high <= low) return;
    }
    Q_ = model_->f.evaluate((lower + upper) / 2).transpose();
    const Vector2d nearest = nearest_edge(low);
    if ((nearest - d).norm() < kSmallTurn) return;
    Q_ = box_.over(lower, upper).transpose();
    turn(nearest, {}, low, proof);
  }

  std::unique_ptr<Bound> clone() const override { return std::make_unique<BallAnyBound>(model_); }

 private:
  static Eigen::VectorXd sizes_of(const AnyModel& model) {
    return rows_along(model.sizes.transpose(), model, Vector2d::Ones(), -Vector2d::Ones())
        .transpose();
  }

  /// The numbers of mu: a multiplier of each joint, then of each axis along which nothing is free.
  /// The multiplier of the wrench across d stands between them.
  Eigen::Index numbers() const { return model_->j + model_->held; }

  /// U of the direction d at the points of Q_. mu is where to begin, or empty.
  Turned bound_along(const Vector2d& d, const Eigen::VectorXd& mu, double low) {
    const Eigen::Index j = model_->j, held = model_->held;
    rows_.points() = rows_along(Q_, *model_, d, across(d));
    BoxProof own;
    if (mu.size() > 0) {
      own.multiplier.resize(j + 1 + held);
      own.multiplier << mu.head(j), 0, mu.tail(held);
    }
    rows_.bound(low, own);
    const double s = own.multiplier[j];
    const Vector2d turned = d + s * across(d);
    const double length = turned.norm(), high = own.high / length;
    Eigen::VectorXd mu_of_turned(numbers());
    mu_of_turned << own.multiplier.head(j), own.multiplier.tail(held);
    return {high + kTurnRounding * std::abs(high), mu_of_turned / length, turned / length,
            own.high};
  }

  /// Improves the proof by d and the directions that follow from it.
  void turn(Vector2d d, Eigen::VectorXd mu, double low, BoxProof& proof) {
    for (int i = 0; i < kMostTurns; ++i) {
      const double before = proof.high;
      const Turned next = bound_along(d, mu, low);
      Eigen::VectorXd multiplier(2 + numbers());
      multiplier << next.normal, next.mu;
      proof.improve(next.high, multiplier);
      const double turned = (next.normal - d).norm();
      if (proof.high <= low || turned < kSmallTurn || !(proof.high < before)) return;
      d = next.normal;
      mu = next.mu;
    }
  }

  /// The normal of the edge of P nearest to zero at the one point of Q_, unless an edge is found
  /// that is not above `low`. Where rays leave P is known; between two of them no edge is nearer
  /// than the chord of their points. So rays are added along the normal of the nearest chord.
  Vector2d nearest_edge(double low) {
    rays_.clear();
    Vector2d nearest = Vector2d::UnitX();
    double least = kInfinity;
    const auto shoot = [&](double angle) {
      const Vector2d d(std::cos(angle), std::sin(angle));
      const Turned met = bound_along(d, {}, low);
      const auto later = [angle](const RayEnd& ray) { return ray.angle > angle; };
      rays_.insert(std::find_if(rays_.begin(), rays_.end(), later), {angle, met.along_d * d});
      if (!(met.high < least)) return;
      least = met.high;
      nearest = met.normal;
    };
    for (int k = 0; k < kFirstRays; ++k) shoot(2 * std::numbers::pi * k / kFirstRays);
    while (least > low && rays_.size() < kMostRays) {
      double nearer = least - kSmallTurn * std::abs(least), angle = kInfinity;
      for (std::size_t k = 0; k < rays_.size(); ++k) {
        const bool last = k + 1 == rays_.size();
        const RayEnd &from = rays_[k], &to = rays_[last ? 0 : k + 1];
        const Vector2d out = -across(to.point - from.point).normalized();
        const double width = to.angle - from.angle + (last ? 2 * std::numbers::pi : 0);
        if (width < kSmallTurn || !(out.dot(from.point) < nearer)) continue;
        nearer = out.dot(from.point);
        const double turn = std::remainder(std::atan2(out[1], out[0]) - from.angle - width / 2,
                                           2 * std::numbers::pi);
        angle = from.angle + width / 2 + (std::abs(turn) < 0.49 * width ? turn : 0);
      }
      if (angle == kInfinity) break;
      shoot(angle);
    }
    return nearest;
  }

  std::shared_ptr<const AnyModel> model_;
  ControlPoints box_;
  AnyRows rows_;
  Eigen::MatrixXd Q_;
  std::vector<RayEnd> rays_;  ///< counterclockwise
};

}  // namespace

std::unique_ptr<Bound> make_ball_any_bound(const Problem& problem, const Matrix6Xd& E) {
  return std::make_unique<BallAnyBound>(
      std::make_shared<const AnyModel>(make_any_model(problem, E)));
}

}  // namespace maxwrench
