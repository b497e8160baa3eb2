#pragma once

#include <string>

#include "verify/trajectory/trajectory_certificate.h"
#include "verify/trajectory/trajectory_model.h"
#include "verify/wide_matrix.h"

namespace maxwrench {

/// Why a motion does not satisfy its limits; `reason` is empty if it does.
struct MotionFault {
  std::string reason;
  double t = -1;  ///< the instant [s]
};

/// The efforts of a certificate between its edges,
///
///     u(t) = y(t) + B^+ (tau_d(t) + J'c(t) w(t) - B y(t)),
///
/// with y and w linear between the edges. They balance the wrench w c at every t, because B B^+ is
/// the identity. On a slice of time about m, |s| <= r, each quantity is
///
///     f(m + s) in f_0 + f_1 s + f_2 s^2,
///
/// f_0 and f_1 at m and f_2 over the slice. This encloses the efforts and their rates.
class EffortLaw {
 public:
  /// Keeps references. The sizes of the certificate must be those of the task.
  EffortLaw(const TrajectoryModel& model, const TrajectoryCertificate& proof);
  EffortLaw(const TrajectoryModel&, const TrajectoryCertificate&&) = delete;

  /// Whether efforts and rates are within their limits, and the base is on its free axes, from one
  /// edge to the next. Cuts this time into slices as far as needed, and adds their number.
  MotionFault check(int interval, int part, long& slices) const;

 private:
  /// A quadratic in s, whose last coefficient holds for all |s| <= r.
  using Quadratic = std::array<Narrow, 3>;

  MotionFault check_slice(int interval, int part, double from, double to) const;
  MotionFault check_limits(std::size_t actuator, const Quadratic& u, const Narrow& r) const;
  std::vector<Quadratic> efforts(int interval, int part, double from, double to,
                                 const std::vector<Jet<1>>& tau_d, const std::vector<Jet<1>>& a,
                                 const std::vector<Jet<2>>& tau_d_over,
                                 const std::vector<Jet<2>>& a_over) const;

  const TrajectoryModel& model_;
  const TrajectoryCertificate& proof_;
  std::vector<std::vector<Narrow>> B_, B_pinv_;
  Narrow length_;  ///< between edges [s]
};

/// B^+, enclosed. Throws std::invalid_argument, in one line, if B is nearly rank-deficient.
std::vector<std::vector<Narrow>> narrow_pseudoinverse(const Problem& problem);

}  // namespace maxwrench
