// What `debug_view` can show.
module debug

const DEBUG_FINAL = 0
const DEBUG_LIGHTS = 1     // lights a tile of the bit array
const DEBUG_ALBEDO = 2
const DEBUG_NORMAL = 3
const DEBUG_DEPTH = 4
const DEBUG_ROUGHNESS = 5
const DEBUG_METALLIC = 6
const DEBUG_DIFFUSE = 7
const DEBUG_SPECULAR = 8
const DEBUG_EMISSIVE = 9
const DEBUG_OVERFLOW = 10  // tiles whose record dropped lights
const DEBUG_ZBIN = 11      // width of the pixel's z-bin
const DEBUG_OCCLUSION = 12
const DEBUG_VELOCITY = 13
const DEBUG_FORWARD = 14   // lights a tile offers to transparent surfaces
const DEBUG_FOG = 15       // light of the fog in front
const DEBUG_THROUGH = 16   // share of the light that comes through it
const DEBUG_FEATURES = 17  // how many features the lamps of a tile have between them
const DEBUG_KERNELS = 18   // which kernel of the spectrum shades the tile
const DEBUG_COUNT = 19
