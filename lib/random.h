#pragma once

#include <cstdint>

namespace maxwrench {

/// One stream of random numbers per (seed, stream): SplitMix64 (Steele, Lea, Flood 2014). The
/// mapping to doubles is ours, so the same numbers come out on every machine and at any thread
/// count.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);
  std::uint64_t next();
  /// Uniform in [0, 1), a multiple of 2^-53.
  double uniform();
  double uniform(double lower, double upper) { return lower + (upper - lower) * uniform(); }
  /// Standard normal, by the Box-Muller transform.
  double normal();

 private:
  std::uint64_t state_;
};

}  // namespace maxwrench
