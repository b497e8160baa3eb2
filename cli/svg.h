#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lib/types.h"

namespace maxwrench {

/// How a shape looks. An empty colour draws nothing.
struct Paint {
  std::string stroke = {};
  double width = 1;       ///< px
  std::string dash = {};  ///< px, as in SVG: "4 3"
  std::string fill = {};
  double fill_opacity = 1;
};

enum class Anchor { kStart, kMiddle, kEnd };

struct Font {
  double size = 11;  ///< px
  std::string colour = "#222222";
  Anchor anchor = Anchor::kStart;
  bool bold = false;
  bool italic = false;
  double angle = 0;  ///< degrees, counterclockwise
};

/// Writes an SVG picture on white ground. All coordinates are px, y down, as in SVG.
class Svg {
 public:
  Svg(double width, double height);

  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Paint& paint);
  /// Closed; with two points a line, with one a dot.
  void polygon(const std::vector<Eigen::Vector2d>& points, const Paint& paint);
  void polyline(const std::vector<Eigen::Vector2d>& points, const Paint& paint);
  void circle(const Eigen::Vector2d& centre, double radius, const Paint& paint);
  /// A shaft in the paint's stroke and a filled head of that length at `tip`.
  void arrow(const Eigen::Vector2d& tail, const Eigen::Vector2d& tip, const Paint& paint,
             double head);
  /// `at` is the baseline's anchor. An underscore lowers the next character: "beta_1".
  void text(const Eigen::Vector2d& at, std::string_view text, const Font& font);

  /// Another picture with its upper left corner at `corner`.
  void place(const Svg& other, const Eigen::Vector2d& corner);

  double width() const { return width_; }
  double height() const { return height_; }
  std::string str() const;

 private:
  double width_, height_;
  std::string body_;
};

/// A plane of the world on the paper: metres, y up -> px, y down.
struct Viewport {
  Eigen::Vector2d origin;  ///< px, of the world's (0, 0)
  double scale;            ///< px/m

  Eigen::Vector2d operator()(const Eigen::Vector2d& p) const {
    return {origin.x() + scale * p.x(), origin.y() - scale * p.y()};
  }
  std::vector<Eigen::Vector2d> operator()(const std::vector<Eigen::Vector2d>& points) const;
};

/// The largest of 1, 2, 5 times a power of ten that does not exceed `value`.
double round_step(double value);

}  // namespace maxwrench
