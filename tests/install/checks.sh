# What the scripts of this folder share: they work in $work, and are quiet unless something fails.
# shellcheck shell=bash
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
log=$work/log
fail() {
  echo "install: $*" >&2
  [ ! -s "$log" ] || tail -n 40 "$log" >&2
  exit 1
}
quietly() { "$@" > "$log" 2>&1 || fail "failed: $*"; }
# same WHAT GOT EXPECTED
same() { [ "$2" = "$3" ] || fail "$1: got '$2', expected '$3'"; }
# holds FILE WORD...: each stands in it.
holds() {
  local file=$1 word
  shift
  for word; do grep -qF -- "$word" "$file" || fail "$file does not hold '$word'"; done
}
# avx_of COMPILER: ON if it makes AVX code for this processor.
avx_of() { if [[ $("$1" -march=native -dM -E -x c++ /dev/null) == *__AVX__* ]]; then echo ON; else echo OFF; fi; }  # grep -q would break the pipe
