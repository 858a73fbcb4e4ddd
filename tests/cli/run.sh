#!/bin/bash
# Runs every case below tests/cli: a folder with a script `cmd`, its input files and `expected`: exit code, stdout and stderr.
# A case runs in a copy of its folder, with `rgc` on the PATH. RGC_UPDATE=1 captures, RGC_GOLDEN=PATH takes the cases whose path contains PATH.
set -uo pipefail
source_dir=$1 binary_dir=$2
cases=$source_dir/tests/cli
[ -x "$binary_dir/compiler/rgc" ] || { echo "there is no $binary_dir/compiler/rgc"; exit 1; }
work=$(mktemp -d)
trap 'chmod -R u+w "$work"; rm -rf "$work"' EXIT
mkdir "$work/bin"
ln -s "$binary_dir/compiler/rgc" "$work/bin/rgc"
demo=$binary_dir/examples/demo/rgc_demo
[ ! -x "$demo" ] || ln -s "$demo" "$work/bin/demo"
export PATH=$work/bin:$PATH LC_ALL=C RGC_SOURCE=$source_dir RGC_CACHE=off
unset NO_COLOR

run_case() {
  cp -r "$1" "$work/case"
  (cd "$work/case" && rm -f cmd expected && bash "$1/cmd" >"$work/stdout" 2>"$work/stderr" </dev/null)
  echo "exit $?"
  echo "--- stdout"
  cat "$work/stdout"
  echo "--- stderr"
  cat "$work/stderr"
  chmod -R u+w "$work/case"
  rm -rf "$work/case"
}

passed=0 failed=0
for cmd in "$cases"/*/cmd; do
  folder=${cmd%/cmd} name=${cmd%/cmd}
  name=tests/cli/${name##*/}
  [[ "$name/cmd" == *"${RGC_GOLDEN:-}"* || "${RGC_GOLDEN:-}" == *"$name"* ]] || continue
  if [ ! -x "$demo" ] && grep -q '^demo ' "$cmd"; then continue; fi
  run_case "$folder" | sed "s|$work/case|CASE|g; s|$source_dir|SOURCE|g" >"$work/actual"
  if [ -n "${RGC_UPDATE:-}" ]; then cp "$work/actual" "$folder/expected"; fi
  if diff -u --label "$name/expected" --label actual "$folder/expected" "$work/actual"; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    echo "rerun: ./x test golden $name"
  fi
done
echo "$passed passed, $failed failed"
[ "$failed" = 0 ] && [ "$passed" != 0 ]
