#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// The style of a shape. An empty colour draws nothing.
struct Paint {
  std::string stroke = {};
  double width = 1;       ///< px
  std::string dash = {};  ///< px, as in SVG: "4 3"
  std::string fill = {};
  double fill_opacity = 1;
};

/// All figures are this wide, for a column of 8 cm, so that kFontSize is 6.2 pt there.
inline constexpr double kPageWidth = 400;  ///< px
inline constexpr double kFontSize = 11;    ///< px, the smallest size of words and numbers

/// Marks differ in shape, for readers who cannot distinguish colours.
enum class Mark { kCircle, kSquare, kDiamond, kTriangle, kFlipped, kCross };

enum class Anchor { kStart, kMiddle, kEnd };

struct Font {
  double size = kFontSize;  ///< px
  std::string colour = "#222222";
  Anchor anchor = Anchor::kStart;
  bool bold = false;
  bool italic = false;
  double angle = 0;       ///< degrees, counterclockwise
  std::string halo = {};  ///< the colour around the letters, over a picture; empty: none
};

/// The text for XML and HTML, also in a quoted attribute.
std::string escaped(std::string_view text);

/// Writes an SVG picture on a white background. All coordinates are px, y down, as in SVG. Throws
/// std::invalid_argument for a coordinate that is not finite or far outside any picture.
class Svg {
 public:
  Svg(double width, double height);

  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Paint& paint);
  /// A closed polygon; two points give a line, one a dot.
  void polygon(const std::vector<Eigen::Vector2d>& points, const Paint& paint);
  void polyline(const std::vector<Eigen::Vector2d>& points, const Paint& paint);
  void circle(const Eigen::Vector2d& centre, double radius, const Paint& paint);
  /// A shaft in the stroke of the paint and a filled head of length `head` at `tip`.
  void arrow(const Eigen::Vector2d& tail, const Eigen::Vector2d& tip, const Paint& paint,
             double head);
  void mark(const Eigen::Vector2d& at, Mark mark, double radius, const Paint& paint);
  /// `at` is the baseline's anchor. After a word of one letter, an underscore makes the next
  /// character a subscript: "L_2". "direct_l" stays unchanged.
  void text(const Eigen::Vector2d& at, std::string_view text, const Font& font);

  /// Surfaces are many: between `begin_surfaces` and `end_surfaces` they take few bytes each. A
  /// surface closes the gap that renderers leave between neighbours, and lines are as wide as that.
  /// Colours are 0xRRGGBB.
  void begin_surfaces();
  void surface(const std::vector<Eigen::Vector2d>& corners, std::uint32_t colour, double opacity);
  void surface_line(const std::vector<Eigen::Vector2d>& points, std::uint32_t colour);
  void end_surfaces();

  /// Fills the picture with colours from top to bottom; `id` names them in the whole document.
  void backdrop(const std::string& id, const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
                std::uint32_t top, std::uint32_t bottom);

  /// What follows is drawn within a box only, until `end_clip`.
  void begin_clip(const std::string& id, const Eigen::Vector2d& corner,
                  const Eigen::Vector2d& size);
  void end_clip();

  /// What follows is drawn as one translucent shape, until `end_fade`.
  void begin_fade(double opacity);
  void end_fade();

  /// Inserts another picture with its upper left corner at `corner`.
  void place(const Svg& other, const Eigen::Vector2d& corner);

  double width() const { return width_; }
  double height() const { return height_; }
  std::string str() const;

 private:
  double width_, height_;
  std::string body_;
};

/// Maps a plane of the world to the picture: metres, y up -> px, y down.
struct Viewport {
  Eigen::Vector2d origin;  ///< px, of the world's (0, 0)
  double scale;            ///< px/m

  Eigen::Vector2d operator()(const Eigen::Vector2d& p) const {
    return {origin.x() + scale * p.x(), origin.y() - scale * p.y()};
  }
  std::vector<Eigen::Vector2d> operator()(const std::vector<Eigen::Vector2d>& points) const;
};

/// The approximate width of a text [px].
double text_width(std::string_view text, double size);
/// The text if it fits; otherwise an ellipsis and the longest end of the text that fits.
std::string fitted(const std::string& text, double size, double width);
/// Replaces "beta" with the Greek letter.
std::string with_letters(std::string text);

}  // namespace maxwrench
