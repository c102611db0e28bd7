-- Broken contact lines and surfaces with given friction: at the corner each side has its condition across, friction acts beside it, so that
-- forces are unique (B has full rank) and all methods find the same. With Coulomb friction, whose bound goes with the pressure of its own node,
-- and where two contacts meet in a corner, that is not so, and is said.
local check <const> = require "check"
local steel <const> = dotyk.material{ E = 2000, nu = 0.3 }

local function compare(scene, contact, about, unique)
  local first
  for _, name in ipairs{ "newton", "projected_cg", "psor", "uzawa_pdas" } do
    local s <const> = dotyk.solver[name]{ max_iterations = 20000, tol = 1e-12 }:solve(scene)
    check.that(s.converged and #s.warnings == (unique and 0 or 1), about .. " " .. name .. ": " .. (s.warnings[1] or s.reason))
    local c <const> = s:contact(contact)
    first = first or c
    check.near(c.force, first.force, 1e-6 * math.abs(first.max_pressure), about .. " " .. name)
    for k, node in ipairs(unique and c.nodes or {}) do
      check.near(node.force, first.nodes[k].force, 1e-6 * math.abs(first.max_pressure), about .. " " .. name)
      check.near(node.shear, first.nodes[k].shear, 1e-4 * math.abs(first.max_pressure), about .. " " .. name)
    end
  end
  return first
end

-- 1. A wedge in a notch.
local function fold(from, to)
  return dotyk.mesh.rectangle{ from = from, to = to, cells = { 8, 4 } }:transform(function(x, y) return x, y + math.abs(x) end)
end
for _, case in ipairs{ { "nodal", dotyk.friction.tresca(10), true }, { "P1-P0", dotyk.friction.tresca(10), true }, { "nodal", dotyk.friction.coulomb(0.5), false } } do
  local wedge <const> = dotyk.body{ name = "wedge", material = steel, mesh = fold({ -1, 0 }, { 1, 1 }) }
  local notch <const> = dotyk.body{ name = "notch", material = steel, mesh = fold({ -1, -1 }, { 1, 0 }) }
  notch:part"bottom":fix()
  wedge:part"top":displace{ x = 0.002, y = -0.02 }
  local scene <const> = dotyk.scene{ wedge, notch }
  local contact <const> = scene:contact{ wedge:part"bottom", notch:part"top", multipliers = case[1], friction = case[2] }
  local unique <const> = case[3]
  local c <const> = compare(scene, contact, "wedge, " .. case[1], unique)
  local tip = 0
  for _, node in ipairs(c.nodes) do
    if math.abs(node.x) < 1e-12 then tip = tip + 1 end
  end
  check.that(tip == 2 and c.stick + c.slip > 0)
  if unique then
    check.equal(contact:inf_sup{ part = "both" }.kernel, 0, case[1])
    check.that(contact:inf_sup{ part = "both", fixed_nodes = "kept" }.kernel > 0, case[1])
  end
end

-- 2. A cube in a corner of three faces.
do
  local frame <const> = dotyk.body{ name = "frame", material = steel,
    mesh = dotyk.mesh.box{ from = { 0, 0, 0 }, to = { 1, 1, 1 }, cells = { 6, 6, 6 } }:keep(function(x, y, z) return math.min(x, y, z) < 0.5 end, "legs") }
  local cube <const> = dotyk.body{ name = "cube", material = steel, mesh = dotyk.mesh.box{ from = { 0.5, 0.5, 0.5 }, to = { 1, 1, 1 }, cells = { 3, 3, 3 } } }
  for _, side in ipairs{ "left", "front", "bottom" } do frame:part(side):fix() end
  cube:part"top":load{ 1, 2, -20 }
  cube:part"right":load{ -15, 1, 0 }
  cube:part"back":load{ 0, -10, 0 }
  local scene <const> = dotyk.scene{ cube, frame }
  local contact <const> = scene:contact{ cube:part("corner", function(x, y, z) return math.min(x, y, z) < 0.5 + 1e-9 end), frame:part"legs",
    friction = dotyk.friction.tresca(2) }
  compare(scene, contact, "cube", true)
end

-- 3. The wedge's flanks as two contacts.
do
  local block <const> = dotyk.body{ name = "block", material = steel, mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { 4, 4 } } }
  block:part"top":load{ -2, -10 }
  block:part"right":load{ -10, -2 }
  local scene <const> = dotyk.scene{ block }
  for _, wall in ipairs{ { "left", { 1, 0 } }, { "bottom", { 0, 1 } } } do
    scene:contact{ block:part(wall[1]), rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = wall[2] }, friction = dotyk.friction.coulomb(0.9) }
  end
  local s <const> = dotyk.solve(scene)
  check.that(s.converged and #s.warnings == 1, s.reason)
  check.that(s.warnings[1]:find("at (0, 0) balance each other in part: pressure and shear there are not unique", 1, true), s.warnings[1])
end
