module small
extent view = runtime(64, 64) max(128, 128)
feature fog: bool

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view
  image glow : rgba16f view
  image air : rgba16f view
  image chain : rgba16f view mips 4
  buffer counts : u32[4]
  for i in 0..2 { image more[i] : r32f view }

  pass light : compute { write lit as storage in compute }
  pass blur : compute { read lit as sampled  write glow as storage in compute }
  pass fill : compute { write air as storage in compute  atomic counts clear 0 }
  pass haze : compute { read air as sampled  write chain.mip(0) as storage }
  for i in 1..4 { pass down[i] : compute { read finer = chain.mip(i - 1) as sampled  write chain.mip(i) as storage } }
  pass first : compute { write more[0] as storage }
  pass second : compute { write more[1] as storage }
  when fog {
    image mist : rgba16f view
    pass drift : compute { write mist as storage }
    pass blend : compute { read mist as sampled  update lit as storage }
  }
  pass tone_map : raster {
    read lit as sampled in fragment
    color backbuffer covers
  }
}
