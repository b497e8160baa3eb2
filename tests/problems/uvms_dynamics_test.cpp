#include <gtest/gtest.h>

#include "lib/dynamics.h"
#include "problems/loader.h"
#include "problems/state.h"

namespace maxwrench {
namespace {

using Eigen::VectorXd;

/// Each entry within 1e-12 of the largest.
void expect_near(const VectorXd& ours, const std::vector<double>& known) {
  const Eigen::Map<const VectorXd> expected(known.data(), static_cast<Eigen::Index>(known.size()));
  ASSERT_EQ(ours.size(), expected.size());
  EXPECT_LT((ours - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff());
}

/// From an independent model of the same data: Lagrange's equations in (position, rpy, q), each
/// body's energies written from the table, derivatives by complex steps, turned to our velocities.
TEST(UvmsDynamics, ExampleStateIsThatOfAnIndependentModel) {
  const Robot robot = load_problem("uvms/valve").robot;
  const State state = load_state(MAXWRENCH_SOURCE_DIR "/problems/uvms/state_example.toml", robot);
  Dynamics<double> dynamics(robot);
  dynamics.set_configuration(state.base.R, state.q);
  Eigen::MatrixXd M;
  VectorXd tau_d, C_v, D_v;
  dynamics.mass_matrix(M);
  dynamics.inverse(state.velocity, state.acceleration, tau_d);
  dynamics.coriolis(state.velocity, C_v);
  dynamics.damping(state.velocity, D_v);
  expect_near(M.diagonal(), {2.598329001036792e+01, 3.044999925245346e+01, 3.432171073717862e+01,
                             4.230398276610476e-01, 5.954839981214977e-01, 7.917572686782568e-01,
                             3.925974334634542e-02, 4.436825354473389e-02, 1.014245750000000e-02,
                             7.200000000000000e-05});
  expect_near(C_v, {-2.086283764952956e-01, 1.553990297812577e+00, -2.731974017463705e-01,
                    1.133281893605852e-02, 1.813216530647514e-01, 2.955891741628559e-02,
                    -1.206320077583248e-02, 4.244124799642800e-03, -4.257794455754984e-03,
                    -5.400000570721970e-06});
  expect_near(D_v, {3.692111300188806e+00, 3.506472149714934e-02, -2.371023769074306e+00,
                    2.469211411819723e-03, 3.488536915738719e-02, 2.976400074824618e-01,
                    -5.674787118540563e-03, 8.774514566181656e-03, -9.045022440478538e-04, 0});
  expect_near(tau_d, {3.544269647714493e+00, 4.577306223157505e+00, -3.255307034036124e+00,
                      2.924667719414988e-02, 5.280612067236581e-02, 3.048887985409633e-01,
                      -2.978077615548988e-02, -7.055949465441820e-01, 2.852500578930454e-01,
                      -5.405734123039186e-06});
}

}  // namespace
}  // namespace maxwrench
