#include <gtest/gtest.h>

#include <functional>
#include <type_traits>

#include "lib/posture/pull_back.h"
#include "lib/robot/free_motion.h"
#include "lib/tank/controller.h"
#include "lib/tank/ode.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

/// What keeps a robot takes none that dies at the end of the line.
template <class Keeper, class... Rest>
constexpr bool kKeepsOnlyWhatLives = std::is_constructible_v<Keeper, const Robot&, Rest...> &&
                                     !std::is_constructible_v<Keeper, Robot, Rest...> &&
                                     !std::is_constructible_v<Keeper, const Robot, Rest...>;

using Effort = std::function<void(double, Eigen::VectorXd&)>;

static_assert(kKeepsOnlyWhatLives<Kinematics<double>>);
static_assert(kKeepsOnlyWhatLives<Dynamics>);
static_assert(kKeepsOnlyWhatLives<PullBack, int>);
static_assert(kKeepsOnlyWhatLives<PullBack, int, int>);
static_assert(kKeepsOnlyWhatLives<FreeMotion, const Motion&, Effort>);
static_assert(std::is_constructible_v<TankOde, const Problem&, Posture, const TankOptions&> &&
              !std::is_constructible_v<TankOde, Problem, Posture, const TankOptions&>);
static_assert(
    std::is_constructible_v<PostureController, const Problem&, Posture, Wrench,
                            const TankOptions&> &&
    !std::is_constructible_v<PostureController, Problem, Posture, Wrench, const TankOptions&>);

}  // namespace
}  // namespace maxwrench
