#pragma once

#include <cstdint>

namespace maxwrench {

/// The uses of random numbers. Each use of each seed has streams of its own. To derive a stream
/// from a seed, name a use.
enum class RandomUse : std::uint64_t { kRefine, kSample, kLocalSearch, kKick, kRestart, kModel };

/// One stream of random numbers per (seed, stream), by SplitMix64 (Steele, Lea, Flood 2014). The
/// class maps them to doubles itself, so the numbers are the same on every machine and at any
/// thread count.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);
  /// Stream `index` (below 2^56) of one use of a seed. For kRefine it is the stream `index` of the
  /// constructor above.
  Random(std::uint64_t seed, RandomUse use, std::uint64_t index)
      : Random(seed, (static_cast<std::uint64_t>(use) << 56U) + index) {}
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
