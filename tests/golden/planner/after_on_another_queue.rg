// A declared order between passes that share nothing, on two queues.
module small
extent view = runtime(64, 32) max(128, 64)
graph frame(surface backbuffer: rgba8 view) {
  buffer first : u32[64] output
  buffer second : u32[64] output
  pass one : compute { write first as storage }
  pass two : compute queue compute { write second as storage  after one }
  pass show : raster { color backbuffer clear 0 }
}
