-- E and nu of a material made of functions are absent; they were not-a-number.
local m <const> = dotyk.material{ E = function(x) return 1 + x end, nu = function() return 0.3 end }
assert(m.E == nil and m.nu == nil)
