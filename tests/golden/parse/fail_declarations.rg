modul broken
const = 4
const B
extent view runtime(1, 2)
strct View { }
sampler s { filtr linear }
state { }
feature f
set x { }
graph frame(params a) {
}
module again
module thrice
