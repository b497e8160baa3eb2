#include "solvers/search/trace.h"

#include <algorithm>

namespace maxwrench {

void Trace::add(double value) { improve({++evaluations_, value}); }

void Trace::append(const Trace& later) { append(std::span(&later, 1)); }

void Trace::append(std::span<const Trace> parts) {
  std::vector<Improvement> merged;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (const Improvement& own : parts[i].improvements_) {
      long before = evaluations_;
      for (std::size_t j = 0; j < parts.size(); ++j)
        before += std::min(parts[j].evaluations_, j > i ? own.evaluations - 1 : own.evaluations);
      merged.push_back({before, own.value});
    }
  }
  std::sort(merged.begin(), merged.end(), [](const Improvement& a, const Improvement& b) {
    return a.evaluations < b.evaluations;
  });
  for (const Improvement& improvement : merged) improve(improvement);
  for (const Trace& part : parts) evaluations_ += part.evaluations_;
}

void Trace::improve(const Improvement& improvement) {
  const double best = improvements_.empty() ? -kInfinity : improvements_.back().value;
  if (improvement.value > best) improvements_.push_back(improvement);
}

}  // namespace maxwrench
