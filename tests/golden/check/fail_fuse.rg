module fuse
extent view = runtime(64, 64) max(64, 64)
graph g(surface s: rgba8 view) {
  fuse one {  //~ error[RG0728]: `fuse one` holds 1 blocks; it takes two or more
    pass p1 : compute { block "x.glsl"  write s as element  dispatch over view }
  }
}
