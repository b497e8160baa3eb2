set(maxwrench_drawing_sources
  axes.cpp bars.cpp camera.cpp colour_scale.cpp convergence.cpp coverage.cpp depth_order.cpp direction.cpp ecdf.cpp face.cpp figures.cpp force_set.cpp front_figure.cpp
  labels.cpp layout.cpp legend.cpp map_figure.cpp motion_curves.cpp
  named_curves.cpp panel.cpp posture_legend.cpp postures.cpp projections.cpp scatter.cpp svg.cpp tank_curves.cpp
  margin_figure.cpp)
