#!/usr/bin/env bash
# What stands behind the front door: installs BUILD, moves the tree, and uses it as others would, with nothing of the sources at hand but
# the examples. Quiet unless something fails.
set -euo pipefail
source=$1 build=$2 compiler=$3
. "$source/tests/install/checks.sh"

quietly cmake --install "$build" --prefix "$work/first"
mv "$work/first" "$work/moved"
prefix=$work/moved
! grep -rIl "$work/first\|$source" "$prefix" > "$log" || fail "files name the place where they were made"
[ -z "$(find "$prefix" -name '*.cpp')" ] || fail "sources are installed"
# files_of FOLDER: the names and contents of all that is not a source.
files_of() { (cd "$1" && find . -type f ! -name '*.cpp' ! -name '*.h' ! -name '*.cmake' -exec sha1sum {} + | sort -k 2); }
diff <(files_of "$source/problems") <(files_of "$prefix/share/maxwrench/problems") > "$log" || fail "other problems than those of the sources"
export PKG_CONFIG_PATH=$prefix/lib/pkgconfig
unset MAXWRENCH_PROBLEMS

# The moved command, from a folder of its own.
cd "$work"
"$prefix/bin/maxwrench" list > list
holds list "$prefix/share/maxwrench/problems" planar/force uvms/valve grid
"$prefix/bin/maxwrench" --version > version
holds version "maxwrench 0." build libraries Eigen
"$prefix/bin/maxwrench" eval planar/force --json > eval
same "the version of a result" "$(sed 's/.*"version":"\([^"]*\)".*/\1/' eval)" "$(sed -n 's/^maxwrench //p' version)"
! MAXWRENCH_PROBLEMS=/nowhere "$prefix/bin/maxwrench" list > /dev/null 2> rejection || fail "a wrong MAXWRENCH_PROBLEMS is taken"
same "rejection" "$(cat rejection)" "maxwrench: MAXWRENCH_PROBLEMS: got '/nowhere', expected a folder with problems"

# The manual and the completion know the command.
page=$prefix/share/man/man1/maxwrench.1
holds "$page" .TH "maxwrench solve" '\-\-budget'
if command -v man > /dev/null; then
  MANWIDTH=120 man --warnings -l "$page" > page 2> "$log" || fail "no manual page"
  [ ! -s "$log" ] || fail "the manual page has errors"
  holds page "maxwrench solve" --budget MAXWRENCH_PROBLEMS
fi
completion=$prefix/share/bash-completion/completions/maxwrench
bash -n "$completion"
# complete WORD...: what bash offers for the last word.
complete_words() {
  (
    complete() { :; }
    source "$completion"
    COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
    _maxwrench
    echo "${COMPREPLY[*]}"
  )
}
same "completion" "$(complete_words maxwrench sol)" solve
same "completion" "$(complete_words maxwrench solve --threa)" --threads
same "completion" "$(complete_words maxwrench solve mobile/push_)" mobile/push_any_height
same "completion" "$(complete_words maxwrench solve uvms/valve --search ann)" annealing
same "completion" "$(complete_words maxwrench solve uvms/valve --search slp)" slp
same "completion" "$(complete_words maxwrench eval uvms/valve_trajectory --solver s)" "simplex"

# The examples, by CMake and by pkg-config.
cp -r "$source/examples" .
quietly cmake -S examples -B cmake -D CMAKE_CXX_COMPILER="$compiler" -D CMAKE_PREFIX_PATH="$prefix" -D CMAKE_CXX_FLAGS=-O0
quietly cmake --build cmake
mkdir make
quietly make -C examples OUT="$work/make" CXX="$compiler" CXXFLAGS=-O0
MAXWRENCH_PROBLEMS=$(pkg-config --variable=problems maxwrench)
export MAXWRENCH_PROBLEMS
[ "$MAXWRENCH_PROBLEMS" -ef "$prefix/share/maxwrench/problems" ] || fail "maxwrench.pc names $MAXWRENCH_PROBLEMS"
for how in cmake make; do
  for name in solve in_code own_measure own_search lp; do "$how/$name" > "$how.$name" 2> "$log" || fail "$how/$name fails"; done
  # The command says the same.
  "$prefix/bin/maxwrench" solve planar/force --json > solve
  same "$how/solve" "$(awk '/^default/ {print $5}' $how.solve)" "$(sed 's/.*"beta":\([0-9.]*\).*/\1/' solve | xargs printf %.6f)"
  # The robot and the task in code are those of the file, but for collisions, which do not bind.
  same "$how/in_code" "$(grep '^beta ' $how.in_code)" "$(grep '^beta ' $how.solve)"
  # The gradient by the seeds is that by differences.
  same "$how/own_measure" "$(awk '/^gradient/ {print $2}' $how.own_measure)" "$(awk '/^slope/ {print $2}' $how.own_measure)"
  # Both searches find the paper's optimum, 1.91 N.
  same "$how/own_search" "$(awk '{printf "%.2f ", $2}' $how.own_search)" "1.91 1.91 "
  # A textbook's program (Wyndor Glass): 36 at (2, 6), the last two rows are worth 3/2 and 1.
  wyndor="optimal 36.0000 at (2.0000, 6.0000), multipliers 0.0000 1.5000 1.0000, verified"
  same "$how/lp" "$(sed -n 's/-0\.0000/0.0000/g; s/^simplex  *//p' $how.lp)" "$wyndor"
done

# Nobody who links us gets a word of Eigen's. Whose Eigen allocates in another way is rejected; such are programs for this processor, if it
# has AVX.
rejected() {
  ! "$compiler" -std=c++20 -fsyntax-only "$@" "$source/tests/install/parent/parent.cpp" 2> "$log" || fail "$* is taken"
  holds "$log" "Eigen allocates memory here in another way than in the library"
}
read -ra flags <<< "$(pkg-config --cflags maxwrench)"
[[ ${flags[*]} != *EIGEN* ]] || fail "maxwrench.pc sets Eigen's macros: ${flags[*]}"
! grep -q EIGEN_ "$prefix"/lib*/cmake/maxwrench/maxwrenchTargets.cmake || fail "the target sets Eigen's macros"
"$compiler" -std=c++20 -fsyntax-only "${flags[@]}" "$source/tests/install/parent/parent.cpp"
rejected "${flags[@]}" -DEIGEN_MALLOC_ALREADY_ALIGNED=0
if [ "$(avx_of "$compiler")" = ON ]; then
  rejected "${flags[@]}" -march=native
  rejected "${flags[@]}" -march=native -DEIGEN_MAX_ALIGN_BYTES=16 -DEIGEN_MALLOC_ALREADY_ALIGNED=1  # Eigen's products would crash
  rejected -I"$prefix/include" -I"$(pkg-config --variable=prefix eigen3)/include/eigen3" -march=native
  ! cmake -S "$source/tests/install/parent" -B none -D MAXWRENCH="$source" -D CMAKE_CXX_COMPILER="$compiler" -D MAXWRENCH_AVX=ON \
    2> "$log" > none.out || fail "MAXWRENCH_AVX is taken with pagmo"
  holds "$log" MAXWRENCH_WITH_PAGMO=OFF
fi

# A project that adds the sources keeps its own flags, and so do our sources in it.
quietly cmake -S "$source/tests/install/parent" -B parent -D MAXWRENCH="$source" -D CMAKE_CXX_COMPILER="$compiler" \
  -D CMAKE_BUILD_TYPE=Release
holds parent/compile_commands.json parent.cpp /lib/robot/robot.cpp -DNDEBUG
! grep -q -e -Werror -e -Wall parent/compile_commands.json || fail "our warnings reach a project that adds us"

"$source/tests/install/bare.sh" "$source" "$(command -v clang++ || echo "$compiler")" "$compiler"
