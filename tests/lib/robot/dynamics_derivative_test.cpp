#include <gtest/gtest.h>

#include <functional>

#include "lib/math/dual.h"
#include "lib/robot/dynamics.h"
#include "tests/support/mechanics.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using Eigen::VectorXd;

/// Everything that tau_d depends on, and directions along it: a turn of the base in its own axes,
/// joints, velocity and acceleration.
template <class T>
struct MotionSample {
  Matrix3<T> R_base;
  VectorX<T> q, v, v_d;
};
struct Direction {
  Eigen::Vector3d turn;
  VectorXd q, v, v_d;
};

MotionSample<double> moved(const MotionSample<double>& m, const Direction& d, double step) {
  const Eigen::AngleAxisd turn(step * d.turn.norm(), d.turn.normalized());
  return {m.R_base * turn.toRotationMatrix(), m.q + step * d.q, m.v + step * d.v,
          m.v_d + step * d.v_d};
}

/// The motion with infinitesimal number k along the k-th direction.
MotionSample<Dual<4>> seeded(const MotionSample<double>& m,
                             const std::vector<Direction>& directions) {
  MotionSample<Dual<4>> result{m.R_base.cast<Dual<4>>(), m.q.cast<Dual<4>>(), m.v.cast<Dual<4>>(),
                               m.v_d.cast<Dual<4>>()};
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const Direction& d = directions[k];
    for (int row = 0; row < 3; ++row) {
      // R [turn]x: each row of R turned.
      const Eigen::Vector3d change = Eigen::Vector3d(m.R_base.row(row)).cross(d.turn);
      for (int c = 0; c < 3; ++c) result.R_base(row, c).d[k] = change[c];
    }
    for (Eigen::Index i = 0; i < m.q.size(); ++i) result.q[i].d[k] = d.q[i];
    for (Eigen::Index i = 0; i < m.v.size(); ++i) result.v[i].d[k] = d.v[i];
    for (Eigen::Index i = 0; i < m.v.size(); ++i) result.v_d[i].d[k] = d.v_d[i];
  }
  return result;
}

/// What is differentiated: a function of the dynamics and the motion with n values.
template <class T>
using Function = void (*)(Dynamics<T>&, const MotionSample<T>&, VectorX<T>&);

template <class T>
void inverse(Dynamics<T>& dynamics, const MotionSample<T>& m, VectorX<T>& result) {
  dynamics.inverse(m.v, m.v_d, result);
}
template <class T>
void forward(Dynamics<T>& dynamics, const MotionSample<T>& m, VectorX<T>& result) {
  dynamics.forward(m.v, m.v_d, result);  // v_d takes the place of tau
}
template <class T>
void mass_matrix(Dynamics<T>& dynamics, const MotionSample<T>&, VectorX<T>& result) {
  MatrixX<T> M;
  dynamics.mass_matrix(M);
  result = Eigen::Map<VectorX<T>>(M.data(), M.size());
}

VectorXd values(const Robot& robot, Function<double> f, const MotionSample<double>& m) {
  Dynamics<double> dynamics(robot);
  dynamics.set_configuration(m.R_base, m.q);
  VectorXd result(robot.velocities());
  f(dynamics, m, result);
  return result;
}

/// Compares the dual derivatives along each direction with central differences.
void expect_exact(const Robot& robot, Function<double> f, Function<Dual<4>> f_dual,
                  const MotionSample<double>& m, const std::vector<Direction>& directions,
                  double tolerance) {
  Dynamics<Dual<4>> dynamics(robot);
  const MotionSample<Dual<4>> dual = seeded(m, directions);
  dynamics.set_configuration(dual.R_base, dual.q);
  VectorX<Dual<4>> result(robot.velocities());
  f_dual(dynamics, dual, result);
  const double h = 1e-5;
  const VectorXd middle = values(robot, f, m);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const VectorXd differences = (values(robot, f, moved(m, directions[k], h)) -
                                  values(robot, f, moved(m, directions[k], -h))) /
                                 (2 * h);
    VectorXd exact(result.size()), value(result.size());
    for (Eigen::Index i = 0; i < result.size(); ++i) {
      value[i] = result[i].v;
      exact[i] = result[i].d[k];
    }
    EXPECT_LT((value - middle).norm(), 1e-12 * middle.norm());
    EXPECT_LT((exact - differences).norm(), tolerance * (1 + differences.norm())) << k;
  }
}

class DynamicsDerivatives : public testing::Test {
 protected:
  VectorXd numbers(int size) {
    return VectorXd::NullaryExpr(size, [&] { return random_.normal(); });
  }

  /// The turn, q, v and v_d in one direction each.
  std::vector<Direction> one_by_one(int joints, int n) {
    std::vector<Direction> directions(
        4, {Eigen::Vector3d::Zero(), VectorXd::Zero(joints), VectorXd::Zero(n), VectorXd::Zero(n)});
    directions[0].turn = random_vector(random_);
    directions[1].q = numbers(joints);
    directions[2].v = numbers(n);
    directions[3].v_d = numbers(n);
    return directions;
  }

  Random random_{11};
};

TEST_F(DynamicsDerivatives, AreExactInEveryArgument) {
  for (int sample = 0; sample < 20; ++sample) {
    const Robot robot = random_wet_robot(random_, 5);
    const int n = robot.velocities();
    const MotionSample<double> m{random_rotation(random_), numbers(5), numbers(n), numbers(n)};
    const std::vector<Direction> each = one_by_one(5, n);
    expect_exact(robot, inverse<double>, inverse<Dual<4>>, m, each, 1e-7);
    expect_exact(robot, forward<double>, forward<Dual<4>>, m, each, 1e-6);
    expect_exact(robot, mass_matrix<double>, mass_matrix<Dual<4>>, m, each, 1e-7);
  }
}

/// |v| v has the derivative 2 |v| there, which is zero: differences of step h see h instead.
TEST_F(DynamicsDerivatives, AreExactWhereTheDragChangesSign) {
  const Robot robot = random_wet_robot(random_, 5);
  const int n = robot.velocities();
  const MotionSample<double> rest{random_rotation(random_), numbers(5), VectorXd::Zero(n),
                                  numbers(n)};
  expect_exact(robot, inverse<double>, inverse<Dual<4>>, rest, one_by_one(5, n), 1e-4);
}

}  // namespace
}  // namespace maxwrench
