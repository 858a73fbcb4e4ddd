// `allow`: which codes are no warnings, and how far one reaches.
module allowed
allow RG9999  //~ warning[RG0260]: `allow RG9999` silences nothing: no diagnostic has this code
allow RG0301  //~ warning[RG0260]: `allow RG0301` silences nothing: it is an error, and errors are mended
allow RG0202  //~ warning[RG0260]: `allow RG0202` silences nothing: it is a note that goes with others
allow UnusedResource  //~ warning[RG0260]: `allow UnusedResource` silences nothing: no diagnostic has this code
graph g(surface s: rgba8 4x4)
{
  image spare   : rgba8 4x4 allow RG0388
  image spare_2 : rgba8 4x4  //~ warning[RG0388]: `spare_2` is never used
  image wide    : rgba8 8*8  //~ warning[RG0261]: image `wide` has one axis of 64 texels; two axes are written `8x8`
  image line    : rgba8 8*8 1d
  pass p : compute { write s as storage  write wide as storage  write line as storage }
}
graph h(surface s: rgba8 4x4)
{
  allow RG0388
  image spare   : rgba8 4x4
  image spare_2 : rgba8 4x4
  pass p : compute { write s as storage }
}
