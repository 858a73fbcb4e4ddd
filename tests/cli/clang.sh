#!/bin/bash
# Everything compiles with clang, too, and what clang makes of the compiler makes the same of the frame. Part of --long: it builds all there is.
set -uo pipefail
source_dir=$1 binary_dir=$2
command -v clang++ >/dev/null || { echo "skipped: clang is not installed; ./x fuzz installs it"; exit 77; }
work=$binary_dir/clang_test  # always the same place, so that a compiler cache serves the next run
passed=0 failed=0
verdict() {
  if [ "$2" = 0 ]; then passed=$((passed + 1)); else failed=$((failed + 1)); echo "failed: $1"; fi
}
quietly() { "$@" >"$work.log" 2>&1 || { grep -A 20 '^FAILED' "$work.log" || tail -n 30 "$work.log"; return 1; }; }

quietly cmake -S "$source_dir" -B "$work" -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_COMPILER_LAUNCHER="$(command -v ccache)" && quietly ninja -C "$work"
verdict "everything compiles" $?
rm -rf "$work/made"
quietly "$work/compiler/rgc" build "$source_dir/passes.rg" -o "$work/made" --no-cache && quietly diff -r "$source_dir/generated" "$work/made"
verdict "passes.rg gives generated/" $?
for room in dsl plan verify; do
  quietly "$work/tests/test_$room"
  verdict "test_$room" $?
done
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
