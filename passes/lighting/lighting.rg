// Shading.
module lighting

const LIGHT_PATH_RECORDS = 0  // deferred: the tile's record
const LIGHT_PATH_FLAT = 1     // the tile's bit array
const LIGHT_PATH_ZBIN = 2     // ... masked by the pixel's z-bin
const LIGHT_PATH_SLIDE = 3    // ... by the wider mask of the slides
const LIGHT_PATH_ALL = 4      // every light

// What the lamps of a tile can do between them: bit i is 1 << i of LAMP_*.
spectrum light_features {
  round_spots
  square_spots
  shadows
  soft_shadows requires shadows
  pictures
  areas
  tubes
  darkness
  clip_planes
  modes  8
  profile "plaza.spectrum.json"
}

state glass { cull none  depth test greater_equal  depth write off }
state lines { cull none  depth test greater_equal  depth write off  topology lines }
