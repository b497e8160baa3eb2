#pragma once

#include <vector>

namespace maxwrench::simplex {

/// Sparse lines (rows or columns) one after the other; line k has the entries start[k] to
/// start[k + 1].
struct Lines {
  std::vector<int> start, index;
  std::vector<double> value;

  void clear() {
    start.assign(1, 0);
    index.clear();
    value.clear();
  }
  void end_line() { start.push_back(static_cast<int>(index.size())); }

  /// Sorts entries into `lines` lines. `for_each_entry` calls its argument with the line, the index
  /// and the value of each entry, the same ones whenever it is called. The order in a line is
  /// the reverse of the order of the calls.
  template <class ForEachEntry>
  void sort(int lines, const ForEachEntry& for_each_entry) {
    start.assign(lines + 1, 0);
    for_each_entry([&](int line, int, double) { ++start[line]; });
    int sum = 0;
    for (int& end : start) end = sum += end;
    index.resize(sum);
    value.resize(sum);
    for_each_entry([&](int line, int i, double v) {
      const int to = --start[line];
      index[to] = i;
      value[to] = v;
    });
  }
  /// The other direction of `other`, a matrix of as many rows as columns.
  void transpose(const Lines& other) {
    const int lines = static_cast<int>(other.start.size()) - 1;
    sort(lines, [&](const auto& visit) {
      for (int k = lines - 1; k >= 0; --k) {
        for (int e = other.start[k]; e < other.start[k + 1]; ++e) {
          visit(other.index[e], k, other.value[e]);
        }
      }
    });
  }
};

}  // namespace maxwrench::simplex
