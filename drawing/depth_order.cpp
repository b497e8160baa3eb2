#include "drawing/depth_order.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;
using Outline = std::vector<Point>;

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

double area(const Outline& outline) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    twice += cross(outline[i] - outline[0], outline[i + 1] - outline[0]);
  }
  return twice / 2;
}

/// Depth over the picture: slope.x x + slope.y y + offset.
struct Plane {
  Point slope;
  double offset = 0;

  double operator()(const Point& p) const { return slope.dot(p) + offset; }
};

/// A face with what comparisons need.
struct Sheet {
  Face face;
  Outline outline;  ///< counterclockwise
  Plane plane;
  Eigen::AlignedBox2d box;
  std::size_t number = 0;  ///< of the face in the list that was given
  double depth = 0;        ///< of its middle
};

Plane plane_of(const std::vector<Eigen::Vector3d>& corners) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(), middle = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d& next = corners[(i + 1) % corners.size()];
    normal += (corners[i] - corners[0]).cross(next - corners[0]);
    middle += corners[i] / static_cast<double>(corners.size());
  }
  Plane plane;
  plane.slope = -normal.head<2>() / normal.z();
  plane.offset = middle.z() - plane.slope.dot(middle.head<2>());
  return plane;
}

/// The part of a convex outline to the left of the line from a to b.
Outline left_of(const Outline& outline, const Point& a, const Point& b) {
  Outline part;
  const auto side = [&](const Point& p) { return cross(b - a, p - a); };
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point &p = outline[i], &q = outline[(i + 1) % outline.size()];
    const double at_p = side(p), at_q = side(q);
    if (at_p >= 0) part.push_back(p);
    if ((at_p < 0) != (at_q < 0)) part.push_back(p + at_p / (at_p - at_q) * (q - p));
  }
  return part;
}

Outline overlap(const Sheet& a, const Sheet& b) {
  if (!a.box.intersects(b.box)) return {};
  Outline part = a.outline;
  for (std::size_t i = 0; i < b.outline.size() && part.size() > 2; ++i) {
    part = left_of(part, b.outline[i], b.outline[(i + 1) % b.outline.size()]);
  }
  return part;
}

/// The part of a face where the plane is at least zero. The cut is no line.
Face cut(const Face& face, const Plane& plane) {
  Face part{{}, face.colour, face.opacity, face.shines_through, {}};
  const std::size_t count = face.corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d &p = face.corners[i], &q = face.corners[(i + 1) % count];
    const double at_p = plane(p.head<2>()), at_q = plane(q.head<2>());
    const bool line = !face.lines.empty() && face.lines[i];
    const bool crosses = (at_p < 0) != (at_q < 0);
    if (at_p >= 0) {
      part.corners.push_back(p);
      part.lines.push_back(line);
    }
    if (!crosses) continue;
    part.corners.emplace_back(p + at_p / (at_p - at_q) * (q - p));
    part.lines.push_back(at_p < 0 && line);
  }
  return part;
}

Plane operator-(const Plane& plane) { return {-plane.slope, -plane.offset}; }

enum class Relation { kNone, kBehind, kInFront, kPierced };

class DepthOrder {
 public:
  explicit DepthOrder(double tolerance) : tolerance_(tolerance) {}

  void add(Face face, std::size_t number) {
    std::vector<Face> pieces = {std::move(face)};
    while (!pieces.empty()) {
      Sheet sheet;
      const bool seen = make_sheet(pieces.back(), number, sheet);
      pieces.pop_back();
      if (!seen) continue;
      const std::size_t first = sheets_.size();
      const auto pierced = relate(sheet, true);
      if (pierced < first) {
        const Plane difference = minus(sheet.plane, sheets_[pierced].plane);
        pieces.push_back(cut(sheet.face, difference));
        pieces.push_back(cut(sheet.face, -difference));
        continue;
      }
      accept(std::move(sheet));
    }
  }

  std::vector<Face> ordered() {
    std::vector<Face> faces;
    for (std::size_t i = 0; i < sheets_.size(); ++i) release(i);
    while (true) {
      while (!ready_.empty()) {
        const std::size_t next = ready_.top().second;
        ready_.pop();
        done_[next] = true;
        faces.push_back(sheets_[next].face);
        for (const std::size_t i : before_[next]) {
          --waits_[i];
          release(i);
        }
      }
      const std::size_t in_ring = any_ring();
      if (in_ring == sheets_.size()) return faces;
      halve(in_ring);
    }
  }

 private:
  static Plane minus(const Plane& a, const Plane& b) {
    return {a.slope - b.slope, a.offset - b.offset};
  }

  /// Whether the face can be seen.
  bool make_sheet(const Face& face, std::size_t number, Sheet& sheet) const {
    sheet.face = face;
    sheet.number = number;
    sheet.outline = outline_of(face);
    sheet.box.setEmpty();
    for (const Point& p : sheet.outline) sheet.box.extend(p);
    const double size = area(sheet.outline);
    if (face.corners.size() < 3 || std::abs(size) < 0.05 * tolerance_ * sheet.box.sizes().norm()) {
      return false;
    }
    if (size < 0) std::reverse(sheet.outline.begin(), sheet.outline.end());
    sheet.plane = plane_of(face.corners);
    for (const Eigen::Vector3d& p : face.corners) {
      sheet.depth += p.z() / static_cast<double>(face.corners.size());
    }
    return true;
  }

  Relation compare(const Sheet& a, const Sheet& b, bool may_cut) const {
    const Outline common = overlap(a, b);
    if (common.size() < 3 || std::abs(area(common)) < tolerance_ * tolerance_) {
      return Relation::kNone;
    }
    const Plane difference = minus(a.plane, b.plane);
    double least = difference(common[0]), most = least;
    for (const Point& p : common) {
      least = std::min(least, difference(p));
      most = std::max(most, difference(p));
    }
    if (may_cut && least < -tolerance_ && most > tolerance_) return Relation::kPierced;
    if (std::max(-least, most) < 1e-6 * tolerance_) {
      return a.number < b.number ? Relation::kBehind : Relation::kInFront;
    }
    return most > -least ? Relation::kInFront : Relation::kBehind;
  }

  /// Compares a sheet with all that are there and not done. If it may be cut, returns the first one
  /// that pierces it; else, or if there is none, their number.
  std::size_t relate(const Sheet& sheet, bool may_be_cut) {
    behind_.clear();
    in_front_.clear();
    for (std::size_t i = 0; i < sheets_.size(); ++i) {
      if (done_[i]) continue;
      switch (compare(sheet, sheets_[i], may_be_cut)) {
        case Relation::kPierced:
          return i;
        case Relation::kBehind:
          in_front_.push_back(i);
          break;
        case Relation::kInFront:
          behind_.push_back(i);
          break;
        case Relation::kNone:
          break;
      }
    }
    return sheets_.size();
  }

  /// Adds a sheet that `relate` has compared.
  std::size_t accept(Sheet sheet) {
    const std::size_t index = sheets_.size();
    sheets_.push_back(std::move(sheet));
    done_.push_back(false);
    waits_.push_back(behind_.size());
    before_.push_back(in_front_);
    for (const std::size_t i : behind_) before_[i].push_back(index);
    for (const std::size_t i : in_front_) ++waits_[i];
    return index;
  }

  void release(std::size_t i) {
    if (waits_[i] == 0 && !done_[i]) ready_.emplace(sheets_[i].depth, i);
  }

  /// The largest sheet of a ring of sheets each of which waits for the next one; the number of
  /// sheets if all are done.
  std::size_t any_ring() const {
    const std::size_t none = sheets_.size();
    std::vector<std::size_t> waits_for(none, none);
    for (std::size_t i = 0; i < none; ++i) {
      if (done_[i]) continue;
      for (const std::size_t j : before_[i]) {
        if (!done_[j]) waits_for[j] = i;
      }
    }
    std::size_t at = none;
    for (std::size_t i = 0; i < none; ++i) {
      if (!done_[i]) at = i;
    }
    if (at == none) return none;
    for (std::size_t steps = 0; steps < none; ++steps) at = waits_for[at];  // now within the ring
    std::size_t largest = at;
    for (std::size_t i = waits_for[at]; i != at; i = waits_for[i]) {
      if (sheets_[i].box.sizes().norm() > sheets_[largest].box.sizes().norm()) largest = i;
    }
    return largest;
  }

  /// Replaces a sheet by its halves across its longer side; what cannot be halved is drawn.
  void halve(std::size_t whole) {
    const Sheet sheet = sheets_[whole];
    done_[whole] = true;
    const Point size = sheet.box.sizes();
    const bool small = size.norm() < 10 * tolerance_;
    for (const std::size_t i : before_[whole]) --waits_[i];
    const Point across = size.x() > size.y() ? Point::UnitX() : Point::UnitY();
    const Plane middle{across, -across.dot(sheet.box.center())};
    for (const Plane& side : {middle, -middle}) {
      Sheet half;
      if (!make_sheet(small ? sheet.face : cut(sheet.face, side), sheet.number, half)) continue;
      relate(half, false);
      if (small) behind_.clear();
      accept(half);
      if (small) break;
    }
    for (std::size_t i = 0; i < sheets_.size(); ++i) release(i);
  }

  double tolerance_;
  std::vector<Sheet> sheets_;
  std::vector<bool> done_;
  std::vector<std::size_t> waits_;                ///< how many sheets must be drawn before
  std::vector<std::vector<std::size_t>> before_;  ///< the sheets that are drawn later
  std::vector<std::size_t> behind_, in_front_;    ///< of the sheet that is compared
  std::priority_queue<std::pair<double, std::size_t>, std::vector<std::pair<double, std::size_t>>,
                      std::greater<>>
      ready_;  ///< the farthest first
};

}  // namespace

std::vector<Face> depth_order(std::vector<Face> faces, double tolerance) {
  DepthOrder order(tolerance);
  for (std::size_t i = 0; i < faces.size(); ++i) order.add(std::move(faces[i]), i);
  return order.ordered();
}

}  // namespace maxwrench
