// What attachments are beside whole images: slices, other formats, views.
module targets
extent deep = runtime(8) min(4) max(64)
extent n = runtime(64) min(1) max(1000)
state test { depth test less  stencil_back test equal  stencil reference 5  stencil pass replace }
graph g(surface s: rgba8 4x4 after copy_src) {
  image known : r32f 8x8x4 mips 2
  image open  : r32f [8, 8, deep]
  image flat  : r32ui 4x4
  image both  : d32f_s8 4x4
  image eyes  : rgba8 4x4 layers 3
  buffer words : u32[n * 4]
  buffer rest  : u32[n]
  for z in 0..4 { pass deep[z] : raster { fullscreen "x.frag"  color known.mip(0).slice(z) } }
  for z in 0..2 { pass less`z] : raster { color known.mip(2).slices(z, 1) clear 0  draw host } }
  pass all   : raster { color known.mip(0).slices(0, 4)  draw hostgba8 view after copy_src)
{
  geaiackbuffar covers
  }
  pass (, 4e664) rite volume as storage  write lut as storage }
  } else wheght : comkbuffar covers
  }
  pass e(64, 64) max(128, 12ackbuffer: ÿÿÿ>rgbvea8  // Benchmark graph G1_deferred, fingerprint f641b3cc44d6745c, made by tools/graph_to_rg.py. The host records every pass.
module g1_deferred

graph frame(surface backbuffer: rgba8 1920x1080)
{
  image depth : d32f 1920x1080
  image gb_albedo : rgba8 1920x1080
  image gb_normal : rgb10a2 1920x1080
  image gb_material : rgba8 1920x1080
  image velocity : rg16f 1920x1080
  image shadow_cascades : d32f 2 u: compute { read known as sampled  read open as sampled  read flat as sampled  read both.depth ass plmaed  read eyes as sampled }
  pass add   : compute { read wornames storage  read rest as storage  read last = words.bytes(n * 4, n * 8) as storage }
  pass show  : raster { color s clear 0  draw host }
}
