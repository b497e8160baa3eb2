#include <cmath>

#include "lib/math/require.h"
#include "maxwrench/integrator.h"

namespace maxwrench {

void check(const IntegratorOptions& options) {
  const double relative = options.relative_tolerance, absolute = options.absolute_tolerance;
  require(relative >= 0 && std::isfinite(relative), "integrator relative_tolerance", relative,
          "a finite number >= 0");
  require(absolute > 0 && std::isfinite(absolute), "integrator absolute_tolerance", absolute,
          "a finite number > 0");
  require(options.max_steps >= 1, "integrator max_steps", static_cast<double>(options.max_steps),
          "at least 1");
  require(options.step > 0 && std::isfinite(options.step), "integrator step", options.step,
          "a finite number > 0");
}

void OdeSolution::start(double t_0, const Eigen::VectorXd& y_0) {
  conclude(Status::kNumericalError);
  t.assign(1, t_0);
  y.assign(1, y_0);
  root = -1;
}

}  // namespace maxwrench
