// Habits from other languages.
module habits
const TILE = 8;  //~ error[RG0105]: expected a declaration, found `;`
const SIZE = 4
feature fog: bool
graph frame(surface backbuffer)  //~ error[RG0105]: expected `:` and the surface's format and size, found `)`
{
  when !fog { pass one : raster { color backbuffer clear 0 } }  //~ error[RG0105]: expected `not`, found `!`
  when fog { } else if fog { }  //~ error[RG0105]: expected `when` or `{`, found `if`
}
