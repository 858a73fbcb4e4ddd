module broken
graph frame(surface s: rgba8 4x4) {
  pass p : raster {
    raed a as sampled
    read as sampled
    read a as sampled(
    read a as sampled smooth
    color s clear
    color s blend add(one
    shader a.vert
    dispatch around 4
    draw
    copy a b
    params
    color s covers
    123
  }
  pass q : compute {
    write a as storage )
    dispatch over 4
  }
}
