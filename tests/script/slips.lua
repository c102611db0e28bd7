-- Slips of the keyboard are errors at their line, with the nearest name.
local check <const> = require "check"
local refused <const> = require "refused"

local it <const> = refused.pressed_block()
local s <const> = it.solve()
refused.intact = it.solve
local body <const> = it.body

-- Names.
refused(function() return printt end, "unknown variable 'printt', did you mean 'print'?")
refused(function() local b = body return bodi end, "unknown variable 'bodi', did you mean 'body'?")
refused(function() return xyzzy_17 end, "unknown variable 'xyzzy_17'")
refused(function() dotyk.bdoy{} end, "dotyk: unknown field 'bdoy', did you mean 'body'?")
refused(function() dotyk.mesh.rectangel{} end, "dotyk.mesh: unknown field 'rectangel', did you mean 'rectangle'?")
refused(function() return body.nodecount end, "body: unknown field or method 'nodecount', did you mean 'node_count'?")
refused(function() return body:prat "top" end, "body: unknown field or method 'prat', did you mean 'part'?")
refused(function() return s.energie end, "solution: unknown field or method 'energie', did you mean 'energy'?")
refused(function() return s.residual.equilibrum end, "residual: unknown field 'equilibrum', did you mean 'equilibrium'?")
refused(function() return s.time.totl end, "time: unknown field 'totl', did you mean 'total'?")
refused(function() return s.history[1].activ end, "unknown field 'activ', did you mean 'active'?")
refused(function() return s:contact(it.contact).froce end, "contact result: unknown field 'froce', did you mean 'force'?")
refused(function() return s:contact(it.contact).nodes[1].presure end, "contact node: unknown field 'presure', did you mean 'pressure'?")
refused(function() return body[1] end, "body: the number 1 names no field or method of a body")
check.equal(s:contact(it.contact).nodes[100], nil)

-- Keys and types.
refused(function() dotyk.material{ E = 1, mu = 2 } end, "material: unknown key 'mu', did you mean 'nu'?")
refused(function() dotyk.body{ mesh = it.mesh, materiel = it.material } end, "body: unknown key 'materiel', did you mean 'material'?")
refused(function() dotyk.material{ E = "steel" } end, "'E' must be a number, a table of numbers or a function of the coordinates, got the string \"steel\"")
refused(function() dotyk.material(3) end, "expected a table of keys (E, nu, plane, stiffness and density), got the number 3")
refused(function() dotyk.material(nil) end, "got nil")
refused(function() dotyk.material{ 3 } end, "the number 3 given without a key")
refused(function() dotyk.material{ E = 1, plane = "stres" } end, "'plane' must be \"strain\" or \"stress\", got \"stres\", did you mean \"stress\"?")
refused(function() dotyk.body{ mesh = it.mesh } end, "missing key 'material' (what it is made of), or its value is nil")
refused(function() dotyk.body{ mesh = it.material, material = it.material } end, "'mesh': expected a mesh, got a material")
refused(function() dotyk.body{ name = 3, mesh = it.mesh, material = it.material } end, "'name' must be a string, got the number 3")
refused(function() it.top:fix("x", "y", "y", "x") end, "fix: takes 3 arguments, got 4")

-- Dot and colon, and fields that are not to be set.
refused(function() body.part "top" end, "part: expected a body before it, got the string \"top\" (write body:part with a colon, not a dot)")
refused(function() s.contact(it.contact) end, "expected a solution before it, got a contact (write solution:contact with a colon, not a dot)")
refused(function() dotyk:material{ E = 1 } end, "material: write dotyk.material with a dot, not a colon")
refused(function() body.name = "x" end, "body: its fields cannot be set")
refused(function() s.converged = true end, "solution: its fields cannot be set")
check.equal(body.name, "block")
