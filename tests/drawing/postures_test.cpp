#include "drawing/postures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "drawing/axes.h"
#include "drawing/bars.h"
#include "drawing/svg.h"
#include "lib/math/polygon.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_solver.h"

namespace maxwrench {
namespace {

using Points = std::vector<Eigen::Vector2d>;

/// The planar vehicle by hand: hull 0.6 m × 0.4 m, a thruster on each corner, two links of 0.1 m.
Problem planar() {
  Problem problem;
  problem.name = "planar";
  Robot& robot = problem.robot;
  robot.base_axes = {0, 1, 5};
  robot.links.resize(3);
  for (int i = 0; i < 2; ++i) {
    Joint joint;
    joint.parent = i;
    joint.placement.p = i == 0 ? Eigen::Vector3d(0.3, 0.1, 0) : Eigen::Vector3d(0.1, 0, 0);
    joint.effort_max = 1;
    robot.joints.push_back(joint);
  }
  for (const int x : {1, -1}) {
    for (const int y : {1, -1}) {
      Thruster thruster;
      thruster.position = {0.3 * x, 0.2 * y, 0};
      thruster.direction = Eigen::Vector3d(4, -x * y, 0).normalized();
      thruster.force_min = -0.8;  // asymmetric, so that no symmetry hides a mistake
      thruster.force_max = 1;
      robot.thrusters.push_back(thruster);
    }
  }
  EndEffector tool;
  tool.link = 2;
  tool.placement.p = {0.1, 0, 0};
  robot.end_effectors.push_back(tool);
  complete_actuation(robot);
  problem.pose.R = Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ()).matrix();
  problem.c << 1, 0, 0, 0, 0, 0;
  problem.W_any = Matrix6Xd::Zero(6, 3);
  problem.W_any(0, 0) = problem.W_any(1, 1) = problem.W_any(5, 2) = 1;
  problem.redundant = {0, 1};
  problem.theta_r_min = Eigen::Vector2d(-1, -1);
  problem.theta_r_max = Eigen::Vector2d(1, 1);
  problem.theta_r_default = Eigen::Vector2d(0, 0);
  return problem;
}

/// The vertices of {w : low <= A w <= high}, each where as many rows as w has columns meet, by
/// trying all of them; projected on the first two coordinates.
Points brute_force(const Eigen::MatrixXd& A, const Eigen::VectorXd& low,
                   const Eigen::VectorXd& high) {
  const int k = static_cast<int>(A.cols());
  const int rows = static_cast<int>(A.rows());
  Points vertices;
  std::vector<int> pick(k, 0);
  const auto visit = [&](auto&& self, int depth, int first) -> void {
    if (depth < k) {
      for (pick[depth] = first; pick[depth] < 2 * rows; ++pick[depth])
        self(self, depth + 1, pick[depth] + 1);
      return;
    }
    Eigen::MatrixXd M(k, k);
    Eigen::VectorXd b(k);
    for (int i = 0; i < k; ++i) {
      M.row(i) = A.row(pick[i] / 2);
      b[i] = pick[i] % 2 == 0 ? low[pick[i] / 2] : high[pick[i] / 2];
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(M);
    if (!lu.isInvertible()) return;
    const Eigen::VectorXd w = lu.solve(b);
    const Eigen::ArrayXd value = (A * w).array();
    if ((value < low.array() - 1e-9).any() || (value > high.array() + 1e-9).any()) return;
    vertices.emplace_back(w[0], w[1]);
  };
  visit(visit, 0, 0);
  return convex_hull(vertices);
}

double support(const Points& points, const Eigen::Vector2d& d) {
  double value = -kInfinity;
  for (const Eigen::Vector2d& p : points) value = std::max(value, d.dot(p));
  return value;
}

void expect_same_support(const Points& actual, const Points& expected) {
  ASSERT_GE(expected.size(), 3u);
  for (int i = 0; i < 64; ++i) {
    const double angle = 2 * M_PI * i / 64;
    const Eigen::Vector2d d(std::cos(angle), std::sin(angle));
    EXPECT_NEAR(support(actual, d), support(expected, d), 1e-7);
  }
}

class ForceSetTest : public testing::Test {
 protected:
  ForceSetTest() : model_(problem_) {
    posture_ = model_.evaluate(Eigen::Vector2d(0.4, -0.8));
    posture_.tau_d = Eigen::VectorXd::LinSpaced(5, 0.1, -0.2);  // off the centre
    // Forces in the plane, and the torque across it.
    JtW_ = posture_.J.transpose() * problem_.W_any;
  }
  std::unique_ptr<WrenchSolver> solver() { return find_wrench_solver("simplex").make(); }
  ForceSet set(Measure& measure, Wrench wrench, bool curved = false) {
    return force_set(problem_, posture_, measure, wrench, View::kTop, curved, "a_1");
  }

  Problem problem_ = planar();
  PostureEvaluator model_;
  Posture posture_;
  Eigen::MatrixXd JtW_;
};

TEST_F(ForceSetTest, LinfPolytopeIsThatOfTheFacets) {
  const auto measure = make_linf_polytope(problem_.robot, solver());
  const Zonotope& zonotope = problem_.robot.actuation;
  const Eigen::VectorXd offset = zonotope.N.transpose() * posture_.tau_d;
  for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
    const int columns = wrench == Wrench::kPure ? 2 : 3;
    const ForceSet found = set(*measure, wrench);
    const Points expected = brute_force(zonotope.N.transpose() * JtW_.leftCols(columns),
                                        zonotope.b_min - offset, zonotope.b_max - offset);
    expect_same_support(found.outline, expected);
    EXPECT_NEAR(problem_.c.head<2>().dot(found.h), found.beta, 1e-9);
    if (wrench == Wrench::kAny) {
      EXPECT_NEAR(found.beta, support(expected, {1, 0}), 1e-7);
    }
  }
}

TEST_F(ForceSetTest, L2PolytopeIsThatOfTheEfforts) {
  const auto measure = make_l2_polytope(problem_.robot, solver());
  const Zonotope& zonotope = problem_.robot.actuation;
  const Eigen::VectorXd offset = zonotope.B_pinv * posture_.tau_d;
  expect_same_support(set(*measure, Wrench::kPure).outline,
                      brute_force(zonotope.B_pinv * JtW_.leftCols(2), zonotope.u_min - offset,
                                  zonotope.u_max - offset));
}

TEST_F(ForceSetTest, EllipsoidLiesOnItsQuadric) {
  const auto measure = make_ellipsoid(problem_.robot);
  const Zonotope& zonotope = problem_.robot.actuation;
  const Eigen::VectorXd limit = zonotope.u_min.cwiseAbs().cwiseMin(zonotope.u_max.cwiseAbs());
  const ForceSet found = set(*measure, Wrench::kPure, true);
  EXPECT_GT(found.outline.size(), 50u);
  for (const Eigen::Vector2d& h : found.outline) {
    const Eigen::VectorXd u = zonotope.B_pinv * (posture_.tau_d + JtW_.leftCols(2) * h);
    EXPECT_NEAR(u.cwiseQuotient(limit).norm(), 1, 1e-9);
  }
}

TEST_F(ForceSetTest, RejectsTorques) {
  problem_.c << 0, 0, 0, 0, 0, 1;
  const auto measure = make_ellipsoid(problem_.robot);
  EXPECT_THROW(set(*measure, Wrench::kPure), std::invalid_argument);
}

/// Every tag that opens also closes, in order.
void expect_well_formed(const std::string& svg) {
  std::vector<std::string> open;
  for (std::size_t i = svg.find('<'); i != std::string::npos; i = svg.find('<', i + 1)) {
    const std::size_t end = svg.find('>', i);
    ASSERT_NE(end, std::string::npos);
    const std::string tag = svg.substr(i + 1, end - i - 1);
    const std::string name = tag.substr(0, tag.find(' '));
    if (tag[0] == '/') {
      ASSERT_FALSE(open.empty());
      EXPECT_EQ(open.back(), tag.substr(1));
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
  }
  EXPECT_TRUE(open.empty());
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST_F(ForceSetTest, DrawsPanels) {
  const auto measure = make_linf_polytope(problem_.robot, solver());
  DrawnPosture panel{.title = "a & b < c",
                     .problem = &problem_,
                     .posture = posture_,
                     .sets = {set(*measure, Wrench::kPure), set(*measure, Wrench::kAny)},
                     .hull = {},
                     .u = {}};
  panel.sets[1].name = "second";
  const std::string one = draw_postures({&panel, 1});
  expect_well_formed(one);
  EXPECT_NE(one.find("a &amp; b &lt; c"), std::string::npos);
  EXPECT_NE(one.find("second"), std::string::npos);
  panel.sets[0].beta = std::nan("");  // and a set without a value
  panel.sets[0].outline.clear();
  panel.u = Eigen::VectorXd::Ones(6);
  panel.hull = {{0.3, 0.2, 0.1}, {-0.3, 0.2, 0}, {0, -0.2, -0.1}};
  const std::vector<DrawnPosture> three(3, panel);
  expect_well_formed(draw_postures(three));
  expect_well_formed(draw_postures(three, View::kSide));
  panel.sets.clear();
  expect_well_formed(draw_postures({&panel, 1}));
}

TEST_F(ForceSetTest, DrawsSolidsFromTwoSides) {
  problem_.robot.convex_bodies = {{0, {{0.3, 0.2, 0.1}, {-0.3, 0.2, 0}, {0, -0.2, -0.1}}, 0},
                                  {1, {{0, 0, 0}, {0.1, 0, 0}}, 0.01},
                                  {2, {{0, 0, 0}}, 0.02}};
  const DrawnPosture panel{
      .title = "a", .problem = &problem_, .posture = posture_, .sets = {}, .hull = {}, .u = {}};
  const std::vector<DrawnPosture> two(2, panel);
  for (const int axis : {0, 1, 2, 3, 4, 5}) {  // c as a force and a torque in each direction
    for (const double sign : {1.0, -1.0}) {
      problem_.c = sign * Vector6d::Unit(axis);
      const std::string svg = draw_both_views(two);
      expect_well_formed(svg);
      EXPECT_NE(svg.find("a, from the right"), std::string::npos);
      EXPECT_NE(svg.find("a, from above"), std::string::npos);
      EXPECT_NE(svg.find(">c<"), std::string::npos);
    }
  }
}

/// The second contact and its places: of each surface, also seen from its edge.
TEST_F(ForceSetTest, DrawsTheSecondContact) {
  const auto drawn = [&](Surface surface) {
    Contact contact;
    contact.surface = surface;
    contact.radius = 0.2;
    contact.end_effector = 0;
    problem_.contact = contact;
    problem_.theta_r_min = problem_.theta_r_default = Eigen::VectorXd::Constant(4, -0.1);
    problem_.theta_r_max = Eigen::VectorXd::Constant(4, 0.3);
    const DrawnPosture panel{
        .title = "a", .problem = &problem_, .posture = posture_, .sets = {}, .hull = {}, .u = {}};
    return draw_both_views({&panel, 1});
  };
  const auto count = [](const std::string& text, const std::string& word) {
    int found = 0;
    for (std::size_t i = text.find(word); i != std::string::npos; i = text.find(word, i + 1)) {
      ++found;
    }
    return found;
  };
  for (const Surface surface :
       {Surface::kPoint, Surface::kLine, Surface::kPlane, Surface::kCircle}) {
    const std::string svg = drawn(surface);
    expect_well_formed(svg);
    EXPECT_EQ(count(svg, ">second contact, "), 1);
    // In both views, and in the legend.
    EXPECT_EQ(count(svg, "stroke-dasharray=\"4 3\""), surface == Surface::kPoint ? 0 : 3);
  }
  problem_.contact.reset();
}

TEST(BarsTest, DrawsGroups) {
  const std::string svg = draw_bars(
      "two", {{"N", {{"f_x", -3, {-2, 2}}, {"f_y", 0, {}}}}, {"N m", {{"n_x", 40, {}}}}}, "tank");
  expect_well_formed(svg);
  EXPECT_NE(svg.find("\u22123.0"), std::string::npos);
  EXPECT_NE(svg.find("40.0"), std::string::npos);
}

TEST(SvgTest, RoundSteps) {
  EXPECT_DOUBLE_EQ(round_step(1), 1);
  EXPECT_DOUBLE_EQ(round_step(0.2), 0.2);
  EXPECT_DOUBLE_EQ(round_step(0.19), 0.1);
  EXPECT_DOUBLE_EQ(round_step(73), 50);
}

TEST(SvgTest, RejectsPointsThatAreNoPoints) {
  Svg svg(10, 10);
  for (const double x : {std::nan(""), kInfinity, 1e9}) {
    EXPECT_THROW(svg.line({0, 0}, {x, 0}, {}), std::invalid_argument);
    EXPECT_THROW(svg.polyline({{0, 0}, {0, x}}, {}), std::invalid_argument);
    EXPECT_THROW(svg.circle({x, 0}, 1, {}), std::invalid_argument);
    EXPECT_THROW(svg.text({x, 0}, "a", {}), std::invalid_argument);
  }
}

TEST(SvgTest, LowersTheCharacterAfterAnUnderscore) {
  Svg svg(10, 10);
  svg.text({0, 0}, "L_\u221e set", {.size = 10});
  EXPECT_NE(svg.str().find(">L<tspan dy=\"2.20\" font-size=\"8.0\">\u221e</tspan>"
                           "<tspan dx=\"3.00\" dy=\"-2.20\">set</tspan></text>"),
            std::string::npos);
  expect_well_formed(svg.str());
}

TEST(Axes, NumbersKeepTheirDigits) {
  EXPECT_EQ(with_digits(9, 4), "9.000");
  EXPECT_EQ(with_digits(35.4083, 4), "35.41");
  EXPECT_EQ(with_digits(-40, 3), "\u221240.0");
  EXPECT_EQ(with_digits(0.9999, 3), "1.00");
  EXPECT_EQ(with_digits(0.04567, 3), "0.0457");
  EXPECT_EQ(with_digits(12345, 3), "12345");
  EXPECT_EQ(with_digits(1.5e8, 3), "1.5e+08");
  EXPECT_EQ(with_digits(-1e-9, 3), "0");
}

}  // namespace
}  // namespace maxwrench
