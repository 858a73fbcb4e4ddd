// Shading.
module lighting

const LIGHT_PATH_RECORDS = 0  // deferred: the tile's record
const LIGHT_PATH_FLAT = 1     // the tile's bit array
const LIGHT_PATH_ZBIN = 2     // ... masked by the pixel's z-bin
const LIGHT_PATH_SLIDE = 3    // ... by the wider mask of the slides
const LIGHT_PATH_ALL = 4      // every light

state glass { cull none  depth test greater_equal  depth write off }
state lines { cull none  depth test greater_equal  depth write off  topology lines }
