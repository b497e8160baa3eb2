#include "maxwrench/integrator.h"

namespace maxwrench {

void Trajectory::start(double t_0, const Eigen::VectorXd& y_0) {
  conclude(Status::kNumericalError);
  t.assign(1, t_0);
  y.assign(1, y_0);
  root = -1;
}

}  // namespace maxwrench
