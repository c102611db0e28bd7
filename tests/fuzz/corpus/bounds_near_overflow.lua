-- A program whose objective overflows had a residual that was no number; it is infinite.
local r <const> = dotyk.qp{ c = { 10, -0.1, -1 }, x_low = 1e308 }:solve{}
assert(r.residual.complementarity == r.residual.complementarity)
