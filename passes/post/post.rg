// From light to a picture.
module post

// Without it, shared memory does.
feature subgroup_sums: device subgroup_arithmetic

const BLOOM_MIPS = 6
const HISTOGRAM_BINS = 128
struct Exposure { scale: f32  log_luminance: f32  target: f32  valid: f32 }
