#!/bin/bash
# What the demo's options leave behind, on the Vulkan device there is: dumps, a trace, a profile that the planner reads, a pipeline cache. Usage: demo.sh SOURCE BUILD
set -uo pipefail
source=$1 demo=$2/examples/demo/rgc_demo rgc=$2/compiler/rgc
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
passed=0 failed=0
verdict() {
  if [ "$2" = 0 ]; then passed=$((passed + 1)); else failed=$((failed + 1)); echo "failed: $1"; fi
}
run() { "$demo" --width 64 --height 36 --frames 2 --camera courtyard --view final "$@" >stdout 2>stderr || { cat stdout stderr; return 1; }; }
wrote() { grep -qx "wrote $1" stdout && [ -s "$1" ]; }

if ! run --pipeline-cache frame.pipelines; then
  [ -n "${RGC_REQUIRE_GPU:-}" ] || ! grep -q 'no Vulkan' stderr || { echo "skipped: there is no Vulkan device"; exit 77; }
  verdict "the demo runs" 1
fi
wrote out/plaza_courtyard.png
verdict "it writes a picture" $?
wrote frame.pipelines && [ "$(head -c 7 frame.pipelines)" = rgcpipe ]
verdict "--pipeline-cache writes a file" $?
mv out/plaza_courtyard.png first.png
run --pipeline-cache frame.pipelines && cmp -s first.png out/plaza_courtyard.png
verdict "and takes it, for the same picture" $?
[ "$(ls)" = "$(printf '%s\n' first.png frame.pipelines out stderr stdout)" ]
verdict "with nothing left beside it" $?
echo "no pipelines at all" >frame.pipelines
run --pipeline-cache frame.pipelines && cmp -s first.png out/plaza_courtyard.png && [ "$(head -c 7 frame.pipelines)" = rgcpipe ]
verdict "one that is none is replaced" $?
! run --pipeline-cache nowhere/frame.pipelines >/dev/null &&
  [ "$(cat stderr)" = 'error: `nowhere/frame.pipelines` cannot be written: No such file or directory' ]
verdict "one that cannot be written is an error" $?

run --dump transparent.hdr --dump deferred_light.reset.tile_kernels --dump tile_cull.tile_lights --trace trace.json --profile frame.profile.json --serial --poison --threads 4 --validate
verdict "it looks inside, and validation has nothing to say" $?
wrote out/transparent.hdr.exr && wrote out/transparent.hdr.png && [ "$(head -c 4 out/transparent.hdr.exr | od -An -tx1)" = " 76 2f 31 01" ]
verdict "an image becomes EXR and PNG" $?
wrote out/tile_cull.tile_lights.bin
verdict "a buffer becomes bytes" $?
wrote trace.json && python3 - <<'PYTHON'
import json
trace = json.load(open("trace.json"))
events = trace["traceEvents"]
tracks = {e["tid"]: e["args"]["name"] for e in events if e["name"] == "thread_name"}
slices = [e for e in events if e["ph"] == "X"]
assert tracks[0] == "frames" and tracks[1] == "queue 0 graphics", tracks
assert all(e["tid"] in tracks and e["dur"] >= 0 and e["ts"] >= 0 for e in slices)
assert sum(e["tid"] == 0 for e in slices) == 3
assert sum(e["name"] == "transparent" for e in slices) == 3
for track in tracks:  # Perfetto drops slices that overlap without one lying in the other
    end = 0
    for e in sorted((e for e in slices if e["tid"] == track), key=lambda e: e["ts"]):
        assert e["ts"] >= end - 0.002, e
        end = e["ts"] + e["dur"]
PYTHON
verdict "a trace is what Perfetto reads" $?
wrote frame.profile.json && "$rgc" stats "$source/passes.rg" --profile frame.profile.json >report 2>notes && ! grep -q profile notes
verdict "a profile is what the planner reads" $?
! run --dump transparent.nothing >/dev/null && grep -q '^error: there is no resource `nothing`; there are ' stderr
verdict "a misspelt dump is an error" $?
run --validate && grep -qx 'validation: 0 messages' stdout
verdict "nothing to say under validation" $?
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
