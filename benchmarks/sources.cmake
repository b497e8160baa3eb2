set(maxwrench_benchmarks_sources
  race/comparison.cpp race/performance_profile.cpp race/race_file.cpp race/race_statistics.cpp race/race_summary.cpp
  race/significance.cpp
  report/benchmark_sets.cpp report/differences.cpp report/row_statistics.cpp
  suite/cost.cpp suite/journal.cpp suite/machine.cpp suite/map_check.cpp suite/map_rows.cpp suite/map_store.cpp suite/product.cpp suite/results.cpp suite/row_check.cpp suite/row_claim.cpp
  suite/suite_file.cpp
  tables/case_file.cpp tables/csv.cpp tables/dictionary.cpp tables/draw.cpp tables/table.cpp tables/write_file.cpp
  timing/lp_forms.cpp timing/slow_trajectory.cpp)
