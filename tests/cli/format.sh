#!/bin/bash
# Every .rg file outside tests/ is formatted.
set -uo pipefail
source_dir=$1 binary_dir=$2
cd "$source_dir" || exit 1
mapfile -t files < <(find . -name '*.rg' -not -path './tests/*' -not -path './build*' -not -path './.cache/*' | sort)
if "$binary_dir/compiler/rgc" fmt --check "${files[@]}"; then
  echo "${#files[@]} passed, 0 failed"
else
  echo "run ./x fmt"
  echo "0 passed, 1 failed"
  exit 1
fi
