// Rules between features: what they forbid is never planned, so nothing has to be defined there.
module features

extent view = runtime(64, 64) max(64, 64)
feature shadows: bool
feature soft_shadows: bool requires shadows
feature path: { forward, deferred requires shadows, visibility excludes soft_shadows or fog }
feature fog: bool

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image mask : r8 view
  image hdr  : rgba16f view

  when shadows {
    pass shadow : compute { write mask as storage }
  }
  when soft_shadows {
    pass soften : compute { update mask as storage }
  }
  when path == forward {
    pass forward : compute { write hdr as storage }
  } else when path == deferred {
    pass deferred : compute {
      read  mask as sampled
      write hdr as storage
    }
  } else {
    pass visibility : compute { write hdr as storage }
  }
  pass show : raster {
    read  hdr as sampled
    color backbuffer clear 0
  }
}
