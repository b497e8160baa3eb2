#include "drawing/coverage.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace maxwrench {

Coverage::Coverage(const Eigen::AlignedBox2d& box, double step)
    : corner_(box.min()),
      step_(step),
      columns_(1 + static_cast<int>(box.sizes().x() / step)),
      rows_(1 + static_cast<int>(box.sizes().y() / step)),
      covered_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

template <class Visit>
void Coverage::visit(const std::vector<Eigen::Vector2d>& outline, const Visit& visit) const {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Eigen::Vector2d& p : outline) {
    low = std::min(low, p.y());
    high = std::max(high, p.y());
  }
  const auto index = [this](double value, double from, int count) {
    return static_cast<int>(std::clamp((value - from) / step_, -1.0, count + 1.0));
  };
  const int first_row = std::max(0, index(low, corner_.y(), rows_));
  for (int row = first_row; row < rows_ && corner_.y() + row * step_ <= high; ++row) {
    const double y = corner_.y() + row * step_;
    double left = std::numeric_limits<double>::infinity(), right = -left;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Eigen::Vector2d &p = outline[i], &q = outline[(i + 1) % outline.size()];
      if ((p.y() <= y) == (q.y() <= y)) continue;
      const double x = p.x() + (y - p.y()) / (q.y() - p.y()) * (q.x() - p.x());
      left = std::min(left, x);
      right = std::max(right, x);
    }
    const int first = std::max(0, index(left, corner_.x(), columns_));
    for (int column = first; column < columns_; ++column) {
      const double x = corner_.x() + column * step_;
      if (x > right) break;
      if (x < left) continue;
      visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
            static_cast<std::size_t>(column));
    }
  }
}

bool Coverage::cover(const std::vector<Eigen::Vector2d>& outline) {
  bool any = false;
  visit(outline, [&](std::size_t i) {
    any = any || !covered_[i];
    covered_[i] = true;
  });
  return any;
}

bool Coverage::shows(const std::vector<Eigen::Vector2d>& outline) const {
  bool any = false;
  visit(outline, [&](std::size_t i) { any = any || !covered_[i]; });
  return any;
}

double Coverage::share(const Eigen::AlignedBox2d& box) const {
  long samples = 0, covered = 0;
  const Eigen::Vector2d a = box.min(), c = box.max();
  visit({a, {c.x(), a.y()}, c, {a.x(), c.y()}}, [&](std::size_t i) {
    ++samples;
    covered += covered_[i] ? 1 : 0;
  });
  return samples > 0 ? static_cast<double>(covered) / static_cast<double>(samples) : 0;
}

std::vector<Face> visible_faces(const std::vector<Face>& ordered, double step) {
  Eigen::AlignedBox2d box;
  for (const Face& face : ordered) {
    for (const Eigen::Vector3d& corner : face.corners) box.extend(corner.head<2>());
  }
  if (box.isEmpty()) return {};
  Coverage coverage(box, step);
  std::vector<Face> visible;
  for (auto face = ordered.rbegin(); face != ordered.rend(); ++face) {
    const std::vector<Eigen::Vector2d> outline = outline_of(*face);
    const bool shows = face->opacity < 1 ? coverage.shows(outline) : coverage.cover(outline);
    if (shows) visible.push_back(*face);
  }
  std::reverse(visible.begin(), visible.end());
  return visible;
}

}  // namespace maxwrench
