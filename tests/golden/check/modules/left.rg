module left
const SHARED = 1  //~ note[RG0202]: `SHARED` is declared here
sampler both { filter linear }  //~ note[RG0202]: `left.both` is declared here
