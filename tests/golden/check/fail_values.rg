module values
const A = 1 / 0  //~ error[RG0221]: division by zero
const B = 1.0 / 0.0  //~ error[RG0221]: division by zero
const C = 9223372036854775807 + 1  //~ error[RG0222]: the value does not fit 64 bits
const D = 4x4 * 4x4x4  //~ error[RG0220]: a size of 2 axes does not go with one of 3
const E = sqrt(2)  //~ error[RG0224]: there is no function called `sqrt`
const F = min(1)  //~ error[RG0225]: `min` does not take 1 arguments
const G = good.w  //~ error[RG0223]: there is no part called `w`
//~^ note[RG0605]: did you mean `x` or `y` or `z`?
const H = good * 0.5  //~ error[RG0219]: expected whole numbers, because extents are whole numbers
const I = ceil(good)  //~ error[RG0219]: expected a quotient, such as `ceil(view / 8)`
extent good = runtime(4, 4)
const J = [1, [2, 3], [4, 5]]  //~ error[RG0219]: expected a number
const K = Thing  //~ error[RG0204]: `Thing` is a struct, not a number or a size
extent view = runtime(4000, 10) max(3840, 2160)  //~ error[RG0227]: extent `view` starts at 4000, over its maximum of 3840
//~^ note[RG0228]: the maximum is here
extent odd = runtime(1, 2) max(3)  //~ error[RG0226]: extent `odd` has 2 axes, its maximum 1; it takes one to three
extent huge = runtime(100000)  //~ error[RG0218]: 100000 is not between 1 and 65536
extent part = runtime(1.5)  //~ error[RG0215]: expected a whole number
struct Thing { a: f32 }  //~ note[RG0202]: `Thing` is declared here
graph g(surface s: rgba8 4x4) {
  buffer a : u32[1.5]  //~ error[RG0215]: expected a whole number
  buffer b : u32[good]  //~ error[RG0215]: expected a whole number
  image c : rgba8 1.5  //~ error[RG0217]: expected a size
  image d : rgba8 [1.5, 2.5]  //~ error[RG0217]: expected a size
  buffer e : u32[4] persistent init clear good  //~ error[RG0216]: expected a number, or a list of numbers, known now
  for i in 0..good.x { }  //~ error[RG0214]: the value is not known before the program runs
  for i in 4..1 { }  //~ error[RG0232]: the range runs from 4 down to 1
  for i in 0..100000 { }  //~ error[RG0233]: the graph unrolls to more than 65536 loop bodies
  assert memory <= good.x  //~ error[RG0216]: expected a number, or a list of numbers, known now
  image wide : rgba8 goodxgood  //~ error[RG0203]: there is no constant, extent or resource called `goodxgood`
}
