#include "verify/trajectory/jet.h"

namespace maxwrench {

/// With x = m + d and |d| <= r: cos x = cos m cos d - sin m sin d, where cos d is in [1 - r^2/2, 1]
/// and sin d in [-r, r].
CosSin<double> enclose(const Narrow& x) {
  const double m = x.low + (x.high - x.low) / 2;
  const CosSin<long double> at = enclose_wide(m);
  const Narrow c = narrow(at.c), s = narrow(at.s);
  if (x.low == x.high) return {c, s};
  const double r = std::max((Narrow(x.high) - Narrow(m)).high, (Narrow(m) - Narrow(x.low)).high);
  const Narrow cos_d((Narrow(1.0) - 0.5 * (Narrow(r) * Narrow(r))).low, 1.0), sin_d(-r, r);
  CosSin<double> result{c * cos_d - s * sin_d, s * cos_d + c * sin_d};
  for (Narrow* y : {&result.c, &result.s}) {
    *y = {std::max(y->low, -1.0), std::min(y->high, 1.0)};
  }
  return result;
}

}  // namespace maxwrench
