#include "solvers/search/dp_motion.h"

#include <algorithm>
#include <cmath>

#include "maxwrench/problem.h"
#include "solvers/wrench/makers.h"

namespace maxwrench {

DpMotion::DpMotion(const InstantSource& source)
    : instants_(source.make_instants(
          [](bool one_column) { return one_column ? make_facets() : make_condensed(); })),
      asks_every_(instants_->maps().instants()) {}

void DpMotion::begin(long allowed, SearchRun& run) {
  allowed_ = allowed;
  made_ = 0;
  run_ = &run;
  stopped_ = run.ended();
  instants_->restart();
}

double DpMotion::value(int instant, bool at_knot, double above) {
  if (stopped_ || made_ >= allowed_ || (made_ > 0 && made_ % asks_every_ == 0 && run_->ended())) {
    stopped_ = true;
    return -kInfinity;
  }
  ++made_;
  double value = instants_->value(instant, theta_r_, rate_, acceleration_);
  const bool impulse = instants_->task().impulse;
  const int peak = peak_ < 0 ? -1 : peak_ * instants_->per_interval();
  if (impulse && value > -kInfinity && instant != peak) value = kInfinity;
  if (at_knot && value > above && instants_->collides()) return -kInfinity;
  return value;
}

double DpMotion::at_knot(int i, const Point& a, const Point& b, const Point& c, double above) {
  const SchemeMaps& maps = instants_->maps();
  if (maps.starts && i == 0 && instants_->problem().dependent.empty()) return kInfinity;  // given
  theta_r_ = (a + 4 * b + c) / 6;
  rate_.setZero(a.size());
  acceleration_.setZero(a.size());
  if (maps.dt > 0) {
    rate_ = (c - a) / (2 * maps.dt);
    acceleration_ = (a - 2 * b + c) / (maps.dt * maps.dt);
  }
  return value(maps.knot_at[static_cast<std::size_t>(i)], true, above);
}

double DpMotion::in_interval(int i, const Point& a, const Point& b, const Point& c, const Point& d,
                             double above) {
  const SchemeMaps& maps = instants_->maps();
  const Problem& problem = instants_->problem();
  const int per = instants_->per_interval();
  double least = kInfinity;
  if (!problem.dependent.empty()) {  // dependent joints come from the knot before
    if (!(at_knot(i, a, b, c, kInfinity) > above)) return -kInfinity;
    q_ = instants_->q();
  }
  for (int n = 1; n <= per && least > above && !stopped_; ++n) {
    const double s = static_cast<double>(n) / per, r = 1 - s;
    const double dt = maps.dt;
    theta_r_ = (r * r * r * a + (3 * s * s * s - 6 * s * s + 4) * b +
                (3 * r * r * r - 6 * r * r + 4) * c + s * s * s * d) /
               6;
    rate_ = (r * r * (b - a) + (1 + 2 * s * r) * (c - b) + s * s * (d - c)) / (2 * dt);
    acceleration_ = (r * (a - 2 * b + c) + s * (b - 2 * c + d)) / (dt * dt);
    least = std::min(least, value(i * per + n, n == per, above));
  }
  for (const int joint : problem.dependent) {
    const double most = problem.robot.joints[static_cast<std::size_t>(joint)].velocity_max;
    if (std::abs(instants_->q()[joint] - q_[joint]) > most * maps.dt) return -kInfinity;
  }
  return least;
}

}  // namespace maxwrench
