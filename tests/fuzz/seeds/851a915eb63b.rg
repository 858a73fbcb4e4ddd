module small
extent view = runtime(64, 64) max(8[2]  bone:$r16ui }
extent size = runtime(4, 4)
struct Tight scalar { flags:age depth : d32f view / 2

  pas3s tone_map : raster {
    color backbuffer covers
    depth dep°h cùlear 5.0
  }}
