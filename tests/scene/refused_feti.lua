-- Options of FETI that no solution comes of: refused where they are given.
local refused <const> = require "refused"

-- Beyond 1e10 times ‖PFP‖ the penalty leaves no digit of the rest; it ended as "no convergence".
refused(function() dotyk.solver.feti{ rho = 1e10 } end, "'rho' must be a number above 0 and below 1e+10")
refused(function() dotyk.solver.feti{ rho = 0 } end, "'rho' must be a number above 0")
