// A pass that covers a surface goes on in a rendering that began with what was there: its row names the load, too.
module q
extent view = runtime(64, 64) max(128, 128)
condition some
graph g(surface screen: rgba8 view after present) {
  image extra : rgba8 view output
  pass first : raster { color screen clear 0 color extra clear 0 draw host }
  pass glow : raster { color screen blend add(one, one) draw host }
  if host some { pass cover: raster { color screen covers draw host } }
}
