module settings
sampler a { filter smooth  filter linear  anisotropy 64 }  //~ error[RG0117]: `filter` is set twice
//~^ error[RG0218]: 64 is not between 1 and 16
//~^^ error[RG0229]: `smooth` is no value of `filter`; known are `nearest`, `linear`
//~^^^ note[RG0118]: the first is here
state b { cull everything  topology lines  topology points }  //~ error[RG0117]: `topology` is set twice
//~^ error[RG0229]: `everything` is no value of `cull`; known are `none`, `front`, `back`
//~^^ note[RG0118]: the first is here
