#include "lib/math/nearest_edge.h"

#include <array>
#include <cmath>

namespace maxwrench {
namespace {

constexpr std::size_t kAxisCount = 4;
/// Chords that are shorter, and points that are farther out by no more, count as none; relative to
/// 1 + the distance of the points.
constexpr double kChordRounding = 1e-10;

Eigen::Vector2d axis(std::size_t i) {
  constexpr std::array<double, kAxisCount> x = {1, 0, -1, 0}, y = {0, 1, 0, -1};
  return {x[i], y[i]};
}

}  // namespace

NearestEdge::NearestEdge() { chords_.reserve(64); }

void NearestEdge::start() {
  chords_.clear();
  value_ = kInfinity;
  inner_ = -kInfinity;
}

double NearestEdge::distance(std::size_t chord, Eigen::Vector2d& normal) const {
  const Eigen::Vector2d& p = chords_[chord].from;
  const Eigen::Vector2d& q = chords_[(chord + 1) % chords_.size()].from;
  const Eigen::Vector2d along = q - p;
  if (along.norm() <= kChordRounding * (1 + p.norm())) return kInfinity;
  normal = Eigen::Vector2d(along.y(), -along.x()).normalized();
  return normal.dot(p);
}

bool NearestEdge::asks() {
  if (chords_.size() < kAxisCount) {
    direction_ = axis(chords_.size());
    return true;
  }
  inner_ = kInfinity;
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < chords_.size(); ++i) {
    const double nearest = distance(i, normal);
    if (!(nearest < inner_)) continue;
    inner_ = nearest;
    asked_ = i;
    direction_ = normal;
  }
  return inner_ < value_ && !chords_[asked_].is_edge;
}

void NearestEdge::answer(double value, const Eigen::Vector2d& point) {
  if (value < value_) {
    value_ = value;
    normal_ = direction_;
  }
  if (chords_.size() < kAxisCount) {
    chords_.push_back({point});
    return;
  }
  if (!(value > inner_ + kChordRounding * (1 + point.norm()))) {
    chords_[asked_].is_edge = true;
    return;
  }
  chords_.insert(chords_.begin() + static_cast<std::ptrdiff_t>(asked_) + 1, Chord{point});
}

}  // namespace maxwrench
