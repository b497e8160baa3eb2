#include "tests/support/free_poses.h"

namespace maxwrench {

Problem with_free_pose(Problem problem, const FreePose& free) {
  const auto joints = static_cast<Eigen::Index>(problem.redundant.size());
  const Eigen::Index count = free.count();
  const auto insert = [&](double value, Eigen::VectorXd& all) {
    Eigen::VectorXd longer(all.size() + count);
    longer << all.head(joints), Eigen::VectorXd::Constant(count, value),
        all.tail(all.size() - joints);
    all = longer;
  };
  insert(-0.3, problem.theta_r_min);
  insert(0.3, problem.theta_r_max);
  insert(0, problem.theta_r_default);
  problem.free = free;
  problem.start_system.reset();
  return problem;
}

}  // namespace maxwrench
