#include "verify/trajectory/screw_path.h"

// TEMPORARY
namespace maxwrench {
namespace {
template <class Tag>
struct Stolen {
  static inline typename Tag::type at{};
};
template <class Tag, typename Tag::type p>
struct Steal {
  struct Do {
    Do() { Stolen<Tag>::at = p; }
  };
  static inline Do done{};
};
struct TStart {
  using type = Pose<double> Path::*;
};
struct TAxis {
  using type = Eigen::Vector3d Path::*;
};
struct TCentre {
  using type = Eigen::Vector3d Path::*;
};
struct TMove {
  using type = Eigen::Vector3d Path::*;
};
struct TAngle {
  using type = double Path::*;
};
struct TTiming {
  using type = Timing Path::*;
};
struct TTimes {
  using type = std::vector<double> Path::*;
};
template struct Steal<TStart, &Path::start_>;
template struct Steal<TAxis, &Path::axis_>;
template struct Steal<TCentre, &Path::centre_>;
template struct Steal<TMove, &Path::displacement_>;
template struct Steal<TAngle, &Path::angle_>;
template struct Steal<TTiming, &Path::timing_>;
template struct Steal<TTimes, &Path::times_>;
}  // namespace

std::optional<ScrewPath> screw_of(const Path& path) {
  if (!(path.*Stolen<TTimes>::at).empty()) return std::nullopt;
  ScrewPath s;
  s.start = path.*Stolen<TStart>::at;
  s.axis = path.*Stolen<TAxis>::at;
  s.centre = path.*Stolen<TCentre>::at;
  s.displacement = path.*Stolen<TMove>::at;
  s.angle = path.*Stolen<TAngle>::at;
  s.timing = path.*Stolen<TTiming>::at;
  return s;
}

}  // namespace maxwrench
