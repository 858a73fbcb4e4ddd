// The frame of the demo: a courtyard under several hundred lights.
//
//   cull meshes ─ shadows ─ fog ─ depth ─ cull lights ─ G-buffer ─ shade ─ glass ─ expose ─ resolve ─ bloom ─ tone map
module frame

import "passes/view/view.rg"
import "passes/scene/scene.rg"
import "passes/geometry/geometry.rg"
import "passes/culling/culling.rg"
import "passes/lighting/lighting.rg"
import "passes/fog/fog.rg"
import "passes/post/post.rg"
import "passes/debug/debug.rg"

target vulkan 1.3
extent view = runtime(640, 360) max(3840, 2160)

feature holograms: bool  // removes a pass and nothing else: a condition of the one plan

graph frame(params camera: View, params fog: Fog, params lamps: LampViews, scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  // ---- what several passes take alike ---------------------------------------------------------------------------------
  bundle world {  // vertices are pulled
    read scene.instances as storage
    read scene.vertices as storage
    read scene.indices as storage
  }
  bundle props {
    read scene.props as vertex
    read scene.prop_indices as index
    draw host { per_draw PropDraw  vertex PropVertex }
  }
  bundle surfaces {
    read depth as sampled
    read albedo as sampled
    read normal as sampled
    read material as sampled
    read emissive as sampled
  }
  bundle shadow {
    read sun_shadow as sampled
    read lamp_shadow as sampled
  }
  bundle air {
    read scattered as sampled(linear_clamp)
    read transmittance as sampled(linear_clamp)
  }

  // ---- meshes -----------------------------------------------------------------------------------------------------
  buffer world_draws : DrawArguments[MAX_INSTANCES]
  buffer sun_draws   : DrawArguments[MAX_INSTANCES]
  buffer cull_counts : u32[4] readback

  buffer candidates : Candidate[MAX_INSTANCES]

  fuse mesh_cull {
    pass mesh_candidates : compute queue compute may {
      block  "passes/geometry/mesh_candidates.glsl"
      params camera
      read   scene.instances as storage
      write  candidate = candidates as element
      dispatch over MAX_INSTANCES
    }
    pass mesh_cull_world : compute queue compute may {
      block  "passes/geometry/mesh_cull_world.glsl"
      params camera
      read   candidate = candidates as element
      write  world_draw = world_draws as element
      atomic cull_counts as storage clear 0
      dispatch over MAX_INSTANCES
    }
    pass mesh_cull_sun : compute queue compute may {
      block  "passes/geometry/mesh_cull_sun.glsl"
      params camera
      read   candidate = candidates as element
      write  sun_draw = sun_draws as element
      atomic cull_counts as storage
      dispatch over MAX_INSTANCES
    }
  }

  // ---- sun shadow -------------------------------------------------------------------------------------------------
  image sun_shadow : d32f 1536x1536

  pass sun_shadow_world : raster {
    shader "passes/geometry/sun_world.vert"
    state  caster
    params camera
    with   world
    depth  sun_shadow clear 0.0
    draw   indirect sun_draws max MAX_INSTANCES
  }
  pass sun_shadow_props : raster {
    shader "passes/geometry/sun_props.vert"
    state  caster
    params camera
    with   props
    depth  sun_shadow
  }

  // ---- lamp shadows: kept until a lamp or what it shines on moves ---------------------------------------------------
  buffer lamp_draws  : DrawArguments[MAX_LAMP_SHADOWS * MAX_INSTANCES]
  image  lamp_shadow : d32f 256x256 layers MAX_LAMP_SHADOWS persistent init clear 0.0

  if host lamps_moved {
    pass lamp_cull : compute queue compute may {
      shader "passes/geometry/lamp_cull.comp" group 64 1 1
      params camera
      params lamps
      read   scene.instances as storage
      write  lamp_draws as storage
      dispatch over [MAX_INSTANCES, MAX_LAMP_SHADOWS]
    }
    for slot in 0..MAX_LAMP_SHADOWS {
      pass lamp_shadow_world[slot] : raster {
        shader "passes/geometry/lamp_world.vert"
        state  caster
        params lamps
        with   world
        depth  lamp_shadow.layer(slot) clear 0.0
        draw   indirect lamp_draws.bytes(slot * MAX_INSTANCES * 16, MAX_INSTANCES * 16) max MAX_INSTANCES
      }
    }
  }

  // ---- fog --------------------------------------------------------------------------------------------------------
  image scattered     : r11g11b10f froxels  // light of all fog in front of a place
  image transmittance : r16f froxels        // share of the light from behind it that comes through

  use froxel_fog = merged_fog(camera, fog, scene.lights, scene.fog_volumes, scene.albedo_maps, sun_shadow, lamp_shadow, scattered, transmittance)

  // ---- depth ------------------------------------------------------------------------------------------------------
  image depth : d32f view

  pass depth_world : raster {
    shader "passes/geometry/depth_world.vert"
    state  world_depth
    params camera
    with   world
    depth  depth clear 0.0
    draw   indirect world_draws max MAX_INSTANCES
  }
  pass depth_props : raster {
    shader "passes/geometry/depth_props.vert"
    state  world_depth
    params camera
    with   props
    depth  depth
  }

  image depth_range : rg32f ceil(view / TILE) mips DEPTH_MIPS  // least and greatest depth; mip 0: one texel a light tile

  pass depth_range_first : compute queue compute may {
    shader "passes/culling/depth_range_first.comp" group 8 8 1
    read   depth as sampled
    write  target = depth_range.mip(0) as storage
    dispatch over depth_range
  }
  for mip in 1..mips(depth_range) {
    pass depth_range_down[mip] : compute queue compute may {
      shader "passes/culling/depth_range_down.comp" group 8 8 1
      read   source = depth_range.mip(mip - 1) as sampled
      write  target = depth_range.mip(mip) as storage
      dispatch over depth_range.mip(mip)
    }
  }

  // ---- lights -----------------------------------------------------------------------------------------------------
  buffer zbin_min       : u32[ZBINS]
  buffer zbin_max       : u32[ZBINS]
  buffer zbins          : u32[ZBINS]                                  // first light in the low half, last in the high half
  buffer lights_seen    : u32[LIGHT_WORDS]                            // not hidden behind the depth pyramid
  buffer tile_lights    : u32[ceil(view / TILE).area * LIGHT_WORDS]   // that reach what is opaque in the tile
  buffer forward_lights : u32[ceil(view / TILE).area * LIGHT_WORDS]   // that reach anything in front of it
  buffer tile_records   : TileRecord[ceil(view / SHADE_TILE).area]
  buffer tile_features  : u32[ceil(view / SHADE_TILE).area] readback  // union of what the lamps of a record can do
  image  tile_kernels   : r32ui ceil(view / SHADE_TILE)               // which kernel of light_features shades the tile

  pass zbin_build : compute queue compute may {
    shader "passes/culling/zbin_build.comp" group 64 1 1
    params camera
    read   scene.lights as storage
    atomic zbin_min as storage clear 65535
    atomic zbin_max as storage clear 0
    dispatch groups MAX_LIGHTS
  }
  pass zbin_pack : compute queue compute may {
    shader "passes/culling/zbin_pack.comp" group 64 1 1
    read   zbin_min as storage
    read   zbin_max as storage
    write  zbins as storage
    dispatch over ZBINS
  }
  pass light_occlusion : compute queue compute may {
    shader "passes/culling/light_occlusion.comp" group 64 1 1
    params camera
    read   scene.lights as storage
    read   depth_range as sampled
    atomic lights_seen as storage clear 0
    dispatch over MAX_LIGHTS
  }
  pass light_cull : compute queue compute may {
    shader "passes/culling/light_cull.comp" group 64 1 1
    params camera
    read   scene.lights as storage
    read   lights_seen as storage
    read   bounds = depth_range.mip(0) as sampled
    write  tile_lights as storage
    write  forward_lights as storage
    dispatch groups ceil(view / TILE)
  }
  pass tile_cull : compute queue compute may {
    shader "passes/culling/tile_cull.comp" group 16 16 1
    params camera
    read   scene.lights as storage
    read   depth as sampled
    write  tile_records as storage
    write  tile_features as storage
    dispatch groups ceil(view / SHADE_TILE)
  }

  // ---- G-buffer ---------------------------------------------------------------------------------------------------
  image albedo   : rgba8 view  // a: share of the sky that is seen
  image normal   : rg16 view   // octahedral
  image material : rgba8 view  // roughness, metallic, bounced light, -
  image emissive : r11g11b10f view
  image velocity : rg16f view  // to last frame's place, in texture coordinates

  pass gbuffer_world : raster {
    shader "passes/geometry/gbuffer_world.vert" "passes/geometry/gbuffer_world.frag"
    state  world_equal
    params camera
    with   world
    read   scene.materials as storage
    read   scene.albedo_maps as sampled(surface_sampler)
    read   scene.surface_maps as sampled(surface_sampler)
    color  albedo clear 0
    color  normal clear 0
    color  material clear 0
    color  emissive clear 0
    color  velocity clear 0
    depth  depth readonly
    draw   indirect world_draws max MAX_INSTANCES
  }
  pass gbuffer_props : raster {
    shader "passes/geometry/gbuffer_props.vert" "passes/geometry/gbuffer_props.frag"
    state  world_equal
    params camera
    with   props
    color  albedo
    color  normal
    color  material
    color  emissive
    color  velocity
    depth  depth readonly
  }

  // ---- shading ----------------------------------------------------------------------------------------------------
  image occlusion : r16f view / 2
  image hdr       : rgba16f view

  pass ambient_occlusion : compute queue compute may {
    shader "passes/lighting/ambient_occlusion.comp" group 8 8 1
    params camera
    read   depth as sampled
    read   normal as sampled
    write  occlusion as storage
    dispatch over view / 2
  }
  pass deferred_light : compute queue compute may {
    shader "passes/lighting/deferred_light.comp" group 16 16 1
    spectrum light_features by tile_features into tile_kernels
    params camera
    params fog
    read   scene.lights as storage
    read   scene.albedo_maps as sampled(surface_sampler)
    read   tile_records as storage
    read   tile_lights as storage
    read   zbins as storage
    with   surfaces
    read   occlusion as sampled(linear_clamp)
    with   shadow
    with   air
    write  hdr as storage disjoint
    dispatch over view
  }
  pass transparent : raster {
    shader "passes/lighting/transparent.vert" "passes/lighting/transparent.frag"
    state  glass
    params camera
    params fog
    with   world
    read   scene.materials as storage
    read   scene.lights as storage
    read   scene.albedo_maps as sampled(surface_sampler)
    read   forward_lights as storage
    read   zbins as storage
    with   shadow
    with   air
    color  hdr blend add(src_alpha, one_minus_src_alpha)
    depth  depth readonly
    draw   host { per_draw GlassDraw }
  }
  when holograms {
    pass hologram : raster {  // pipelines of the host's own, built from PassInfo
      color  hdr blend add(one, one)
      depth  depth readonly
      draw   host { per_draw HologramDraw }
    }
  }

  image debug_image : rgba8 view
  pass debug_view : compute queue compute may {
    shader "passes/debug/debug_view.comp" group 8 8 1
    params camera
    params fog
    with   surfaces
    read   velocity as sampled
    read   occlusion as sampled(linear_clamp)
    read   hdr as sampled
    with   air
    read   tile_records as storage
    read   tile_features as storage
    read   tile_kernels as storage
    read   tile_lights as storage
    read   forward_lights as storage
    read   zbins as storage
    write  debug_image as storage
    dispatch over view
  }

  // ---- post -------------------------------------------------------------------------------------------------------
  buffer histogram : u32[HISTOGRAM_BINS]
  buffer exposure  : Exposure[1] history 1 init clear 0
  image  color     : rgba16f view history 1 init clear 0  // a: 1 where it holds a frame
  image  bloom     : rgba16f view / 2 mips BLOOM_MIPS

  pass luminance : compute queue compute may {
    shader "passes/post/luminance.comp" group 16 16 1
    features subgroup_sums
    read   hdr as sampled
    atomic histogram as storage clear 0
    dispatch over view / 2
  }
  pass expose : compute queue compute may {
    shader "passes/post/expose.comp" group 1 1 1
    params camera
    read   histogram as storage
    read   exposure.prev(1) as storage
    write  exposure as storage
    dispatch groups 1
  }
  pass resolve_temporal : compute queue compute may {
    shader "passes/post/resolve_temporal.comp" group 8 8 1
    params camera
    read   hdr as sampled
    read   depth as sampled
    read   velocity as sampled
    read   color.prev(1) as sampled(linear_clamp)
    write  color as storage
    dispatch over view
  }
  pass bloom_first : compute queue compute may {
    shader "passes/post/bloom_first.comp" group 8 8 1
    read   color as sampled(linear_clamp)
    write  target = bloom.mip(0) as storage
    dispatch over bloom
  }
  for mip in 1..mips(bloom) {
    pass bloom_down[mip] : compute queue compute may {
      shader "passes/post/bloom_down.comp" group 8 8 1
      read   source = bloom.mip(mip - 1) as sampled(linear_clamp)
      write  target = bloom.mip(mip) as storage
      dispatch over bloom.mip(mip)
    }
  }
  for step in 1..BLOOM_MIPS {
    pass bloom_up[step] : compute queue compute may {
      shader "passes/post/bloom_up.comp" group 8 8 1
      read   source = bloom.mip(BLOOM_MIPS - step) as sampled(linear_clamp)
      update target = bloom.mip(BLOOM_MIPS - 1 - step) as storage
      dispatch over bloom.mip(BLOOM_MIPS - 1 - step)
    }
  }
  pass tonemap : raster {
    fullscreen "passes/post/tonemap.frag"
    params camera
    read   color as sampled
    read   bloom = bloom.mip(0) as sampled(linear_clamp)
    read   exposure as storage
    read   debug_image as sampled
    color  backbuffer
  }
}
