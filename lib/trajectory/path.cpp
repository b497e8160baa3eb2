#include "maxwrench/path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "lib/math/cubic_spline.h"
#include "lib/math/require.h"

namespace maxwrench {
namespace {

/// phi and its first and second derivatives by s.
struct Progress {
  double value, slope, bend;
};

Progress progress(Timing timing, double s) {
  switch (timing) {
    case Timing::kCubic:
      return {s * s * (3 - 2 * s), 6 * s * (1 - s), 6 - 12 * s};
    case Timing::kQuintic:
      return {s * s * s * (10 + s * (6 * s - 15)), 30 * s * s * (1 - s) * (1 - s),
              60 * s * (1 - s) * (1 - 2 * s)};
    case Timing::kLinear:
      break;
  }
  return {s, 1, 0};
}

void require_poses(const std::vector<double>& times, const std::vector<Pose<double>>& poses) {
  if (times.size() != poses.size() || times.size() < 2) {
    throw std::invalid_argument("path: got " + std::to_string(times.size()) + " times and " +
                                std::to_string(poses.size()) +
                                " poses, expected as many, two or more");
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    const bool rises = i == 0 ? times[0] == 0 : times[i] > times[i - 1] && std::isfinite(times[i]);
    if (rises) continue;
    throw std::invalid_argument("path: got " + std::to_string(times[i]) +
                                ", expected times that rise from 0");
  }
}

/// [p; w, x, y, z], with the signs of the quaternions chosen so that neighbours are close.
Eigen::MatrixXd coordinates(const std::vector<Pose<double>>& poses) {
  Eigen::MatrixXd values(7, static_cast<Eigen::Index>(poses.size()));
  for (Eigen::Index i = 0; i < values.cols(); ++i) {
    const Pose<double>& pose = poses[static_cast<std::size_t>(i)];
    const Eigen::Quaterniond e(pose.R);
    values.col(i) << pose.p, e.w(), e.vec();
    if (i == 0) continue;
    const double cosine = values.col(i).tail<4>().dot(values.col(i - 1).tail<4>());
    if (std::abs(cosine) < 1e-9) {
      throw std::invalid_argument("path: got pose " + std::to_string(i + 1) +
                                  ", expected one turned by less than pi from the previous one");
    }
    if (cosine < 0) values.col(i).tail<4>() *= -1;
  }
  return values;
}

Eigen::Quaterniond quaternion(const Eigen::Vector4d& e) { return {e[0], e[1], e[2], e[3]}; }

/// The value with this name in a table of pairs (value, name).
template <class Table>
auto parse(const Table& table, const char* what, const std::string& name) {
  std::string names;
  for (const auto& [value, its_name] : table) {
    if (name == its_name) return value;
    names += std::string(names.empty() ? "" : ", ") + its_name;
  }
  throw std::invalid_argument(std::string(what) + ": got '" + name + "', expected one of " + names);
}

template <class Table, class Value>
const char* name_of(const Table& table, Value value) {
  for (const auto& [other, name] : table)
    if (value == other) return name;
  return "unknown";
}

constexpr std::array<std::pair<Scheme, const char*>, 5> kSchemes = {{
    {Scheme::kForward, "forward"},
    {Scheme::kEnds, "ends"},
    {Scheme::kSpline, "spline"},
    {Scheme::kBackward, "backward"},
    {Scheme::kBackwardStop, "backward_stop"},
}};

constexpr std::array<std::pair<Start, const char*>, 4> kStarts = {{
    {Start::kStatic, "static"},
    {Start::kRest, "rest"},
    {Start::kZero, "zero"},
    {Start::kFree, "free"},
}};

}  // namespace

Path Path::screw(const Pose<double>& start, const Eigen::Vector3d& axis,
                 const Eigen::Vector3d& centre, double angle, const Eigen::Vector3d& displacement,
                 Timing timing, double duration) {
  require(duration > 0 && std::isfinite(duration), "path duration", duration,
          "a finite number > 0");
  require(std::abs(axis.norm() - 1) < 1e-9, "path axis", axis.norm(), "a vector of length 1");
  require(start.p.allFinite() && start.R.allFinite() && centre.allFinite() &&
              std::isfinite(angle) && displacement.allFinite(),
          "path", angle, "finite numbers");
  Path path;
  path.start_ = start;
  path.axis_ = axis;
  path.centre_ = centre;
  path.angle_ = angle;
  path.displacement_ = displacement;
  path.timing_ = timing;
  path.duration_ = duration;
  return path;
}

Path Path::constant(const Pose<double>& pose, double duration) {
  return screw(pose, Eigen::Vector3d::UnitZ(), pose.p, 0, Eigen::Vector3d::Zero(), Timing::kCubic,
               duration);
}

Path Path::spline(const std::vector<double>& times, const std::vector<Pose<double>>& poses) {
  require_poses(times, poses);
  Path path;
  path.start_ = poses.front();
  path.duration_ = times.back();
  path.times_ = times;
  path.values_ = coordinates(poses);
  path.bends_ = clamped_spline_bends(times, path.values_);
  return path;
}

PathPoint Path::at(double t) const {
  const double s = std::clamp(t / duration_, 0.0, 1.0);
  if (!times_.empty()) return on_spline(s * duration_);
  const Progress phi = progress(timing_, s);
  const double slope = phi.slope / duration_, bend = phi.bend / (duration_ * duration_);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle_ * phi.value, axis_).toRotationMatrix();
  const Eigen::Vector3d arm = turn * (start_.p - centre_);
  const Eigen::Vector3d omega = angle_ * slope * axis_, alpha = angle_ * bend * axis_;
  PathPoint point;
  point.pose.R = turn * start_.R;
  point.pose.p = centre_ + arm + phi.value * displacement_;
  point.twist << omega.cross(arm) + slope * displacement_, omega;
  point.acceleration << alpha.cross(arm) + omega.cross(omega.cross(arm)) + bend * displacement_,
      alpha;
  return point;
}

/// Let E be the curve of quaternions before they are normalised. Then E_dot E^-1 = (a, omega/2),
/// where a is the rate of log |E|. Its derivative is E_ddot E^-1 - (E_dot E^-1)^2.
PathPoint Path::on_spline(double t) const {
  const SplineInstant at = spline_at(times_, t);
  const Eigen::Matrix<double, 7, 3> curve =
      values_.middleCols<2>(at.interval) * at.weights.topRows<2>() +
      bends_.middleCols<2>(at.interval) * at.weights.bottomRows<2>();
  const Eigen::Quaterniond E = quaternion(curve.col(0).tail<4>()), inverse = E.inverse();
  const Eigen::Quaterniond rate = quaternion(curve.col(1).tail<4>()) * inverse;
  const Eigen::Quaterniond bend = quaternion(curve.col(2).tail<4>()) * inverse;
  PathPoint point;
  point.pose.p = curve.col(0).head<3>();
  point.pose.R = E.normalized().toRotationMatrix();
  point.twist << curve.col(1).head<3>(), 2 * rate.vec();
  point.acceleration << curve.col(2).head<3>(), 2 * bend.vec() - 4 * rate.w() * rate.vec();
  return point;
}

const char* to_string(Scheme scheme) { return name_of(kSchemes, scheme); }
const char* to_string(Start start) { return name_of(kStarts, start); }

Scheme parse_scheme(const std::string& name) { return parse(kSchemes, "scheme", name); }
Start parse_start(const std::string& name) { return parse(kStarts, "start", name); }

std::vector<std::string> scheme_names(bool impulse) {
  if (impulse) return {"forward", "backward", "backward_stop", "spline"};
  return {"forward", "ends", "spline"};
}

}  // namespace maxwrench
