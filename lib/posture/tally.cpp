#include "maxwrench/posture.h"

namespace maxwrench {

void Tally::add(const IkCounts& counts) {
  unreachable_ += counts.unreachable;
  long most = most_.load();
  while (most < counts.most && !most_.compare_exchange_weak(most, counts.most)) {
  }
  found_ += counts.found;
  beyond_limit_ += counts.beyond_limit;
  singular_ += counts.singular;
  collision_ += counts.collision;
  incomplete_ += counts.incomplete;
}

IkCounts Tally::sum() const {
  return {unreachable_, most_, found_, beyond_limit_, singular_, collision_, incomplete_};
}

}  // namespace maxwrench
