#define TWO(x) x + x
void main() { imageStore(lit, ivec2(0), vec4(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(TWO(1.0)))))))))))))))))))))))))))))))))))))))))); }
