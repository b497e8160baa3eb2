#include "drawing/coverage.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace maxwrench {
namespace {

constexpr double kHiddenShare = 0.2;  ///< of a face that shines through; less is not drawn twice

}  // namespace

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

Samples Coverage::cover(const std::vector<Eigen::Vector2d>& outline) {
  const Samples before = samples(outline);
  if (before.hidden < before.all) visit(outline, [&](std::size_t i) { covered_[i] = true; });
  return before;
}

Samples Coverage::samples(const std::vector<Eigen::Vector2d>& outline) const {
  Samples samples;
  visit(outline, [&](std::size_t i) {
    ++samples.all;
    samples.hidden += covered_[i] ? 1 : 0;
  });
  return samples;
}

double Coverage::share(const Eigen::AlignedBox2d& box) const {
  const Eigen::Vector2d a = box.min(), c = box.max();
  const Samples inside = samples({a, {c.x(), a.y()}, c, {a.x(), c.y()}});
  return inside.all > 0 ? static_cast<double>(inside.hidden) / static_cast<double>(inside.all) : 0;
}

VisibleFaces visible_faces(const std::vector<Face>& ordered, double step) {
  Eigen::AlignedBox2d box;
  for (const Face& face : ordered) {
    for (const Eigen::Vector3d& corner : face.corners) box.extend(corner.head<2>());
  }
  VisibleFaces faces;
  if (box.isEmpty()) return faces;
  Coverage all(box, step), plain(box, step);  // plain: by faces that do not shine through
  for (auto face = ordered.rbegin(); face != ordered.rend(); ++face) {
    const std::vector<Eigen::Vector2d> outline = outline_of(*face);
    const bool opaque = face->opacity == 1;
    const Samples of_all = opaque ? all.cover(outline) : all.samples(outline);
    if (of_all.hidden < of_all.all) faces.seen.push_back(*face);
    if (face->shines_through) {
      const Samples of_plain = plain.samples(outline);
      if (of_plain.hidden > kHiddenShare * static_cast<double>(of_plain.all)) {
        faces.hidden.push_back(*face);
        faces.hidden.back().lines.clear();
      }
    } else if (opaque) {
      plain.cover(outline);
    }
  }
  std::reverse(faces.seen.begin(), faces.seen.end());
  std::reverse(faces.hidden.begin(), faces.hidden.end());
  return faces;
}

}  // namespace maxwrench
