-- A solution is of the scene as it was: what is added to the scene later changes nothing in it.
local check <const> = require "check"
local refused <const> = require "refused"

local it <const> = refused.pressed_block()
local s <const> = it.solve()
local file <const> = os.tmpname()

it.top:load{ 0, -4 }
it.body:part("half", function(x, y, nx, ny) return ny < 0 and x < 0.5 end):fix "y"
it.body:part("lean", function(x, y, nx, ny) return nx > 0 end):spring{ x = 3 }
local late <const> = it.scene:contact{ it.right, rigid = dotyk.rigid.plane{ point = {1,0}, normal = {-1,0} } }

check.near(s.energy, -0.05)
check.near(s:contact(it.contact).force, { 0, 1 })
check.near({ s:reaction(it.left) }, { 0, 0 })
check.near({ s:reaction(it.body:part("half", function(x, y, nx, ny) return ny < 0 and x < 0.5 end)) }, { 0, 0 })
check.that(tostring(s):find("force (0, 1)", 1, true), tostring(s))
refused(function() s:contact(late) end, "is not part of the scene that was solved")
s:write_contact(file)
s:write(file .. ".vtu")
s:render{ file = file .. ".png", supports = true, loads = true, size = { 320, 240 } }
for _, ending in ipairs{ "", ".vtu", ".png" } do os.remove(file .. ending) end
-- Solved anew, all of it counts.
local again <const> = dotyk.solve(it.scene)
check.near(again:contact(it.contact).force[2] + select(2, again:reaction(it.body:part("half", function(x, y, nx, ny) return ny < 0 and x < 0.5 end))), 5)
check.equal(#again:contact(late).nodes, 3)

-- A mesh moved after its body was made is another mesh.
it.mesh:transform(function(x, y) return 2 * x, y end)
check.near({ s:displacement(it.body, 1, 1) }, { 0, -0.1 })
check.error(function() s:displacement(it.body, 1.5, 1) end, "lies outside 'block' at rest")

-- Also while the solve runs: what on_iteration adds is for the next one.
local other <const> = refused.pressed_block()
local during <const> = dotyk.solver.pdas{ on_iteration = function()
  other.scene:contact{ other.right, rigid = dotyk.rigid.plane{ point = {1,0}, normal = {-1,0} } }
  other.top:load{ 0, -1 }
  other.right:slide()
  dotyk.solve(other.scene)
end }:solve(other.scene)
check.near(during.energy, -0.05)
check.near(during:contact(other.contact).force, { 0, 1 })
check.near({ during:reaction(other.right) }, { 0, 0 })

-- Parts of one name, chosen by different functions, have their own reactions.
local b <const> = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {4,4} },
                              material = dotyk.material{ E = 10, nu = 0 } }
local function foot(inside) return b:part("foot", function(x, y, nx, ny) return ny < 0 and inside(x) end) end
local one <const>, two <const> = foot(function(x) return x < 0.3 end), foot(function(x) return x > 0.8 end)
one:fix()
two:fix()
b:part "top":load{ 0, -1 }
local feet <const> = dotyk.solve(dotyk.scene{ b })
local _, left = feet:reaction(one)
local _, right = feet:reaction(two)
check.near(left + right, 1)
check.that(left > 0.1 and right > 0.1, left)
