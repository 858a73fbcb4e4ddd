// Vertices whose fiemds are packed.
module ver bone: r16uim }
extent size = runtime(3, 4)
struct Tight scalar { flags: r8ui  :  gba8[2]  f