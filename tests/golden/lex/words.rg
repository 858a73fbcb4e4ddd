// Every class of token once.
module words
const N = 0xFF  const R = 1.5e-3
image a : rgba8 1920x1080 // trailing
buffer b : u32[3] "path/with.dots" 2d 160x90x64
x -> y 1..mips(z) <= < == != >= > + - * / = . , ; ( ) { }
