#include "maxwrench/path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

constexpr double kDuration = 3;
constexpr Timing kTimings[] = {Timing::kCubic, Timing::kQuintic, Timing::kLinear};

struct NamedPath {
  std::string name;
  Path path;
};

Pose<double> random_pose(Random& random) {
  return {random_rotation(random), random_vector(random)};
}

const std::vector<double> kPathTimes = {0, 0.5, 1.2, 2, kDuration};

std::vector<Pose<double>> random_poses(Random& random) {
  std::vector<Pose<double>> poses;
  for (std::size_t i = 0; i < kPathTimes.size(); ++i) poses.push_back(random_pose(random));
  return poses;
}

/// Turns, lines, arcs and screws with every timing, and a spline.
std::vector<NamedPath> paths() {
  Random random(1);
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  std::vector<NamedPath> all;
  for (const Timing timing : kTimings) {
    const Pose<double> start = random_pose(random);
    const Eigen::Vector3d axis = random_vector(random).normalized();
    const Eigen::Vector3d centre = random_vector(random), step = random_vector(random);
    const std::string suffix = " " + std::to_string(static_cast<int>(timing));
    all.push_back(
        {"rotation" + suffix, Path::screw(start, axis, start.p, 4, none, timing, kDuration)});
    all.push_back({"line" + suffix, Path::screw(start, axis, centre, 0, step, timing, kDuration)});
    all.push_back({"arc" + suffix, Path::screw(start, axis, centre, -2, none, timing, kDuration)});
    all.push_back({"screw" + suffix, Path::screw(start, axis, centre, 7, step, timing, kDuration)});
  }
  all.push_back({"constant", Path::constant(random_pose(random), kDuration)});
  all.push_back({"spline", Path::spline(kPathTimes, random_poses(random))});
  return all;
}

/// [linear; angular] per second between two poses, 2 e apart in time.
Vector6d rate(const Pose<double>& before, const Pose<double>& after, double e) {
  Vector6d twist;
  twist << after.p - before.p, logarithm(after.R * before.R.transpose());
  return twist / (2 * e);
}

TEST(Path, TwistAndAccelerationAreTheDerivativesOfThePose) {
  constexpr double e = 1e-5;
  for (const auto& [name, path] : paths()) {
    for (double t = 0.05; t < kDuration; t += 0.1) {  // not at a knot
      const PathPoint before = path.at(t - e), here = path.at(t), after = path.at(t + e);
      EXPECT_LT((rate(before.pose, after.pose, e) - here.twist).norm(), 1e-6) << name << t;
      const Vector6d change = (after.twist - before.twist) / (2 * e);
      EXPECT_LT((change - here.acceleration).norm(), 1e-6 * (1 + change.norm())) << name << t;
      EXPECT_TRUE((here.pose.R.transpose() * here.pose.R).isIdentity(1e-12)) << name;
    }
  }
}

TEST(Path, RestsAtBothEnds) {
  for (const auto& [name, path] : paths()) {
    if (name.ends_with(" 2")) continue;  // linear in time: it starts and stops at once
    for (const double t : {0.0, kDuration}) {
      EXPECT_LT(path.at(t).twist.norm(), 1e-12) << name;
      const bool quintic = name.ends_with(" 1") || name == "constant";
      if (quintic) {
        EXPECT_LT(path.at(t).acceleration.norm(), 1e-12) << name;
      }
    }
  }
}

TEST(Path, IsAsAtTheEndsBeforeAndAfterIt) {
  for (const auto& [name, path] : paths()) {
    EXPECT_EQ(path.duration(), kDuration);
    EXPECT_EQ(path.pose(-1).p, path.pose(0).p) << name;
    EXPECT_EQ(path.pose(99).R, path.pose(kDuration).R) << name;
  }
}

/// By hand: phi of the timings at s = 1/2 and s = 1/4.
TEST(Path, TimingsAreThoseOfTheirFormulas) {
  const double quarter[] = {3. / 16 - 2. / 64, 10. / 64 - 15. / 256 + 6. / 1024, 0.25};
  const double slope[] = {1.5, 1.875, 1};  // of phi at s = 1/2
  for (std::size_t i = 0; i < 3; ++i) {
    const Path path = Path::screw({}, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero(), 0,
                                  Eigen::Vector3d(2, 0, 0), kTimings[i], 4);
    EXPECT_NEAR(path.pose(1).p.x(), 2 * quarter[i], 1e-15);
    EXPECT_NEAR(path.pose(2).p.x(), 1, 1e-15);
    EXPECT_NEAR(path.at(2).twist[0], 2 * slope[i] / 4, 1e-15);
    EXPECT_NEAR(path.pose(4).p.x(), 2, 1e-15);
  }
}

TEST(Path, ATurnInPlaceHasNoLinearTwist) {
  Random random(2);
  const Pose<double> start = random_pose(random);
  const Eigen::Vector3d axis = random_vector(random).normalized();
  const Path path =
      Path::screw(start, axis, start.p, M_PI, Eigen::Vector3d::Zero(), Timing::kCubic, kDuration);
  for (double t = 0; t <= kDuration; t += 0.25) {
    const PathPoint point = path.at(t);
    EXPECT_TRUE(point.pose.p.isApprox(start.p, 1e-14));
    EXPECT_LT(point.twist.head<3>().norm(), 1e-14);
    EXPECT_LT(point.twist.tail<3>().cross(axis).norm(), 1e-14);
  }
  EXPECT_EQ(path.angle(), M_PI);
  const Eigen::Matrix3d turn = path.pose(kDuration).R * start.R.transpose();
  EXPECT_TRUE(turn.isApprox(Eigen::AngleAxisd(M_PI, axis).toRotationMatrix(), 1e-14));
}

/// A quarter about y through (1, 0, 0), from the origin: it ends above the centre, and x, which
/// pointed at the centre, still does.
TEST(Path, AnArcTurnsWithItsRadius) {
  const Path path = Path::screw({}, Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX(), M_PI / 2,
                                Eigen::Vector3d::Zero(), Timing::kLinear, 2);
  EXPECT_TRUE(path.pose(2).p.isApprox(Eigen::Vector3d(1, 0, 1), 1e-14));
  for (const double t : {0.0, 0.7, 2.0}) {
    const PathPoint point = path.at(t);
    const Eigen::Vector3d to_centre = Eigen::Vector3d::UnitX() - point.pose.p;
    EXPECT_TRUE(point.pose.R.col(0).isApprox(to_centre, 1e-14));
    const double omega = M_PI / 4;  // the acceleration is the centripetal one
    EXPECT_TRUE(point.acceleration.head<3>().isApprox(omega * omega * to_centre, 1e-12));
  }
}

TEST(Path, ASplinePassesItsPoses) {
  Random random(3);
  const std::vector<Pose<double>> poses = random_poses(random);
  const Path path = Path::spline(kPathTimes, poses);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_TRUE(path.pose(kPathTimes[i]).p.isApprox(poses[i].p, 1e-12));
    EXPECT_TRUE(path.pose(kPathTimes[i]).R.isApprox(poses[i].R, 1e-12));
  }
  EXPECT_EQ(path.angle(), 0);
  EXPECT_EQ(path.duration(), kPathTimes.back());
}

/// From pose to pose it takes the shorter way round, whatever the signs of the quaternions: here
/// in six steps of 60 degrees once about z, where some of them change.
TEST(Path, ASplineTurnsTheShorterWay) {
  std::vector<double> times;
  std::vector<Pose<double>> poses;
  for (int i = 0; i <= 6; ++i) {
    times.push_back(i);
    const Eigen::AngleAxisd turn(i * M_PI / 3, Eigen::Vector3d::UnitZ());
    poses.push_back({turn.toRotationMatrix(), Eigen::Vector3d::Zero()});
  }
  const Path path = Path::spline(times, poses);
  double turned = 0;
  for (double t = 0.005; t < 6; t += 0.01) turned += 0.01 * path.at(t).twist[5];
  EXPECT_NEAR(turned, 2 * M_PI, 1e-4);
  EXPECT_GT(path.at(3).twist[5], 0.9 * M_PI / 3);
}

TEST(Path, SplinesThatAreNoneAreRejected) {
  const Pose<double> one;
  Pose<double> half = one;
  half.R = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const double nan = std::nan("");
  EXPECT_THROW(Path::spline({0}, {one}), std::invalid_argument);
  EXPECT_THROW(Path::spline({0, 1}, {one}), std::invalid_argument);
  EXPECT_THROW(Path::spline({0, 1, 1}, {one, one, one}), std::invalid_argument);
  EXPECT_THROW(Path::spline({1, 2}, {one, one}), std::invalid_argument);
  EXPECT_THROW(Path::spline({0, nan}, {one, one}), std::invalid_argument);
  EXPECT_THROW(Path::spline({0, 1}, {one, half}), std::invalid_argument);
}

template <class F>
std::string thrown_by(F f) {
  try {
    f();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Path, ScrewsThatAreNoneAreRejected) {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ(), none = Eigen::Vector3d::Zero();
  const double nan = std::nan("");
  const auto screw = [&](const Eigen::Vector3d& axis, double angle, double duration) {
    return Path::screw({}, axis, none, angle, none, Timing::kCubic, duration);
  };
  EXPECT_NO_THROW(screw(z, 1, 1));
  EXPECT_THROW(screw(2 * z, 1, 1), std::invalid_argument);
  EXPECT_THROW(screw(none, 1, 1), std::invalid_argument);
  EXPECT_THROW(screw(z, nan, 1), std::invalid_argument);
  for (const double duration : {0.0, -1.0, nan, kInfinity}) {
    EXPECT_THROW(screw(z, 1, duration), std::invalid_argument) << duration;
    EXPECT_THROW(Path::constant({}, duration), std::invalid_argument) << duration;
  }
}

TEST(Scheme, NamesAreReadAsTheyAreWritten) {
  for (const bool impulse : {false, true}) {
    for (const std::string& name : scheme_names(impulse))
      EXPECT_EQ(to_string(parse_scheme(name)), name);
  }
  for (const char* name : {"static", "rest", "zero", "free"})
    EXPECT_STREQ(to_string(parse_start(name)), name);
  EXPECT_EQ(parse_scheme("backward_stop"), Scheme::kBackwardStop);
}

TEST(Scheme, UnknownNamesAreRejectedWithTheAlternatives) {
  EXPECT_EQ(thrown_by([] { parse_scheme("central"); }),
            "scheme: got 'central', expected one of forward, ends, spline, backward, "
            "backward_stop");
  EXPECT_EQ(thrown_by([] { parse_start(""); }),
            "start: got '', expected one of static, rest, zero, free");
}

}  // namespace
}  // namespace maxwrench
