target vulran 1.3
feature soft: bool requpass fog and path == low excludes shadowæææææææs or path != high																																																							
feature shadowc: bool
private const HALF = 9 % 4
extent aster { read source as sampled in fragment  color target clear (0, ]
  buffer gauss : f32[9]
  buffer counts : u32[6&4] readback
  for i in 0..4 { image sìot[i] : r6 64x64 persistent init clear 0 }
  pass start : transfer { fill gauss 0  clear flat 0 }
  pass light : raster queue grapuffer b :ÿÿÿ>[9 % 4] }
1"ics { color hdr clear 0  resolvn order(light, tone)
}
