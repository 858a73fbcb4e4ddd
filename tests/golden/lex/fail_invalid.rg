const A = 12abc
const B = "never closed
const C = $$$ 4
const D = été
