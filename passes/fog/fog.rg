// Fog in froxels: a volume of cells along the view. Media go in, light is scattered, and both are summed up from near to far; whoever
// shades a point then reads one texel. Groups are clusters of 4 x 4 x 4 froxels, so that what a cluster holds is found once for all of them.
module fog

import "passes/view/view.rg"
import "passes/scene/scene.rg"

const FOG_CLUSTER = 4   // froxels a side
const FOG_CASCADES = 4  // ranges of depth, each with its share of the slices

extent froxels = runtime(64, 36, 64) max(160, 96, 128)  // slices: a multiple of FOG_CLUSTER * FOG_CASCADES

feature fog_sun: bool  // which light is scattered, chosen each frame; a kernel for each of the eight sets
feature fog_lights: bool
feature fog_ambient: bool

struct Fog {
  ends:           vec4  // view depth where each cascade ends, metres, ascending; its slices divide it evenly
  previous_ends:  vec4  // last frame's
  start:          f32   // where the first one begins
  previous_start: f32
  density:        f32   // extinction at height `ground` and below, 1 / metre
  ground:         f32   // height, metres
  thinning:       f32   // above it, 1 / metre
  phase:          f32   // mean cosine of the angle that sunlight is scattered by (Henyey and Greenstein)
  blend:          f32   // share of the new frame, 1: history counts for nothing
  albedo:         vec3  // share of light that is scattered, not absorbed
  volume_count:   u32
  jitter:         vec3  // of this frame's samples, froxels, within half a froxel of the centre
  spare:          f32
  count:          vec3  // froxels
}

// Which lamps and boxes of fog reach each cluster, one bit each.
technique fog_clusters(params camera: View, params fog: Fog, buffer lights, buffer volumes, inout buffer cluster_volumes,
    inout buffer cluster_lights)
{
  pass cull : compute queue compute may {
    shader "fog_cull.comp" group 64 1 1
    params camera
    params fog
    read   lights as storage
    read   volumes as storage
    write  cluster_volumes as storage
    write  cluster_lights as storage
    dispatch groups ceil(froxels / FOG_CLUSTER)
  }
}

// A stretch of even fog: what it scatters towards its near end, and the share of light from behind that comes through.
struct Stretch { light: vec3  through: f32 }

// Three blocks, each a kernel of its own with volumes between them, or one kernel where a `fuse` stands around.
technique fog_chain(params camera: View, params fog: Fog, buffer lights, buffer volumes, buffer cluster_volumes,
    buffer cluster_lights, image albedo_maps, image sun_shadow, image lamp_shadow, inout image density,
    inout image inscatter, inout image extinction, inout image memory, inout image scattered,
    inout image transmittance)
{
  pass inject : compute queue compute may {
    block  "fog_inject.glsl" group 4 4 4
    params camera
    params fog
    read   volumes as storage
    read   cluster_volumes as storage
    read   albedo_maps as sampled(surface_sampler)
    write  density as element
    dispatch over froxels
  }
  pass light : compute queue compute may {
    block  "fog_light.glsl" group 4 4 4
    features fog_sun, fog_lights, fog_ambient
    params camera
    params fog
    read   lights as storage
    read   cluster_lights as storage
    read   density as element
    read   albedo_maps as sampled(surface_sampler)
    read   sun_shadow as sampled
    read   lamp_shadow as sampled
    read   memory.prev(1) as sampled(linear_clamp)
    write  inscatter as element
    write  extinction as element
    write  memory as element
    dispatch over froxels
  }
  pass integrate : compute queue compute may {
    block  "fog_integrate.glsl" group 8 8 1 scan z Stretch associative
    params camera
    params fog
    read   inscatter as element
    read   extinction as element
    write  scattered as element
    write  transmittance as element
    dispatch over froxels
  }
}

technique froxel_fog(params camera: View, params fog: Fog, buffer lights, buffer volumes, image albedo_maps, image sun_shadow,
    image lamp_shadow, inout image scattered, inout image transmittance)
{
  buffer cluster_volumes : u32[ceil(froxels / FOG_CLUSTER).area]
  buffer cluster_lights  : u32[ceil(froxels / FOG_CLUSTER).area * LIGHT_WORDS]
  image  density         : r16f froxels
  image  inscatter       : r11g11b10f froxels
  image  extinction      : r16f froxels
  image  memory          : rgba16f froxels history 1 init clear -1  // rgb: inscatter, a: extinction, negative where nothing is known

  use clusters = fog_clusters(camera, fog, lights, volumes, cluster_volumes, cluster_lights)
  use chain = fog_chain(camera, fog, lights, volumes, cluster_volumes, cluster_lights, albedo_maps, sun_shadow, lamp_shadow, density, inscatter,
      extinction, memory, scattered, transmittance)
}

// The same at the same ports in one kernel: groups walk their columns from near to far, and nothing is written but the sums and the history.
technique merged_fog(params camera: View, params fog: Fog, buffer lights, buffer volumes, image albedo_maps, image sun_shadow,
    image lamp_shadow, inout image scattered, inout image transmittance)
{
  buffer cluster_volumes : u32[ceil(froxels / FOG_CLUSTER).area]
  buffer cluster_lights  : u32[ceil(froxels / FOG_CLUSTER).area * LIGHT_WORDS]
  image  density         : r16f froxels
  image  inscatter       : r11g11b10f froxels
  image  extinction      : r16f froxels
  image  memory          : rgba16f froxels history 1 init clear -1

  use clusters = fog_clusters(camera, fog, lights, volumes, cluster_volumes, cluster_lights)
  fuse merged {
    use chain = fog_chain(camera, fog, lights, volumes, cluster_volumes, cluster_lights, albedo_maps, sun_shadow, lamp_shadow, density, inscatter,
        extinction, memory, scattered, transmittance)
  }
}
