module names
import "modules/left.rg"
import "modules/right.rg"
import "modules/left.rg"  //~ warning[RG0005]: `modules/left.rg` is imported twice
const A = 1  //~ note[RG0202]: `A` is declared here
const A = 2  //~ error[RG0201]: `A` is declared twice
const QUALIFIED = left.SHARED + right.SHARED_TOO + left.NOTHING  //~ error[RG0203]: there is no constant called `NOTHING`
const SHARED = 3  //~ error[RG0201]: `SHARED` is declared twice
const WRONG_MODULE = lefft.SHARED  //~ error[RG0206]: no module called `lefft` is imported
const CYCLE = CYCLE_TOO  //~ error[RG0208]: `CYCLE` is declared by means of itself
const CYCLE_TOO = CYCLE
struct View { a: f32  a: f32  gl_position: vec4  up: vec33  far: f32[0]  open: f32[] }  //~ error[RG0201]: `a` is declared twice
//~^ error[RG0209]: there is no type called `vec33`
//~^^ error[RG0210]: field `open` needs a length: only the arrays of buffers may leave it open
//~^^^ error[RG0213]: `gl_position` is reserved in GLSL; call the field otherwise
//~^^^^ error[RG0218]: 0 is not between 1 and 16777216
//~^^^^^ note[RG0202]: `a` is declared here
//~^^^^^^ note[RG0605]: did you mean `vec3`?
struct Empty { }  //~ error[RG0211]: struct `Empty` has no fields
struct Loop { inner: Loop }  //~ error[RG0208]: `Loop` is declared by means of itself
struct Huge { a: mat4[16777216]  b: mat4[16777216]  c: mat4[16777216] }  //~ error[RG0212]: struct `Huge` is larger than 2 GiB
set materials 1 { }  //~ error[RG0230]: set `materials` must be number 0 or 2: the generated set of a pass is 1
graph frame(params constants: Vieww, scene: linear, surface s: rgba8 4x4, surface s: rgba8 4x4, other: View[0]) {  //~ error[RG0201]: `s` is declared twice
//~^ error[RG0203]: there is no struct called `Vieww`
//~^^ error[RG0204]: `linear` is a sampler, not an interface
//~^^^ error[RG0207]: expected the name of an interface
//~^^^^ note[RG0202]: `s` is declared here
  image a : rgba8 4x4  //~ note[RG0202]: `a` is declared here
  image a : rgba8 4x4  //~ error[RG0201]: `a` is declared twice
  pass p : compute { write A as storage  write aa as storage  params constans  read s as sampled(both) }  //~ error[RG0203]: there is no parameter block called `constans`
//~^ error[RG0203]: there is no resource called `aa`
//~^^ error[RG0204]: `A` is a constant, not a resource
//~^^^ error[RG0205]: `both` is declared by the modules `left` and `right`; say which
  pass p : compute { write s as storage }
}
sampler linear { filter linear }  //~ note[RG0202]: `linear` is declared here
