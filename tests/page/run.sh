#!/usr/bin/env bash
# run.sh MAXWRENCH OUT: the pages of `report` in headless Chromium at 1280 and 390 px: no error, sorting, filters, nothing too wide. Screenshots
# stand in OUT, for people to look at.
set -euo pipefail
command=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$2"
out=$(realpath "$2")

# browse NAME WIDTH HEIGHT: a copy of the page that checks itself, in a frame, for a window has at least 500 px.
browse() {
  local name=$1 width=$2 height=$3 log=$out/$1_$2.log
  sed '$d' "$out/$name.html" | sed '$d' > "$out/checked.html"
  { echo "<script>document.expectedWidth = $width;"; cat "$here/check.js"; echo "</script></body></html>"; } >> "$out/checked.html"
  echo "<body style='margin:0'><iframe src='checked.html' width='$width' height='$height' style='border:0'></iframe>" > "$out/frame.html"
  timeout 120 chromium --headless --no-sandbox --disable-gpu --user-data-dir="$out/profile" --enable-logging=stderr \
    --hide-scrollbars --virtual-time-budget=20000 --window-size="$width,$height" --screenshot="$out/${name}_$width.png" \
    "file://$out/frame.html" > "$log" 2>&1
  sed -n 's/.*CONSOLE[^"]*"\(.*\)", source.*/\1/p' "$log" > "$log.console"
  if grep -v '^passed: \|^the end$' "$log.console" || ! grep -q '^the end$' "$log.console"; then
    echo "$name at $width px: see $log" >&2
    return 1
  fi
  echo "$name at $width px: $(grep -c '^passed' "$log.console") checks passed, $out/${name}_$width.png"
}

"$command" report "$here/../../results" --out "$out" > /dev/null
"$command" report --compare "$here/../../results" "$here/../../results" --out "$out" > /dev/null
for name in report changes; do
  browse $name 1280 3000
  browse $name 390 3000
done
