-- Magnetic screws with given friction (TR965 2.2, 3.2): the forces of the exact kernel, wherever they are placed; refusals.
local check <const> = require "check"
local refused <const> = require "refused"

local function block(friction, multipliers, push)
  local body <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 2, 1 }, cells = { 8, 4 } } }
  body:part"top":load{ push or 0.8, -3 }
  local scene <const> = dotyk.scene{ body }
  return scene, scene:contact{ body:part"bottom", rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } }, friction = friction, multipliers = multipliers }
end

for _, multipliers in ipairs{ "nodal", "P1-P0" } do
  local scene <const>, contact <const> = block(dotyk.friction.tresca(1), multipliers)
  local exact <const> = dotyk.solver.newton{ tol = 1e-12 }:solve(scene)
  check.that(exact.converged and exact:contact(contact).slip > 0)
  for _, name in ipairs{ "newton", "uzawa_pdas", "projected_cg" } do
    local screws <const> = name == "projected_cg" and {} or { false, { 1, 2, 10 }, { 4, 9, 14 } }
    for _, rows in ipairs(screws) do
      local s <const> = dotyk.solver[name]{ tol = 1e-12, max_iterations = 5000, kernel = "screws", screws = rows or nil }:solve(scene)
      check.that(s.converged and s.residual.law < 1e-9, s.reason)
      check.that(#s.screws == s.screw_moves + 1 and #s.screws[1].rows == 3)
      for k, node in ipairs(s:contact(contact).nodes) do
        check.near(node.pressure, exact:contact(contact).nodes[k].pressure, 1e-8)
        check.near(node.shear, exact:contact(contact).nodes[k].shear, 1e-8)
      end
      check.near(s:distance(exact).displacement, 0, 1e-8)
    end
  end
end

-- A free cube in space, which turns and slips: screws that were placed where it slips move.
do
  local cube <const> = dotyk.body{ name = "cube", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.box{ from = { 0, 0, 0 }, to = { 1, 1, 1 }, cells = { 3, 3, 3 } } }
  cube:part"top":load{ 0.3, 0, -3 }
  local scene <const> = dotyk.scene{ cube }
  local contact <const> = scene:contact{ cube:part"bottom", rigid = dotyk.rigid.plane{ point = { 0, 0, 0 }, normal = { 0, 0, 1 } }, friction = dotyk.friction.tresca(1) }
  local exact <const> = dotyk.solver.newton{ tol = 1e-12 }:solve(scene)
  for _, name in ipairs{ "newton", "uzawa_pdas" } do
    local s <const> = dotyk.solver[name]{ tol = 1e-12, max_iterations = 5000, kernel = "screws" }:solve(scene)
    check.that(s.converged and s.screw_moves > 0 and #s.screws[1].rows == 6, s.reason)
    for k, node in ipairs(s:contact(contact).nodes) do
      check.near(node.pressure, exact:contact(contact).nodes[k].pressure, 1e-8)
      check.near(node.shear, exact:contact(contact).nodes[k].shear, 1e-8)
    end
  end
end

-- Two screws at one node, too few, and what they do not go with.
local scene <const> = block(dotyk.friction.tresca(1))
refused.intact = function() check.that(dotyk.solver.newton{ kernel = "screws" }:solve(scene).converged) end
refused(function() dotyk.solver.newton{ kernel = "screws", screws = { 1, 2 } }:solve(scene) end, "2 are given; this problem needs 3")
refused(function() dotyk.solver.newton{ kernel = "screws", screws = { 1, 2, 3 } }:solve(scene) end, "do not hold every rigid motion")
refused(function() dotyk.solver.newton{ kernel = "screws" }:solve((block(dotyk.friction.coulomb(0.5)))) end, "goes with given friction")
refused(function() dotyk.solver.uzawa_pdas{ unit = "report" }:solve((block(dotyk.friction.coulomb(0.5)))) end, "goes with given friction")
refused(function() dotyk.solver.newton{ kernel = "screws" }:solve((block(dotyk.friction.tresca(1), "nodal", 1.1))) end, "not held")
