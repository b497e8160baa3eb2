#!/usr/bin/env bash
# Tries maxwrench on a folder of public URDFs: run.sh FOLDER OUT writes
#   OUT/gallery.csv       every URDF of the folder: read or why not, and the differences from KDL (gallery.cpp)
#   OUT/gallery_arms.csv  the arms of arms.csv that the folder has: a lift and a push, each with three seeds, and how long one takes
# The program and the command must be built. 'run.sh FOLDER OUT SECONDS' also tries to prove each optimum for that long; the bound is inf while
# boxes remain that have none.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$here/../../build
folder=$1 out=$2 seconds=${3:-0}
"$build/maxwrench_gallery" "$folder" > "$out/gallery.csv.part" 2> /dev/null
mv "$out/gallery.csv.part" "$out/gallery.csv"

# of KEY: its value in the JSON of a command.
of() { sed -E "s/.*\"$1\":\"?([^,\"}]*).*/\1/"; }

{
  echo "file,tool,wrench,beta,spread,incomplete,seconds,bound,boxes"
  tail -n +2 "$here/arms.csv" | while IFS=, read -r file tool joints; do
    [ -f "$folder/$file" ] || continue
    for wrench in z x; do
      task=("$folder/$file" --tool "$tool" --joints "${joints// /,}" --wrench-along "$wrench" --threads 1)
      betas=() incomplete=0 start=$(date +%s.%N)
      for seed in 1 2 3; do
        answer=$("$build/maxwrench" solve "${task[@]}" --seed "$seed" --json 2> /dev/null || true)
        betas+=("$(of beta <<< "$answer")")
        incomplete=$((incomplete + $(of incomplete <<< "$answer")))
      done
      end=$(date +%s.%N) bound='' boxes=''
      if [ "$seconds" -gt 0 ]; then
        proof=$("$build/maxwrench" certify "${task[@]}" --time "$seconds" --json 2> /dev/null || true)
        bound=$(of bound <<< "$proof" | sed 's/null/inf/') boxes=$(of boxes <<< "$proof")
      fi
      awk -v row="$file,$tool,$wrench" -v a="${betas[0]}" -v b="${betas[1]}" -v c="${betas[2]}" -v i="$incomplete" -v from="$start" -v to="$end" \
        -v bound="$bound" -v boxes="$boxes" 'BEGIN {
          high = a > b ? a : b; high = high > c ? high : c; low = a < b ? a : b; low = low < c ? low : c
          printf("%s,%.6g,%.1e,%d,%.2f,%s,%s\n", row, high, (high > 0 ? (high - low) / high : 0), i, (to - from) / 3, bound, boxes) }'
    done
  done
} > "$out/gallery_arms.csv.part"
mv "$out/gallery_arms.csv.part" "$out/gallery_arms.csv"
