#include "lib/posture/ik/ik_solver.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lib/posture/ik/ik_start_system.h"

namespace maxwrench {
namespace {

/// [rad or m] From so near no place of the atlas is looked for.
constexpr double kNear = 0.2;
/// How far a way around leads off the real numbers, as a share of its length.
constexpr double kSidestep = 0.4;
/// [rad or m] The lattice of the order of postures.
constexpr double kEqual = 1e-7;

double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a.size() == 0 ? 0 : (a - b).lpNorm<Eigen::Infinity>();
}

}  // namespace

Branches::Branches(std::shared_ptr<const BranchAtlas> atlas)
    : atlas_(std::move(atlas)), carrier_(atlas_->chain(), atlas_->pose()) {}

int Branches::solve(const Eigen::VectorXd& theta_r) {
  if (!atlas_->reaches()) return 0;
  if (node_.theta_r.size() == theta_r.size() && node_.theta_r == theta_r && node_.complete) {
    return count();
  }
  next_.theta_r = theta_r;
  const AtlasNode& from = nearest(theta_r);
  next_.complete =
      from.complete && (go_straight(from) || go_around(from, 1) || go_around(from, -1));
  if (!next_.complete) atlas_->go_from_generic(theta_r, carrier_, next_);
  std::swap(node_, next_);
  if (node_.complete) last_ = node_;
  sort();
  return count();
}

const AtlasNode& Branches::nearest(const Eigen::VectorXd& theta_r) {
  double best = last_.complete ? distance(last_.theta_r, theta_r) : kInfinity;
  if (best < kNear) return last_;
  int place = -1;
  for (int i = 0; i < atlas_->nodes(); ++i) {
    const double way = distance(atlas_->place(i), theta_r);
    if (way >= best) continue;
    best = way;
    place = i;
  }
  if (place < 0 || !atlas_->node(place).complete) return last_;
  return atlas_->node(place);
}

bool Branches::go_straight(const AtlasNode& from) {
  next_.real = from.real;
  next_.pairs = from.pairs;
  return carrier_.go_straight(from.theta_r, next_);
}

bool Branches::go_around(const AtlasNode& from, double side) {
  Way<Complex>& way = carrier_.way();
  assign(from.theta_r, way.from);
  assign(next_.theta_r, way.to);
  for (Eigen::Index k = 0; k < way.bend.size(); ++k) {
    way.bend[k] = Complex(0, side * 4 * kSidestep * (next_.theta_r[k] - from.theta_r[k]));
  }
  carrier_.begin();
  for (const Six<double>& y : from.real) carrier_.carry(complex_of(y));
  for (const Six<Complex>& y : from.pairs) {
    carrier_.carry(y);
    Six<Complex> conjugate = y;
    for (Complex& y_i : conjugate) y_i.im = -y_i.im;
    carrier_.carry(conjugate);
  }
  return carrier_.finish(atlas_->solutions(), next_);
}

void Branches::sort() {
  // On a lattice, so that rounding rarely changes the order; -pi and pi of an angle are one place.
  const ToolChain& chain = atlas_->chain();
  const auto place = [&](const Six<double>& y, int i) {
    const double y_i = y[static_cast<std::size_t>(i)];
    const bool wraps = chain.turns(i) && y_i < kEqual - std::numbers::pi;
    return std::round((wraps ? std::numbers::pi : y_i) / kEqual);
  };
  std::sort(node_.real.begin(), node_.real.end(), [&](const Six<double>& a, const Six<double>& b) {
    for (int i = 0; i < chain.unknowns(); ++i) {
      if (place(a, i) != place(b, i)) return place(a, i) < place(b, i);
    }
    return false;
  });
}

}  // namespace maxwrench
