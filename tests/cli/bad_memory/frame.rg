module large
extent deep = runtime(64) max(1024)

graph frame(surface backbuffer: rgba8 64x64)
{
  image  voxels  : rgba16f [1024, 1024, deep]
  image  enough  : rgba16f [512, 1024, 256]
  buffer history : u32[300000000] persistent init clear 0

  pass fill : compute {
    write voxels as storage
    write enough as storage
    update history as storage
    dispatch host
  }
  pass show : raster {
    read voxels as sampled in fragment
    read enough as sampled in fragment
    read history as storage in fragment
    color backbuffer clear 0
    draw host
  }
}
