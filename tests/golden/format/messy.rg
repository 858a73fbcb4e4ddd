module messy
const    A=1   // one
const BBBB   = A+2*-3// two
struct View{a:f32
  long_name :vec3   // long
    x:u32[ 4 ]}
state  opaque {cull none   depth test less}
state  x { cull none }
set materials 0 {
   uniform   sampler2D a[16];   // kept
}
graph frame( params view_constants:View,
surface s : rgba8 4x4 )
{


image a:rgba8   4x4   // first
buffer bcd : u32[ 4 ]  // second

// a pass
pass p:compute queue compute   may{
read a as sampled
atomic bcd as storage clear 0 // cleared
dispatch over [4 , 4, 1]

}
for i in 0 .. 4 {
pass q[i] : compute { read   a . mip( 0 ) as sampled   write bcd as storage }
      }
}


