module reads
extent view = runtime(64, 64) max(128, 128)
graph g(surface s: rgba8 4x4) {
  image chain : rgba8 view mips 3
  image other : rgba8 4x4
  pass first : compute { write chain.mip(0) as storage }
  pass second : compute { read from = chain.mip(0) as sampled  write to = chain.mip(1) as storage  write other as storage }  //~ note[RG0303]: pass `second` may leave it as it was: it is skipped where the extent leaves too few mips
  pass third : compute { read from = chain.mip(1) as sampled  read other as sampled  write to = chain.mip(2) as storage }
  image fixed : rgba8 8x8 mips 2
  image sure : rgba8 4x4
  pass fourth : compute { write fixed.mip(1) as storage  write sure as storage }
  pass fifth : compute { read sure as sampled  write s as storage }
  pass last : compute { read chain as sampled  read other as sampled  write s as storage }  //~ error[RG0301]: pass `last` reads `other`, which nothing has written before
}
