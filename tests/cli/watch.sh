#!/bin/bash
# `rgc watch`: after an edit of a spectrum's shader a preview comes first, the whole build follows, and is what `rgc build` makes. Usage: watch.sh SOURCE BUILD
set -euo pipefail
rgc=$2/compiler/rgc
folder=$(mktemp -d)
trap 'kill "$watch" 2>/dev/null || true; rm -rf "$folder"' EXIT
cd "$folder"

cat >frame.rg <<'TEXT'
module frame
spectrum kinds { red  green  blue  modes 2 }
graph frame()
{
  buffer masks : u32[64]
  buffer shown : u32[4096] readback
  pass mark  : transfer { fill masks 1  fill shown 0 }
  pass shade : compute {
    shader   "shade.comp" group 8 8 1
    spectrum kinds by masks
    update   shown as storage disjoint
    dispatch over 64x64
  }
}
TEXT
shader() {
  cat >shade.comp.new <<TEXT
void main() {
  uint at = spectrum_pixel().y * 64u + spectrum_pixel().x, value = $1;
  if (red) value += shown[(at * 7u) & 4095u];
  if (green) value *= 5u + at;
  if (blue) value ^= 0x155u;
  shown[at] = value;
}
TEXT
  mv shade.comp.new shade.comp
}

# Line NUMBER of the log, which is an answer to what was edited.
line() {
  local tries
  for tries in $(seq 600); do
    [ "$(wc -l <log)" -lt "$1" ] || { sed -n "$1p" log; return; }
    sleep 0.1
  done
  echo "nothing came in a minute" >&2
  cat log >&2
  exit 1
}
passed=0
expect() {
  [[ $1 == $2 ]] || { echo "found \`$1\`, expected \`$2\`" >&2; exit 1; }
  passed=$((passed + 1))
}

shader 1u
touch log
"$rgc" watch frame.rg --plan-file frame.rgplan --cache cache >log 2>notes &
watch=$!
expect "$(line 1)" "frame.rgplan: up to date, *"
shader 2u
expect "$(line 2)" "frame.rgplan: a preview, *"
expect "$(line 3)" "frame.rgplan: up to date, *"
"$rgc" build frame.rg -o generated --plan-file built.rgplan --no-cache --quiet 2>/dev/null
cmp built.rgplan frame.rgplan
shader "no such thing"
expect "$(line 4)" "frame.rgplan: left as it is, *"
cmp built.rgplan frame.rgplan
shader 2u
expect "$(line 5)" "frame.rgplan: up to date, *"
echo "$passed passed, 0 failed"
