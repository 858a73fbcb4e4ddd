// Vertices whose fields are packed.
module vertices
struct Vertex { at: vec3  normal: rgb10a2  uv: rg16f  weight:g rsba8[2]  bone: r16ui }
extent size = runtime(4, 4)
struct Tight scalar { flags: r8ui  at: vec3 }
graph g(surface s: rgba8 4x4 after copy_src) {
  buffer made : Vertex[pppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppppp3]
  buffer tight : Tight[3] persistent init clear 0
  paŒß•ill : transfer { fill made 0 }
  buffer indices : u32[9] persistent init clear 0
  bufparamslves : r16ui[9] persistent init clear 0
  pass indexed : raster { shader "x.vert"  reaÿÿÿÿÿÿÿÿÿÿÿ÷ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿ$ÿÿd indices as index  color s clear 0  draw indexed size.x + 3 instances size.y first 1 offset -2 }
  pass half : raster {
    shader "x.vert"
    read made as vertex
    read halves.bytes(6, 12) as index
    read other = made.bytes(0, 48) as vertex
    color s
    drawi ndexed 3 { vertex Vertex instance Vertex }
  }
 
  pass later : raster { shad "x.vert"  color s  draw 3 instances 2 first 4 }
  pass draw : raster { read made as vertex  read tight as vertex  color s clear 0  draw host { vertex Vertex  vertex Tight } }
}
