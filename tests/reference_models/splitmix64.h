#pragma once

#include <cstdint>

namespace maxwrench::reference {

/// SplitMix64 as its authors publish it (Steele, Lea, Flood 2014; Vigna's C version).
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : x_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (x_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t x_;
};

}  // namespace maxwrench::reference
