#pragma once

#include <string>

#include "verify/trajectory/trajectory_certificate.h"
#include "verify/trajectory/trajectory_model.h"
#include "verify/wide_matrix.h"

namespace maxwrench {

/// The efforts of a certificate,
///
///     u(t) = y(t) + B^+ (tau_d(t) + J'c(t) w(t) - B y(t)).
///
/// They balance the wrench w c at every t, because B B^+ is the identity. Between two knots, y and
/// w are quadratic B-splines whose control points are their values at the edges, with linear ends:
/// with s = t - t_e and |s| <= H/2 about an edge e,
///
///     y(t) = (y_- + 6 y_e + y_+)/8 + (y_+ - y_-) s/(2 H) + (y_- - 2 y_e + y_+) s^2/(2 H^2),
///
/// and about the first and the last edge the chord. So the rate of y lies between the slopes of the
/// chords, and B y follows tau_d + J'c w up to O(H^2), also in its rate.
///
/// On a slice of time about m, |s| <= r, each quantity is
///
///     f(m + s) in f_0 + f_1 s + f_2 s^2,
///
/// f_0 and f_1 at m and f_2 over the slice. This encloses the efforts and their rates.
class EffortLaw {
 public:
  /// Keeps references. The sizes of the certificate must be those of the task.
  EffortLaw(const TrajectoryModel& model, const TrajectoryCertificate& proof);
  EffortLaw(const TrajectoryModel&, const TrajectoryCertificate&&) = delete;

  /// Whether efforts, their commands (with a lag of the thrusters) and rates are within their
  /// limits, and the base is on its free axes, nearer to one edge of an interval (0 to `parts`)
  /// than to its others. Cuts this time into slices as far as needed, and adds their number.
  MotionFault check(int interval, int edge, long& slices) const;

 private:
  /// A quadratic in s, whose last coefficient holds for all |s| <= r.
  using Quadratic = std::array<Narrow, 3>;

  MotionFault check_slice(int interval, int edge, double from, double to) const;
  bool exerts_nothing(std::size_t actuator) const;
  MotionFault check_limits(std::size_t actuator, const Quadratic& u, const Narrow& r) const;
  Quadratic spline(const double* at, Eigen::Index stride, int edge) const;
  std::vector<Quadratic> efforts(int interval, int edge, const Narrow& place,
                                 const MotionLoads<1>& at, const MotionLoads<2>& over) const;

  const TrajectoryModel& model_;
  const TrajectoryCertificate& proof_;
  std::vector<std::vector<Narrow>> B_, B_pinv_;
  Narrow length_;  ///< H, between edges [s]
};

/// B^+, enclosed. Throws std::invalid_argument, in one line, if B is nearly rank-deficient.
std::vector<std::vector<Narrow>> narrow_pseudoinverse(const Problem& problem);

}  // namespace maxwrench
