#!/usr/bin/env bash
# Without its libraries nothing is built that would need them. Here COMPILER builds the library alone, for programs with AVX, each floor as
# one unit: that shows names that clash in other batches, too, and takes the least time. A program that OTHER compiles links it.
set -euo pipefail
source=$1 compiler=$2 other=$3
. "$source/tests/install/checks.sh"
cd "$work"

quietly cmake -S "$source/tests/install/parent" -B bare -D MAXWRENCH="$source" -D CMAKE_UNITY_BUILD=ON \
  -D CMAKE_UNITY_BUILD_BATCH_SIZE=0 -D CMAKE_CXX_FLAGS=-O0 \
  -D CMAKE_CXX_COMPILER="$compiler" -D MAXWRENCH_WITH_IPOPT=OFF -D MAXWRENCH_WITH_CLP=OFF \
  -D MAXWRENCH_WITH_GLPK=OFF -D MAXWRENCH_WITH_NLOPT=OFF -D MAXWRENCH_WITH_PAGMO=OFF -D MAXWRENCH_WITH_SUNDIALS=OFF \
  -D MAXWRENCH_AVX="$(avx_of "$compiler")" -D PARENT_FLAGS=-march=native -D MAXWRENCH_INSTALL=ON
find bare -name 'unity_*.cxx' -exec cat {} + > bare.sources
holds bare.sources solvers/lp/simplex.cpp solvers/search/grid.cpp
for file in $(grep -lE '#include <(Ip|Clp|glpk|nlopt|pagmo|arkode|cvode|ida|nvector|sundials)' -r "$source/solvers" --include='*.cpp'); do
  file=${file#"$source/"}
  [ "$file" = solvers/version.cpp ] || ! grep -q "$file" bare.sources || fail "$file needs a library that is left out"
done
quietly cmake --build bare --parallel "$(nproc)" --target parent
bare/parent > bare.out 2> "$log" || fail "a build without libraries fails"
holds bare.out "facets grid best_found" "simplex annealing best_found" "no clp" "no multistart"
! grep -q "^clp\|infeasible\|none_found" bare.out || fail "a build without libraries has no answers"

# Installed, it links with a program built with -march=native whose other files know nothing of us.
quietly cmake --install bare --prefix "$work/bare_prefix"
quietly cmake -S "$source/tests/install/native" -B native -D CMAKE_CXX_COMPILER="$other" -D CMAKE_PREFIX_PATH="$work/bare_prefix" -D CMAKE_CXX_FLAGS=-O0
quietly cmake --build native
native/native > native.out 2> "$log" || fail "a program with -march=native fails"
same "native" "$(sed 's/native [0-9.]* //' native.out)" "1 360000"
