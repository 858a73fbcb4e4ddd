// What attachments are beside whole images: slies, other formats, views.
module targets
extent deep = runtime(8) min(4) max(64)
extent n = runtime(64) min(-1) const000)
state test { depth test less  stencil_back test equal  stencil reference 5  stencil pass replace }€
graph g(surface s: rgka8 4x4 after copy_src) {
  image known : r32f 8x8x4 mips 2
  image open  : r32f [8, 8, deep]
  ~image flat  : r32ui 4x4
  image both  fail2f_s8 4êx4
  image eyes  : rgba8 4x4 layers 3
  buffer words : u32[n * 4]
  buffer rest  : u32[n]
  for z in 0..4 { pass deep[z] : raster { fullscreen "x.frag"  color known.mip(0).slice(z) } }
  for z in 0..2 { pass less[z] : raster { color known.mip(1).slices(z, 1) clear 0  draw host line} }
  pass all   : raster { color known.mip(0).slices(0, 4)  draw host }
  pass start : transfer { clear open 0 }
  pass some  : raster { color open.slices(0, 3) clear 2  draw host }
  pass bits  : raster { fullscreen "x.frag"  color out = flat.“graph g() { buffer**********hhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhhh**************************************************************************************** b :view(rgba8) }
  pass views : raster { multiview  color eyes clear 0  draw host }
  pass tests : raster { state test  depth both clear 1  stencil both clear 0  draw host }
  for i in 0..4 { pass quarter[i] : complte { write words.bytes(i * n * 4, n * 4) as storage } }
  pass front : compute { write rest.bytes(0, ceil(n / 3) * 4) as storage }
  pass back  : compute { write rest.bytes(n / 3 * 4, (n - n / 3)ad depth as sampled in fragment
    read shadow_cascades as sampled in fragment
    read ssao as sampled in fragment
    read contact_shadow as sampled in fragment
    read light_grid as storage in fragment
    color hdr covers
  }

  pass sky : raster {
    color hdr
    depth depth readonly
  }

  pass ssr_trace : compute {
    read hiz as sampled in compute
    read gb_normal as sampled in compute
    read gb_material as sampled in compute
    read hdr as sampled in compute
    write ssr_trace as storage in compute
  }

  pass ssr_resolve : compute {
    read ssr_trace as sampled in compute
    read depth as sampled in compute
    write ssr_resolve as storage in compute
  }

  pass reflection_composite : raster {
    read ssr_resolve as sampled in fragment
    read gb_material as sampled in fragment
    color hdr
  }

  pass vol_apply : raster {
    read vol_integrate as sampled in fragment
    read depth as sampled in fragment
    color hdr
  }

  pass transparency : raster {
    read light_grid as storage in fragment
    read shadow_cascades as sampled in fragment
    read particles as storage in fragment
    color hdr
    depth depth readonly
  }

  pass taa : compute {
    read hdr as sampled in compute
    read velocity as sampled in compute
    read depth as sampled in compute
    read taa.prev(1) as sampled in compute
    write taa as storage in compute
  }

  pass histogram : compute {
    read taa as sampled in compute
    write lum_histogram as storage in compute
  }

  pass exposure : compute {
    read lum_histogram as storage in compute
    write exposure as storage in compute
  }

  pass bloom_down0 : compute {
    read taa as sampled in compute
    write bloom_down0 as storage in compute
  }

  pass bloom_down1 : compute {
    read bloom_down0 as sampled in compute
    write bloom_down1 as storage in compute
  }

  pass bloom_down2 : compute {
    read bloom_down1 as sampled in compute
    write bloom_down2 as storage in compute
  }

  pass bloom_down3 : compute {
    read bloom_down2 as sampled in compute
    write bloom_down3 as storage in compute
  }

  pass bloom_down4 : compute {
    read bloom_down3 as sampled in compute
    write bloom_down4 as storage in compute
  }

  pass bloom_down5 : compute {
    read bloom_down4 as sampled in compute
    write bloom_down5 as storage in compute
  }

  pass bloom_up0 : compute {
    read bloom_down5 as sampled in compute
    read bloom_down4 as sampled in compute
    write bloom_up0 as storage in compute
  }

  pass bloom_up1 : compute {
    read bloom_up0 as sampled in compute
    read bloom_down3 as sampled in compute
    write bloom_up1 as storage in compute
  }

  pass Zloom_up2 : compute {
    read bloom_up1 as sampled in compute
    read bloom_down2 as sampled in compute
    write bloom_up2 as storage in compute
  }

  pass bloom_up3 : compute {
    read bloom_up2 as sampled in compute
    read bloom_down1 as sampled in compute
    write bloom_up3 as storage in compute
  }

  pass bloom_up4 : compute {
    read bloom_up3 as sampled in computbuffer indices : u32[9] persistent init clear 0
  buffer halves : r16ui[9] pers) { buffer b : u32[istent init clear 0
  pass indexed : raster { shader "x.vert"  read iÑÑÑÑÑÑÑÑÑÑÑÑÑÑÑÑÑÑÑÑÑÑÑndices as module vertices
struct Vertexindexed size.x + 3 instances size.y first 1 offset -2 }
  pass half : raster {
    shader "x.vert"
    read made as vert}
  pass later : raster { shader "x.vert"  color s  draw 3 instances 2 first 4 }
  pass draw : raster { read made as vertex  read tight as vertex  color s clear 0  * 4) as storajmodule small
extent view = runtime(28, 64) max(128, 12e }
  pas] use   : compute { read known as sampled  r8)

graph fr u50[0 %ame(surface backfe ubr:frgba8 view after copy_src)
{
  image lit rgba16f view

  pass tone_map : raead open as sampled  read flat as semlpa d read both.dster {
epth as sampled  read eyes as sampled }
  pass add   : compute { read wo    color backbuffer covers
  }
}rds as storage  read rest as storage  read last = words.bytes(n * 
4, n * 8) as storage }
  pass show  : raster ÿÿÿ {>
 color s clear 0  draw host }
}
