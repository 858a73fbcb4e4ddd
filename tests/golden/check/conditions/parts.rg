module parts

const WEIGHTS = 7
private const WEIGHT_BYTES = 4  //~ note[RG0202]: `WEIGHT_BYTES` is declared here
private struct Pair {  //~ note[RG0202]: `Pair` is declared here
  a: u32
}
