#include "benchmarks/tables/draw.h"

#include <algorithm>
#include <numeric>

#include "lib/math/random.h"

namespace maxwrench {

std::vector<std::size_t> draw_rows(std::size_t all, std::size_t sample, std::uint64_t seed) {
  std::vector<std::size_t> rows(all);
  std::iota(rows.begin(), rows.end(), 0);
  if (sample == 0 || sample >= all) return rows;
  Random random(seed);
  for (std::size_t i = 0; i < sample; ++i) {
    const double left = static_cast<double>(all - i) * random.uniform(0, 1);
    std::swap(rows[i], rows[std::min(all - 1, i + static_cast<std::size_t>(left))]);
  }
  rows.resize(sample);
  return rows;
}

}  // namespace maxwrench
