#pragma once

#include "drawing/layout.h"
#include "drawing/svg.h"

namespace maxwrench {

// Colours and paints of panels and their legend.
inline constexpr const char* kInk = "#222222";
inline constexpr const char* kSteel = "#5b6770";
inline constexpr const char* kBaseFill = "#dfe5ea";
inline constexpr const char* kArmFill = "#b4bfc7";
inline const Paint kPaintC{.stroke = "#C24A00", .width = 2};
inline const Paint kPaintContact{.stroke = "#6A3D9A", .width = 1.6, .fill = "#6A3D9A"};
inline const Paint kPaintPlaces{.stroke = "#6A3D9A", .width = 1.4, .dash = "4 3"};
inline const Paint kPaintThrust{.stroke = kSteel, .width = 1.3};

/// The mark of a set: filled at beta c, open at the force that attains beta.
Paint set_mark(const CurveStyle& style, bool open);
void draw_joint(Svg& svg, const Eigen::Vector2d& at);
void draw_link(Svg& svg, const Eigen::Vector2d& a, const Eigen::Vector2d& b);
void draw_mount(Svg& svg, const Eigen::Vector2d& at);

/// The height of a panel with its title, axes and values of beta [px].
double panel_height(const Layout& layout);

/// Draws one panel in the cell whose upper left corner is `corner` [px]. `leftmost`: with its y
/// axis.
void draw_panel(Svg& svg, const Layout& layout, const DrawnPosture& panel, const Scene& scene,
                const Eigen::Vector2d& corner, View view, bool leftmost);

/// The legend of the marks in a picture.
std::vector<LegendEntry> posture_legend(const Layout& layout, std::span<const DrawnPosture> panels);

}  // namespace maxwrench
