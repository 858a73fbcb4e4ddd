// From light to a picture.
module post

const BLOOM_MIPS = 6
const HISTOGRAM_BINS = 128
struct Exposure { scale: f32  log_luminance: f32  target: f32  valid: f32 }
