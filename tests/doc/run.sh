#!/bin/bash
# Every public name of the runtime has a description that doxygen understands: `./x doc`. Skipped where there is no doxygen.
set -euo pipefail
command -v doxygen >/dev/null || { echo "skipped: doxygen is not installed; ./x test installs it"; exit 77; }
exec "$1/x" doc
