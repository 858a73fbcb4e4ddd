#!/bin/bash
# generated/ is what the compiler makes of passes.rg, byte for byte, and a second run changes nothing.
set -uo pipefail
source_dir=$1 binary_dir=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$source_dir" || exit 1
"$binary_dir/compiler/rgc" build passes.rg -o "$work/generated" --quiet || exit 1
if ! diff -r generated "$work/generated"; then
  echo "generated/ is stale; run ./x gen and look at the difference"
  echo "0 passed, 1 failed"
  exit 1
fi
"$binary_dir/compiler/rgc" build passes.rg -o "$work/generated" | tail -n 1 | grep -q ': 0 written, 0 removed' || { echo "a second run writes again"; echo "1 passed, 1 failed"; exit 1; }
echo "2 passed, 0 failed"
