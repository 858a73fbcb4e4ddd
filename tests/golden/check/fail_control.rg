module control
feature fog: bool
feature path: { low, high, low }  //~ error[RG0201]: `low` is declared twice
//~^ note[RG0202]: `low` is declared here
//~^^ note[RG0202]: `path` is declared here
technique loop(image a) { use loop(a) }  //~ error[RG0234]: technique `loop` is used more than 16 levels deep
//~^ note[RG0452]: `loop` is used here
technique one(image a, buffer b) { }  //~ note[RG0202]: `one` is declared here
technique wants(surface s: rgba8 4x4) { }  //~ error[RG0236]: parameter `s` is of a kind that only graphs take; a technique takes `image`, `buffer`, `params` and `const`
graph g(image a, surface s: rgba8 4x4) {  //~ error[RG0235]: parameter `a` is of a kind that only techniques take
  image x : rgba8 4x4
  buffer y : u32[4]
  image z[0] : rgba8 4x4
  when path { }  //~ error[RG0231]: feature `path` has several values: compare it with one of them
  when path == hihg { }  //~ error[RG0203]: there is no value of feature `path` called `hihg`
  when fogg { }  //~ error[RG0203]: there is no feature called `fogg`
  if host missed { }  //~ error[RG0203]: there is no condition called `missed`
  use loop(x)  //~ note[RG0452]: `loop` is used here
  use one(x)  //~ error[RG0225]: `one` does not take 1 arguments
  use one(y, x)  //~ error[RG0237]: `y` is a buffer; parameter `a` takes an image
  use wants(s)
  use nothing(x)  //~ error[RG0203]: there is no technique called `nothing`
  pass p : compute { write z as storage }  //~ error[RG0239]: `z` is declared with an index: say which one
  pass q : compute { write x[0] as storage }  //~ error[RG0240]: `x` is declared without an index
  pass r : compute { write z[1] as storage }  //~ error[RG0241]: `z` has no element 1

  pass u : compute { write s as storage  after late  after p }  //~ error[RG0246]: pass `u` runs after `late`, and no earlier pass is called that
  pass late : compute { write s as storage }
}
