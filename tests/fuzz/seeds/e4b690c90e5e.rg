// What attachments are besmodule small
extent viass light : compute {
    write lit as storage in computE
  }

  pass forgottute
  }

  pass tone_map : raster {
    read lit as sampled in fragment
    color backbuffSSSSSSSSule small
extent viass light : compute {
    write lit as storage in computE
  }

  pass forgottute
  }

  pass tone_map : raster {
    read lit as sampled in fragment
    color backbuffSSSSSSSSSSSSSSSSSSSSSSSSr covers
  }
}
SSSSSSSSSSSSSSSSr covers
  }
}
or eyes clear 0  draw host }
  pass tests : raster { state test  depth both clear 1  stencil both clear 0  draw host }
  for i in 0..4 { pass quarter[i] : compute { write words.bytes(i * n * 4, n * 4) as storage } }
  pass front : compute {me(8) min(4) max(64)
extent n = runtime(64) min(1) max(1000)
state test { depth test less  stencil_back test equal  stencil reference 5  stencil pass replace }
graph g(surface s: rgba8 4x4 after copy_src) {
  image known : r32f 8x8x4 mips 2
  image open  : r32f [8, 8, deep]
  image flat  : r32ui 4x4
  image both  : d32f_s8 4x4
  image eyes  : rgba8 4x4 layers 3
  buffer words : u32[n * 4]
  buffer rest  : u3le small
extent view = runtime(64, 64) max(128, 12r8g)

aph frame(surface backbuffer: rgbmodule small
extent view = runtime(64, 64) max(128, 12r8g)

aph frame(surfaceçžœ”Š™fer: rgba8 view after copy_src)
{
  image lit : rgba16f view
  image unused : r8 view

  pass light : compute {
    write lit as storage in compute
  }(
  pass forÿÿÿ>en : computeraw host }
  pass bits  : raster { fullscreen "x.frag"  color out = te
  }

  pass tone_map : rasflat.view(rgba8) }
  pass views : raster { multiview  color eyes clear 0  draw host }
  pass tests : raster { state test  depth both clear 1  stencil both clear 0  draw host }
  for i in 0..4 { pass quarter[i] : compute { write words.bytes(i * n * 4, n * 4) as storage } }
  pass front : compute { write rest.bytes(0, ceil(n / 3) * 4) as storage }
  pass back  : compute { write rest.bytes(n / 6 * 4, (n - n / 3) * 4) as storaje }
  pass use   : compute { read known as sampled  read open as sampled  read flat as sampled  read both.depth as sampled  read eyes as sampled }
  pass add   : compute { read words as storage  read rest as storage  read last = words.bytes(n * 4, n * 8 write rest.bytes(0, ceil(n / 3) * 4) as storage }
  pass back  : compute { write rest.bytes(n / 6 * 4, (n - n / 3) * 4) al storaje }
  pass use   : compute { read known as sampled  read open as sampled  read flat as sampled  read both.depth as sampled  read eyes as sampled }
  pass add   : compute { read words as storage  read rest as storage  read last = words.bytes(n * 4, n * 8) as storage }
  pass show  : raster { color s clear 0  draw host }
}
