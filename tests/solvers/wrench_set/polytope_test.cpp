#include <cmath>

#include "tests/support/coded_tasks.h"
#include "tests/support/support.h"
#include "tests/support/wrench_sets.h"
#include "tests/support/zonotope_robot.h"

namespace maxwrench {
namespace {

/// The sum over all choices of d columns of B of |det|: the volume of {B u : |u| <= 1} over 2^d.
double sum_of_minors(const Eigen::MatrixXd& B) {
  const Eigen::Index m = B.cols();
  double sum = 0;
  for (Eigen::Index i = 0; i < m; ++i) {
    for (Eigen::Index j = i + 1; j < m; ++j) {
      for (Eigen::Index k = j + 1; k < m; ++k) {
        sum += std::abs(B.col(i).head<3>().cross(B.col(j).head<3>()).dot(B.col(k).head<3>()));
      }
    }
  }
  return sum;
}

TEST(ForcePolytope, BoxOfDirectDrives) {
  ZonotopeRobot robot(Eigen::Matrix3d::Identity());
  robot.posture.tau_d = Eigen::Vector3d(0.5, 0, -0.25);
  robot.set_limits(Eigen::Matrix3d::Identity(), Eigen::Vector3d(-1, -2, -3),
                   Eigen::Vector3d(2, 2, 1));
  // f = u - tau_d: a box of 3 × 4 × 4 with its lower corner at (-1.5, -2, -2.75).
  const WrenchSet set = force_polytope(robot.problem, robot.posture);
  expect_polytope(set);
  EXPECT_EQ(set.dimension, 3);
  EXPECT_EQ(set.vertices.cols(), 8);
  EXPECT_EQ(set.normals.cols(), 6);
  EXPECT_EQ(set.triangles.cols(), 12);
  EXPECT_NEAR(set.volume, 48, 1e-9);
  EXPECT_NEAR((set.vertices.rowwise().minCoeff() - Eigen::Vector3d(-1.5, -2, -2.75)).norm(), 0,
              1e-12);
  EXPECT_NEAR((set.vertices.rowwise().maxCoeff() - Eigen::Vector3d(1.5, 2, 1.25)).norm(), 0, 1e-12);
  EXPECT_NEAR(
      (set.efforts - (set.vertices.colwise() + Eigen::Vector3d(robot.posture.tau_d))).norm(), 0,
      1e-12);
  EXPECT_NEAR((set.wrenches.topRows<3>() - set.vertices).norm(), 0, 1e-12);
}

TEST(ForcePolytope, TwoLinksInThePlane) {
  // Links of 1 m at angles 0 and q2: the tip is at (1 + cos q2, sin q2), and u = J'f. So the set is
  // the parallelogram of (J')^-1 times the box of efforts; det J = sin q2.
  const double q2 = 0.7, c = std::cos(q2), s = std::sin(q2);
  const Eigen::Vector2d limits(3, 2);
  ZonotopeRobot robot(Eigen::Matrix2d::Identity());
  robot.set_limits(Eigen::Matrix2d::Identity(), -limits, limits);
  robot.posture.J.setZero();
  robot.posture.J.topRows<2>() << -s, -s, 1 + c, c;
  const Eigen::Matrix2d inverse = robot.posture.J.topRows<2>().transpose().inverse();
  WrenchSetOptions options;
  options.E = Matrix6Xd::Identity(6, 2);
  const WrenchSet set = force_polytope(robot.problem, robot.posture, options);
  expect_polytope(set);
  ASSERT_EQ(set.vertices.cols(), 4);
  EXPECT_NEAR(set.volume, 4 * limits.prod() / s, 1e-9);
  for (const double i : {-1, 1}) {
    for (const double j : {-1, 1}) {
      const Eigen::Vector2d corner = inverse * Eigen::Vector2d(3 * i, 2 * j);
      EXPECT_LT((set.vertices.colwise() - corner).colwise().norm().minCoeff(), 1e-9);
    }
  }
  // One direction: the segment where the line meets the parallelogram.
  options.E = Vector6d::Unit(0);
  const WrenchSet line = force_polytope(robot.problem, robot.posture, options);
  expect_polytope(line);
  EXPECT_NEAR(line.volume, 2 * std::min(3 / s, 2 / s), 1e-9);

  // No joint feels a force out of the plane.
  const WrenchSet all = force_polytope(robot.problem, robot.posture);
  EXPECT_EQ(all.status, Status::kUnbounded);
  EXPECT_NEAR(std::abs(all.ray.dot(Eigen::Vector3d::UnitZ())), 1, 1e-9);
  EXPECT_TRUE(all.reason.str().starts_with("no actuator limits the wrench along ("))
      << all.reason.c_str();
  EXPECT_EQ(all.vertices.size(), 0);
}

TEST(ForcePolytope, RhombicDodecahedron) {
  Eigen::MatrixXd B(3, 4);
  B << 1, 1, -1, -1, 1, -1, 1, -1, 1, 1, 1, 1;
  const ZonotopeRobot robot(B);
  const WrenchSet set = force_polytope(robot.problem, robot.posture);
  expect_polytope(set);
  EXPECT_EQ(set.vertices.cols(), 14);
  EXPECT_EQ(set.normals.cols(), 12);
  EXPECT_NEAR(set.volume, 128, 1e-8);
}

TEST(ForcePolytope, HexagonalPrism) {
  // Three columns in the plane: the facets at the ends have six corners.
  Eigen::MatrixXd B(3, 4);
  B << 1, 0.5, -0.5, 0, 0, std::sqrt(0.75), std::sqrt(0.75), 0, 0, 0, 0, 1;
  const ZonotopeRobot robot(B);
  const WrenchSet set = force_polytope(robot.problem, robot.posture);
  expect_polytope(set);
  EXPECT_EQ(set.vertices.cols(), 12);
  EXPECT_EQ(set.normals.cols(), 8);
  EXPECT_NEAR(set.volume, 8 * sum_of_minors(B), 1e-8);
}

TEST(ForcePolytope, RandomZonotopes) {
  Random random(7);
  for (int m = 3; m <= 16; ++m) {
    const Eigen::MatrixXd B = random_matrix(random, 3, m);
    const ZonotopeRobot robot(B);
    const WrenchSet set = force_polytope(robot.problem, robot.posture);
    expect_polytope(set);
    // In general position: each pair of columns spans two parallel facets, each a parallelogram.
    EXPECT_EQ(set.normals.cols(), m * (m - 1));
    EXPECT_EQ(set.vertices.cols(), m * (m - 1) + 2);
    EXPECT_NEAR(set.volume, 8 * sum_of_minors(B), 1e-7 * set.volume);
  }
}

TEST(ForcePolytope, ElongatedZonotopes) {
  Random random(8);
  for (const double stretch : {1e3, 1e6}) {
    Eigen::MatrixXd B = random_matrix(random, 3, 7);
    B.row(0) *= stretch;
    B.row(2) /= 10;
    const ZonotopeRobot robot(B);
    const WrenchSet set = force_polytope(robot.problem, robot.posture);
    ASSERT_EQ(set.status, Status::kOptimal) << set.reason.c_str();
    EXPECT_EQ(set.normals.cols(), 42);
    EXPECT_EQ(set.vertices.cols(), 44);
    EXPECT_NEAR(set.volume, 8 * sum_of_minors(B), 1e-6 * set.volume);
  }
}

TEST(ForcePolytope, ManyPointsInEachFace) {
  // Columns of -1, 0 and 1: many are parallel or in one plane, so facets have many corners and the
  // programs many solutions, which may lie within a face.
  Random random(14);
  const int all = kSanitized ? 60 : 300;
  int solids = 0;
  for (int i = 0; i < all; ++i) {
    const int n = 3 + i % 4;
    const Eigen::MatrixXd B =
        (1.5 * random_matrix(random, n, n + static_cast<int>(random.uniform(0, 6))))
            .array()
            .round();
    const ZonotopeRobot robot(B);
    WrenchSetOptions options;
    options.wrench = Wrench::kAny;
    const WrenchSet set = force_polytope(robot.problem, robot.posture, options);
    expect_polytope(set);
    const double volume = 8 * sum_of_minors(B.topRows<3>());
    EXPECT_EQ(set.dimension == 3, volume > 0);
    if (set.dimension < 3) continue;
    EXPECT_NEAR(set.volume, volume, 1e-9 * volume);
    ++solids;
    expect_polytope(force_polytope(robot.problem, robot.posture));
  }
  EXPECT_GT(solids, all / 3);
}

TEST(ForcePolytope, AnyIsTheProjection) {
  // J = I: any wrench beside the force, of the torques of W_any, leaves the first rows of B u.
  Random random(9);
  for (const int n : {4, 5, 6}) {
    const Eigen::MatrixXd B = random_matrix(random, n, 9);
    const ZonotopeRobot robot(B);
    WrenchSetOptions options;
    options.wrench = Wrench::kAny;
    const WrenchSet set = force_polytope(robot.problem, robot.posture, options);
    expect_polytope(set);
    EXPECT_EQ(set.normals.cols(), 72);
    EXPECT_NEAR(set.volume, 8 * sum_of_minors(B.topRows<3>()), 1e-7 * set.volume);
    EXPECT_NEAR((B * set.efforts - set.wrenches.topRows(n)).norm(), 0, 1e-8);
    // The torques are used.
    EXPECT_GT(set.wrenches.bottomRows<3>().norm(), 0.1);
  }
}

TEST(ForcePolytope, DirectionsNeedNotBeOrthogonal) {
  // f are coordinates of h = E f, so the volume is divided by |det E|.
  Random random(10);
  const Eigen::MatrixXd B = random_matrix(random, 3, 6);
  const ZonotopeRobot robot(B);
  WrenchSetOptions options;
  const Eigen::Matrix3d E = random_matrix(random, 3, 3);
  options.E.topRows<3>() = E;
  const WrenchSet set = force_polytope(robot.problem, robot.posture, options);
  expect_polytope(set);
  EXPECT_NEAR(set.volume, 8 * sum_of_minors(B) / std::abs(E.determinant()), 1e-7 * set.volume);
  EXPECT_NEAR((set.wrenches - options.E * set.vertices).norm(), 0, 1e-9);
}

TEST(ForcePolytope, FlatSets) {
  Random random(11);
  for (const int q : {1, 2}) {
    // The efforts reach q dimensions; tau_d is among them.
    const Eigen::MatrixXd span = random_matrix(random, 3, q), shares = random_matrix(random, q, 6);
    ZonotopeRobot robot(span * shares);
    robot.posture.tau_d = span * Eigen::VectorXd::Constant(q, 0.1);
    const WrenchSet set = force_polytope(robot.problem, robot.posture);
    expect_polytope(set);
    EXPECT_EQ(set.dimension, q);
    EXPECT_NEAR((set.flat_normals.transpose() * span).norm(), 0, 1e-9);
    EXPECT_NEAR(set.flat_offsets.norm(), 0, 1e-9);
    double measure = 0;  // as sum_of_minors, in q dimensions
    for (int i = 0; i < 6; ++i) {
      if (q == 1) measure += 2 * span.norm() * std::abs(shares(0, i));
      for (int j = i + 1; q == 2 && j < 6; ++j) {
        const Eigen::Vector3d a = span * shares.col(i), b = span * shares.col(j);
        measure += 4 * a.cross(b).norm();
      }
    }
    EXPECT_NEAR(set.volume, measure, 1e-8);
    EXPECT_EQ(set.vertices.cols(), q == 1 ? 2 : 12);
  }
}

TEST(ForcePolytope, PointAndNothing) {
  ZonotopeRobot robot(Eigen::Matrix3d::Identity());
  const Eigen::Vector3d u(1, -2, 3), tau_d(0.5, 0.5, 0.5);
  robot.set_limits(Eigen::Matrix3d::Identity(), u, u);
  robot.posture.tau_d = tau_d;
  const WrenchSet point = force_polytope(robot.problem, robot.posture);
  expect_polytope(point);
  EXPECT_EQ(point.dimension, 0);
  EXPECT_NEAR((point.vertices - (u - tau_d)).norm(), 0, 1e-12);
  EXPECT_NEAR((point.flat_offsets - (u - tau_d)).norm(), 0, 1e-12);

  // A fourth direction that no wrench of E loads: the efforts must hold it alone.
  ZonotopeRobot weak(Eigen::Matrix4d::Identity());
  weak.posture.tau_d[3] = 1.01;
  const WrenchSet nothing = force_polytope(weak.problem, weak.posture);
  EXPECT_EQ(nothing.status, Status::kInfeasible);
  EXPECT_FALSE(nothing.reason.empty());
  EXPECT_EQ(nothing.vertices.size(), 0);
  // With a torque along it, as W_any allows, the environment holds it.
  WrenchSetOptions options;
  options.wrench = Wrench::kAny;
  expect_polytope(force_polytope(weak.problem, weak.posture, options));
}

TEST(ForcePolytope, L2FixesTheEfforts) {
  // {f : |B^+ f| <= 1 for each effort}: for three thrusters at 120 degrees, B^+ = 2/3 B', so each
  // |b_i'f| <= 1.5: a regular hexagon with the inner radius 1.5 and the area 2 sqrt(3) r^2.
  Eigen::MatrixXd B(2, 3);
  B << 1, -0.5, -0.5, 0, std::sqrt(0.75), -std::sqrt(0.75);
  ZonotopeRobot robot(B);
  WrenchSetOptions options;
  options.E = Matrix6Xd::Identity(6, 2);
  options.measure = "l2_polytope";
  const WrenchSet set = force_polytope(robot.problem, robot.posture, options);
  expect_polytope(set);
  EXPECT_EQ(set.vertices.cols(), 6);
  EXPECT_NEAR(set.volume, 2 * std::sqrt(3) * 2.25, 1e-9);
  EXPECT_NEAR((set.efforts - 2.0 / 3 * B.transpose() * set.vertices).norm(), 0, 1e-9);
  // Any efforts reach the hexagon of the corners 2 b_i.
  options.measure = "linf_polytope";
  EXPECT_NEAR(force_polytope(robot.problem, robot.posture, options).volume, 6 * std::sqrt(3), 1e-9);

  const ZonotopeRobot flat(Eigen::MatrixXd::Ones(3, 2));
  options.measure = "l2_polytope";
  EXPECT_EQ(rejection_of([&] { force_polytope(flat.problem, flat.posture, options); }),
            "measure l2_polytope: B of zonotope has rank 1, expected 3");
}

TEST(ForcePolytope, SolversAgree) {
  Random random(12);
  const Eigen::MatrixXd B = random_matrix(random, 5, 9);
  const ZonotopeRobot robot(B);
  for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
    WrenchSetOptions options;
    options.wrench = wrench;
    const WrenchSet first = force_polytope(robot.problem, robot.posture, options);
    for (const char* solver : {"condensed", "simplex"}) {
      options.solver = solver;
      const WrenchSet other = force_polytope(robot.problem, robot.posture, options);
      EXPECT_EQ(first.vertices.cols(), other.vertices.cols());
      EXPECT_NEAR(first.volume, other.volume, 1e-8 * first.volume);
    }
  }
}

TEST(ForcePolytope, EndsAtTheLargestNumberOfFacets) {
  Random random(13);
  const ZonotopeRobot robot(random_matrix(random, 3, 9));
  WrenchSetOptions options;
  options.most_facets = 71;  // of 72
  const WrenchSet set = force_polytope(robot.problem, robot.posture, options);
  EXPECT_EQ(set.status, Status::kBudgetExhausted);
  EXPECT_EQ(set.reason.str(), "the set is not complete after 71 facets");
  EXPECT_EQ(set.vertices.size(), 0);
}

TEST(ForcePolytope, BadInput) {
  ZonotopeRobot robot(Eigen::Matrix3d::Identity());
  const auto refused = [&](const WrenchSetOptions& bad, const std::string& message) {
    const std::string why =
        rejection_of([&] { force_polytope(robot.problem, robot.posture, bad); });
    EXPECT_EQ(why.substr(0, message.size()), message);
  };
  WrenchSetOptions options;
  options.E = Matrix6Xd::Identity(6, 4);
  refused(options, "E: got 4 columns, expected 1 to 3");
  options.E.resize(6, 0);
  refused(options, "E: got 0 columns, expected 1 to 3");
  options.E = Matrix6Xd::Ones(6, 2);
  refused(options, "E: got 2 columns of rank 1, expected independent columns");
  options.E(3, 1) = kNan;
  refused(options, "E: got a value that is not a finite number, expected finite numbers");
  options = {};
  options.measure = "ellipsoid";
  refused(options, "measure: got 'ellipsoid', expected linf_polytope or l2_polytope");
  options = {};
  options.solver = "facets";
  refused(options, "solver: got 'facets', expected one of condensed simplex");
  options = {};
  options.most_facets = 3;
  refused(options, "most_facets: got 3, expected 4 or more");

  for (double* number : {&robot.posture.J(0, 1), &robot.posture.tau_d[2]}) {
    const double old = *number;
    *number = kNan;
    EXPECT_EQ(force_polytope(robot.problem, robot.posture).status, Status::kNumericalError);
    *number = old;
  }
  robot.posture.conclude(Status::kInvalidPosture, "out of reach");
  EXPECT_EQ(force_polytope(robot.problem, robot.posture).status, Status::kInvalidPosture);
  EXPECT_EQ(force_polytope(robot.problem, robot.posture).reason.str(), "out of reach");
  robot.posture.J = Matrix6Xd::Identity(6, 4);
  refused({}, "posture: got J with 4 columns, expected 3");
}

}  // namespace
}  // namespace maxwrench
