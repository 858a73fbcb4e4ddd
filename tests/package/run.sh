#!/bin/bash
# Installs the build, and builds the examples as an engine would: from the installed package alone. Checks that rebuilds are exact, that the runtime needs no
# compiler, and that the Debian packages hold what they should.
set -uo pipefail
source_dir=$1 binary_dir=$2
work=$binary_dir/package_test  # always the same place, so that a compiler cache serves the next run
rm -rf "$work" && mkdir -p "$work" || exit 1
trap '[ -z "${xvfb:-}" ] || kill "$xvfb" 2>/dev/null' EXIT
passed=0 failed=0
verdict() {
  if [ "$2" = 0 ]; then passed=$((passed + 1)); else failed=$((failed + 1)); echo "failed: $1"; fi
}
quietly() { "$@" >"$work/log" 2>&1 || { tail -n 30 "$work/log"; return 1; }; }
finish() { echo "$passed passed, $failed failed"; [ "$failed" = 0 ]; exit $?; }

quietly cmake --install "$binary_dir" --prefix "$work/usr"
verdict "cmake --install" $?

configure() {  # example, further arguments
  local name=$1; shift
  cp -r "$source_dir/examples/$name" "$work/$name"
  quietly cmake -S "$work/$name" -B "$work/$name/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror" \
    -DCMAKE_CXX_COMPILER_LAUNCHER="$(command -v ccache)" -DCMAKE_PREFIX_PATH="$work/usr" "$@"
}
build() { quietly cmake --build "$work/$1/build"; }

# ---- headless, and exact rebuilds ------------------------------------------------------------------------------------
configure headless && build headless
verdict "examples/headless builds against the package" $?
(cd "$work" && "$work/headless/build/headless" glow.ppm >/dev/null && [ "$(head -c 15 glow.ppm)" = "P6 256 128 255" ] && [ "$(stat -c %s glow.ppm)" = 98319 ])
verdict "it renders" $?

# What ninja would do now: the names of its steps.
steps() { ninja -C "$work/headless/build" -n | sed -n 's/^\[[0-9/]*\] //p'; }
[ -z "$(steps)" ]
verdict "nothing to do after a build" $?
sleep 0.01; touch "$work/headless/exposure.glsl"
steps | grep -q '^rgc frame.rg'
verdict "an include of a shader compiles the frame again" $?
build headless && ! grep -q 'Building CXX' "$work/log"
verdict "equal output compiles no C++" $?
[ -z "$(steps)" ]
verdict "and leaves nothing to do" $?
sed -i 's/0.02 /0.04 /' "$work/headless/sky.comp"
build headless && grep -q 'Building CXX.*glow_plan' "$work/log" && ! grep -q 'Building CXX.*main.cpp' "$work/log"
verdict "an edited shader compiles the plan, not its users" $?
touch "$work/headless/unrelated.comp"
[ -z "$(steps)" ]
verdict "a file that nobody reads does nothing" $?
echo "void main() { broken }" >"$work/headless/sky.comp"
! build headless >"$work/message" && grep -q 'sky.comp:1' "$work/message"
verdict "an error names the shader" $?

# ---- an engine with its own device -----------------------------------------------------------------------------------
configure engine && build engine
verdict "examples/engine builds against the package" $?
(cd "$work" && "$work/engine/build/engine")
verdict "it runs" $?

# ---- a window ----------------------------------------------------------------------------------------------------------
if command -v Xvfb >/dev/null; then
  configure window && build window
  verdict "examples/window builds against the package" $?
  Xvfb -displayfd 6 -screen 0 640x480x24 -nolisten tcp >/dev/null 2>&1 6>"$work/display" &
  xvfb=$!
  for ((i = 0; i < 200; ++i)); do [ -s "$work/display" ] && break; sleep 0.1; done
  display=$(cat "$work/display")
  (cd "$work" && DISPLAY=:$display timeout 60 "$work/window/build/window" --frames 40 --screenshot shot.ppm)
  verdict "it draws, through resizes" $?
  # A picture of waves, not a blank window: many colours, blue above red.
  [ "$(head -c 15 "$work/shot.ppm")" = "P6 320 200 255" ] && [ "$(tail -c +16 "$work/shot.ppm" | od -An -v -w3 -tu1 | sort -u | wc -l)" -gt 50 ]
  verdict "the screenshot shows the picture" $?
else
  [ -z "${RGC_REQUIRE_GPU:-}" ]
  verdict "Xvfb is there" $?
fi

# ---- the runtime alone, for another machine --------------------------------------------------------------------------
mkdir -p "$work/alone" && cp -r "$source_dir/runtime" "$source_dir/packaging" "$source_dir/docs" "$work/alone/"
cp "$source_dir/CMakeLists.txt" "$work/alone/" && cp -r "$source_dir/generated" "$work/alone/"
off=()
for package in glslang SPIRV-Tools SPIRV-Tools-opt nlohmann_json fmt CLI11 glm TinyGLTF GTest; do off+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON"); done
# What is compiled is what the build has compiled, in another place: with paths relative to it, a compiler cache serves both.
CCACHE_BASEDIR="$work/alone" quietly cmake -S "$work/alone" -B "$work/alone/build" -G Ninja -DRGC_BUILD_COMPILER=OFF -DRGC_BUILD_EXAMPLES=OFF -DRGC_BUILD_TESTS=OFF "${off[@]}" &&
  CCACHE_BASEDIR="$work/alone" quietly cmake --build "$work/alone/build"
verdict "runtime/ and generated/ build without the compiler and its libraries" $?
quietly cmake --install "$work/alone/build" --prefix "$work/target" && [ ! -e "$work/target/bin/rgc" ]
verdict "a package for the target holds no compiler" $?
rm -rf "$work/headless"
configure headless -DCMAKE_PREFIX_PATH="$work/target" -DRGC_EXECUTABLE="$work/usr/bin/rgc" && build headless
verdict "the compiler of the machine that builds serves another package" $?

# ---- Debian packages ---------------------------------------------------------------------------------------------------
(cd "$binary_dir" && quietly cpack -G DEB -B "$work/deb" -D CPACK_DEBIAN_COMPILER_PACKAGE_SHLIBDEPS=OFF)
verdict "cpack" $?
contents() { dpkg-deb -c "$work"/deb/"$1"_*.deb | awk '{print $6}'; }
contents librgc-dev | grep -q './usr/include/rgc/runtime/graph.h' && contents librgc-dev | grep -q 'librgc_runtime.a' && ! contents librgc-dev | grep -q './usr/bin'
verdict "librgc-dev holds the runtime" $?
contents rgc | grep -q './usr/bin/rgc'
verdict "rgc holds the compiler" $?
finish
