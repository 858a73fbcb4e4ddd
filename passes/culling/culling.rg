// Which lights reach which pixels: depth pyramid, z-bins, bit arrays and the tile records of the deferred path.
module culling

const TILE = 8         // pixels, of the bit arrays
const SHADE_TILE = 16  // pixels, of the records
const DEPTH_MIPS = 8
const ZBINS = 8192
const ZBIN_NONE = 65535
const MAX_TILE_LIGHTS = 64

struct TileRecord {  // of one 16 x 16 tile
  count:    u32
  overflow: u32      // lights dropped: those with the highest indices
  light:    u32[64]  // ascending
}
