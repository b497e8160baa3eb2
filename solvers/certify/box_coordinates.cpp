#include "solvers/certify/box_coordinates.h"

#include <cmath>
#include <memory>
#include <numbers>

#include "maxwrench/measure.h"
#include "maxwrench/problem.h"
#include "maxwrench/wrench_program.h"
#include "solvers/certify/bound/exact_posture.h"
#include "solvers/certify/bound/loop_posture.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// Evaluates all IK solutions, for the use of one thread.
class AllPostures {
 public:
  AllPostures(const Problem& problem, Wrench wrench, const MeasureMaker& make_measure)
      : coordinates_(problem),
        model_(problem),
        program_(make_wrench_program(problem, wrench)),
        measure_(make_measure()) {}

  void at(const Eigen::VectorXd& theta_r, std::vector<PosturePoint>& postures) {
    postures.clear();
    if (model_.evaluate(theta_r).status != Status::kValid) return;
    for (int i = 0; i < model_.ik_solutions(); ++i) {
      const Posture& posture = model_.select(i);
      set_posture(posture, program_);
      measure_->evaluate(posture, program_, true, capability_);
      if (capability_.status != Status::kOptimal || !satisfies_program(capability_)) continue;
      postures.push_back({coordinates_.within_a_turn(coordinates_.of(posture)), capability_.beta});
    }
  }

 private:
  BoxCoordinates coordinates_;
  PostureEvaluator model_;
  WrenchProgram program_;
  std::unique_ptr<Measure> measure_;
  Capability capability_;
};

}  // namespace

BoxCoordinates::BoxCoordinates(const Problem& problem)
    : problem_(problem), joints_(moved_joints(problem)) {
  const LoopCoordinates all(problem, ContactForces::kOfBase);
  lower_ = all.lower;
  upper_ = all.upper;
  joints_.resize(static_cast<std::size_t>(lower_.size()), -1);
  angles_.resize(joints_.size());
  for (int i = 0; i < all.chain.count(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    angles_[static_cast<std::size_t>(all.chain.index[at])] = all.chain.turns[at];
  }
}

std::string BoxCoordinates::name(int i) const {
  if (i < problem_.redundancy()) return problem_.theta_r_name(i);
  const int joint = joints_[static_cast<std::size_t>(i)];
  return joint < 0 ? "yaw" : problem_.robot.joints[static_cast<std::size_t>(joint)].name;
}

const char* BoxCoordinates::unit(int i) const {
  return angles_[static_cast<std::size_t>(i)] != 0 ? "rad" : "m";
}

std::vector<char> BoxCoordinates::turns() const {
  std::vector<char> turns;
  for (int i = 0; i < count(); ++i) {
    turns.push_back(angles_[static_cast<std::size_t>(i)] != 0 &&
                    std::abs(upper_[i] - lower_[i] - kTurn) < 1e-9);
  }
  return turns;
}

Eigen::VectorXd BoxCoordinates::of(const Posture& posture) const {
  Eigen::VectorXd x(count());
  for (int i = 0; i < count(); ++i) {
    const int joint = joints_[static_cast<std::size_t>(i)];
    if (joint >= 0) x[i] = posture.q[joint];
  }
  const Eigen::Index r = posture.theta_r.size();
  if (count() > r && joints_.back() < 0) {
    const Eigen::Matrix3d R = problem_.robot.mount.R.transpose() * posture.base.R;
    x[count() - 1] = std::atan2(R(1, 0), R(0, 0));
  }
  x.head(r) = posture.theta_r;
  return x;
}

Eigen::VectorXd BoxCoordinates::within_a_turn(Eigen::VectorXd x) const {
  for (int i = 0; i < count(); ++i) {
    if (angles_[static_cast<std::size_t>(i)] == 0) continue;
    while (x[i] > upper_[i] + kLimitTolerance && x[i] - kTurn >= lower_[i] - kLimitTolerance) {
      x[i] -= kTurn;
    }
    while (x[i] < lower_[i] - kLimitTolerance && x[i] + kTurn <= upper_[i] + kLimitTolerance) {
      x[i] += kTurn;
    }
  }
  return x;
}

std::function<PosturesAt()> make_all_postures(const Problem& problem, Wrench wrench,
                                              const MeasureMaker& make_measure) {
  return [&problem, wrench, make_measure]() -> PosturesAt {
    const auto all = std::make_shared<AllPostures>(problem, wrench, make_measure);
    return [all](const Eigen::VectorXd& theta_r, std::vector<PosturePoint>& postures) {
      all->at(theta_r, postures);
    };
  };
}

}  // namespace maxwrench
