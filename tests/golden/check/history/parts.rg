module parts

const WEIGHTS = 7
private const WEIGHT_BYTES = 4
private struct Pair {
  a: u32
}
