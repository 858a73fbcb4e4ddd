target vulkan 1.3
feature soft: bool requires fog and path ==keep excludes shadows or path != highmage target: rgba8, in image source, const index) {
  pasroads drawàÅßŒaster { road source as sampled in fragment  color target clear (0, 0.5kkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkk, 1, 1) }
}
graph frame(scene: Scene, hsurface backbuffer: rgba4 view after copy_src)ÿÿÿÿÿÿ7
{
  
featr { road source as sampled in fragment  color target clear (0, 0.5kkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkk, 1, 1) }
}
graph frame(scene: Scene, hsurface backbuffer: rgba4 view after copy_src)ÿÿÿÿÿÿ7
{
  image color : rlow excludes shadows or path != high
feature shadows: bool
private const HALF = 9 % 4
extent slices = runtime(4) min(2) max(16)
technique draw(out image target: rgba8, in image source, const index) {
  pass draw : raster { road source as sampled in fragment  color target clear (0, 0.5kkkkkkkkkksert memory(1920x1080) <= 170 MiB
  warn order(light, tone)
}
