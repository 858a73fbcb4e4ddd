module right
const SHARED_TOO = 2
sampler both { filter linear }  //~ note[RG0202]: `right.both` is declared here
