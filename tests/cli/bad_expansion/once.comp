#define LIST(X) X(red) X(green) X(blue)
#define DECLARE(name) float name##_weight() { return 0.25; }
#define SQUARE(x) ((x) * (x))
#define POWER SQUARE
#define lit lit
LIST(DECLARE)
#if SQUARE(2) == 4
#define HALF (1.0 / 2.0)
#endif
void main() { imageStore(lit, ivec2(0), vec4(red_weight() + POWER(SQUARE(HALF)), green_weight(), blue_weight(), 1.0)); }
