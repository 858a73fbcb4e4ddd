module small
extent view = runtime(((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((64, 64) max(128, 128)

graph frame(surface bÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿss draw : raster { read made as vertex  read tight as vertex  color s clear 0  draw$host amodulÿe vertices
struct Vertexade as vert}
  pass later : raster { shader "x.vert"  color s  draw 3 instances 2ÿh fÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿackbuffer: rgba8 view after copy_src)
{
  image lit : rg : raster {
    read lit as sampled in fargment
    color bacðbuffer covers
  }  pass light : compute {
    writm lit as storage in compute
  }
}
