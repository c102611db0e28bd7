-- Tutorial 3: two bodies in contact, what holds them, and why a scene may be refused.
--
--   ./dotyk scripts/tutorial/03_two_bodies.lua

local rubber <const>, steel <const> = dotyk.material{ E = 10, nu = 0.45 }, dotyk.material{ E = 210e3, nu = 0.3 }
local function block(name, y, material)
  return dotyk.body{ name = name, material = material, mesh = dotyk.mesh.rectangle{ from = { 0, y }, to = { 40, y + 10 }, cells = { 40, 10 } } }
end
local lower <const>, upper <const> = block("lower", 0, rubber), block("upper", 10, steel)
lower:part"bottom":fix()
upper:part"top":load(function(x) return 0, x < 20 and -0.2 or 0 end) -- a load may be a function of the place

-- Nodes of the two parts match here: one condition of non-penetration at each pair.
local scene <const> = dotyk.scene{ lower, upper }
local contact <const> = scene:contact{ upper:part"bottom", lower:part"top" }

-- Nothing holds the upper block but contact, and nothing at all holds it along x: dotyk says so instead of returning a number.
print(scene:balance())
upper:part"right":fix "x" -- along x only

local s <const> = dotyk.solve(scene)
print(s)
local c <const> = s:contact(contact)
assert(math.abs(c.force[2] - 0.2 * 20) < 1e-9) -- on the first part: it carries the whole load
print(("the upper block rests on %d of %d nodes"):format(c.closed, c.closed + c.open))

-- A pull cannot be carried. An error is caught as in any Lua program.
upper:part"top":load{ 0, 1 }
local ok <const>, why <const> = pcall(dotyk.solve, scene)
assert(not ok)
print("pulled up:", why)
print("wrote", s:render{ file = "images/tutorial_03.png", title = "A steel block on rubber, loaded on its left half", units = { length = "mm", stress = "MPa" }, deform = 1 })
