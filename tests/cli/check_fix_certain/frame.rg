module certain
struct Light { at: float3  power: float  extra: vec5 }
extent view = runtime(64, 64) max(128, 128)
graph certain(surface backbuffer: rgba8 view after copy_src) {
  image lit : rbga8 view
  image raw : rgb16f view
  pass light : compute {
    write lit as storage in compute
  pass show : raster { color backbuffer clear 0 }
}
