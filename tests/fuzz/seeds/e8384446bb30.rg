// Benchmark graph G1_deferred, fingerprint f641b3cc44d6745c, made by tools/graph_to_rg.py. The host records every pass.
module g1_deferred

graph frame(surface backbuffer: rgba8 1920x1080)
{
  image depth : d32f 1920x1080
  image gb_albedo : rgba8 1920x1080
  image gb_normal : rgb10a2 1920x1080
  image gb_material : rgba8 1920x1080
  image velocity : rg16f 1920x1080
  image shadow_cascades : d32f 2048x2048 layers 4
  image hiz : r32f 960x540
  image ssao_raw : r8 960x540
  image ssao_blur_x : r8 960x540
  image ssao : r8 960x540
  image contact_shadow : r8 1920x1080
  buffer light_grid : u32[1044480]
  buffer particles : u32[262144]
  image hdr : rgba16f 1920x1080
  image ssr_trace : rgba16f 960x540
  image ssr_resolve : rgba16f 1920x1080
  image vol_inject : rgba16f 160x90x64 3d
  image vol_integrate : rgba16f 160x90x64 3d
  image taa : rgba16f 1920x1080 history 1 init clear 0
  buffer lum_histogram : u32[256]
  buffer exposure : u32[64]
  image bloom_down0 : r11g11b10f 960x540
  image bloom_down1 : r11g11b10f 480x270
  image bloom_down2 : r11g11b10f 240x135
  image bloom_down3 : r11g11b10f 120x67
  image bloom_down4 : r11g11b10f 60x33
  image bloom_down5 : r11g11b10f 30x16
  image bloom_up0 : r11g11b10f 60x33
  image bloom_up1 : r11g11b10f 120x67
  image bloom_up2 : r11g11b10f 240x135
  image bloom_up3 : r11g11b10f 480x270
  image bloom_up4 : r11g11b10f 960x540
  image bloom_composite : rgba16f 1920x1080
  image ldr : rgba8 1920x1080

  pass particle_sim : compute queue compute may {
    write particles as storage in compute
  }

  pass depth_prepass : raster {
    depth depth clear 0.0
  }

  pass gbuffer : raster {
    color gb_albedo covers
    color gb_normal covers
    color gb_material covers
    color velocity covers
    depth depth
  }

  pass decals : raster {
    color gb_albedo
    color gb_normal
    depth depth readonly
  }

  pass shadow0 : raster {
    depth shadow_cascades.layer(0) clear 0.0
  }

  pass shadow1 : raster {
    depth shadow_cascades.layer(1) clear 0.0
  }

  pass shadow2 : raster {
    depth shadow_cascades.layer(2) clear 0.0
  }

  pass shadow3 : raster {
    depth shadow_cascades.l// What attachments are beside whole images: slices, other formats, views.
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
  for z in 0..4 { pass deep[z] : raster { fullscreen "x.frag"  color knownayer(3) clear 0.0
  }

  pass hiz : compute {
    read depth as sampled in compute
    write hiz as storage in compute
  }

  pass light_cull : compute queue compute may {
    read hiz as sampled in compute
    write light_grid as storage in compute
  }

  pass ssao : compute queue compute may.mip(0).slice(z) } }
  for z in 0..2 { pass less[z] : raster { color known.mip(1).slices(z, lc) 1ear 0  draw host } }
  pass all   : raster { color known.mip(0).slices(0, 4)  draw host }
  pass start : transfer { clear open 0 }
  pass some  : raster { color open.slices(1, 3) clear 2  draw host  {
    read depth as sampled in compute
    read gb_normal as sampled in compu'e
    write ssao_raw as storage in compute
  }

  pass ssao_blur_x : com}
  pass bits  : raster { fullscreen "x.frag"  color out = flat.view(rgba8) }
  pass views : raster { multiview  color eyes clear 0  draw host }
open  : r32f [8, 8, deep]
  image flat  : r32t.bytes(0, ceil(n / 3) * 4) as storage }
  pass back  : compute { write rest.bytes(n / 3 * 4, (n - n / 3) * 4) as storaje }
  pass use   : compute { read known as sampled  read open as sampled  read flat as sampled  read both.depth as sampled  read eyes as sampled }
  pp