// Every transfer statement, ranges of bytes, draws and dispatches that the GPU counts.
module transfers
struct DrawArguments { a: u32  b: u32  c: u32  d: u32 }
interface In { staging: buffer u32[64] ready as copy_src }
set materials 0 { uniform sampler2D albedo[16]; }
graph g(engine: In, surface s: rgba8 16x16 after present) {
  image a : rgba8 16x16
  image b : rgba8 16x16
  image many : rgba8 16x16 samples 4
  image one : rgba8 16x16
  buffer c : u32[64]
  buffer d : u32[64] output
  buffer args : DrawArguments[4]
  buffer count : u32[4]
  image shade : d32f_s8 16x16 samples 4
  pass t : transfer {
    copy engine.staging -> d
    clear a (0.25, 0.5, 0.75, 1)
    fill c 7
    update args
    update count
  }
  pass u : transfer queue transfer { copy a -> b  copy c.bytes(0, 64) -> d.bytes(64, 64) }
  pass v : transfer { blit b -> a linear  host { read c as copy_src  write d as copy_dst } }
  pass w : raster {
    shader "w.vert" "w.frag"
    color many clear 0
    depth shade.depth clear 1
    resolve many -> one
    bind materials
    draw indirect args max 4 count count
  }
  pass x : transfer { resolve many -> one }
  pass y : compute { shader "y.comp" group 64 1 1  read c as storage  update d as storage disjoint  dispatch indirect count }
  pass z : raster { fullscreen "z.frag"  read one as sampled  read a as sampled  color s }
}
