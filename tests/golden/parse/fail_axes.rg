// Axes as other languages write them; one file parses them all.
extent a = runtime 1920 1080
extent b = runtime(1920x1080)
extent c = runtime(1920, 1080) max 3840, 2160
graph g() {
  image a : rgba8 64 64
  image b : rgba8 64, 64
  image c : rgba8 64 x 64
  image d : rgba8 64 by 64 layers 4
  image e : rgba8 64 X 64
  image f : rgba8 64 64 64 mips 2
  image g : rgba8 64 x64
  image h : rgba8 64X64
  image i : rgba8 64x 64
  image j : rgba8 64×64
  image k : rgba8 64 × 64
  image l : rgba8 [64, 64]
  image m : rgba8 (64, 64)
  pass p : compute {
    shader "a.comp" group 8x8x1
    write l as storage
  }
  pass q : compute {
    shader "a.comp" group (8, 8, 1)
    write l as storage
    dispatch over 64 64
  }
  pass r : compute {
    shader "a.comp" group 8, 8, 1
    write l as storage
    dispatch groups 8 8 1
  }
}
