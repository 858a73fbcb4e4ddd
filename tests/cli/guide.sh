#!/bin/bash
# Every step of docs/guide.md compiles: blocks are written to the files they name, in order, and each .rg block is checked with the shaders as they are
# when the step ends; at the end the program is built, verified, and the C++ compiled against what was generated.
set -uo pipefail
source_dir=$1 binary_dir=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
passed=0 failed=0
verdict() {
  if [ "$2" = 0 ]; then passed=$((passed + 1)); else failed=$((failed + 1)); echo "failed: $1"; fi
}
rgc=$binary_dir/compiler/rgc
# One folder a step: the files of all blocks so far, split where a new .rg block begins.
awk -v work="$work" '
  function flush_step() { if (step) system("cp -r " work "/now " work "/step" step) }
  /^```[a-z]+ [A-Za-z0-9_.]+$/ {
    if ($2 ~ /\.rg$/) { flush_step(); step++ }
    system("mkdir -p " work "/now"); file = work "/now/" $2; printf "" > file; inside = 1; next
  }
  /^```/ { if (inside) close(file); inside = 0; next }
  inside { print > file }
  END { flush_step(); print step > (work "/steps") }' "$source_dir/docs/guide.md"
steps=$(cat "$work/steps")
for ((step = 1; step <= steps; ++step)); do
  (cd "$work/step$step" && "$rgc" check frame.rg && "$rgc" verify frame.rg >/dev/null)
  verdict "step $step of docs/guide.md" $?
done
# The ten lines of README.md, with the shaders of the second step.
awk '/^```/ { if (inside) exit; getline; if ($1 == "module") inside = 1 } inside' "$source_dir/README.md" >"$work/step2/readme.rg"
(cd "$work/step2" && "$rgc" verify readme.rg >/dev/null)
verdict "README.md" $?
cd "$work/step$steps" || exit 1
sed 's|^  pass sky|  assert memory(1920x1080) <= 24 MiB\n  assert order(sky, bloom_first)\n&|' frame.rg >asserting.rg
"$rgc" check asserting.rg
verdict "assertions" $?
"$rgc" build frame.rg -o generated --quiet && c++ -std=c++20 -Wall -Wextra -Werror -fsyntax-only -I"$source_dir" -Igenerated main.cpp
verdict "main.cpp" $?
echo "$passed passed, $failed failed"
[ "$failed" = 0 ] && [ "$steps" -ge 3 ]
