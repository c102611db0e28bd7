-- Bodies that have nothing to do with one another, or hardly anything: what is small on one of them is not for the other, whose state must be
-- the one that it has alone.
local check <const> = require "check"

local floor <const> = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} }

local function uneven()
  local b <const> = dotyk.body{ name = "small", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = {3, 0}, to = {7, 1}, cells = {16, 4}, element = "Q1" } }
  b:part "top":load(function(x) return 0, -(1 + 2 * math.sin(2 * x)) end)
  b:part "left":fix "x"
  return b
end
local function state(bodies, small)
  local scene <const> = dotyk.scene(bodies)
  local contacts <const> = {}
  for k, body in ipairs(bodies) do contacts[k] = scene:contact{ body:part "bottom", rigid = floor } end
  local s <const> = dotyk.solve(scene)
  check.that(s.converged, s.reason)
  local _, uy <const> = s:displacement(small, 5, 0.5)
  return uy, s:contact(contacts[#contacts]).closed
end

local alone <const> = uneven()
local uy <const>, closed <const> = state({ alone }, alone)
for _, ratio in ipairs{ 1e6, 5e8, 1e10 } do
  local big <const>, small <const> = dotyk.body{ name = "big", material = dotyk.material{ E = 1000 * ratio, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {4, 4}, element = "Q1" } }, uneven()
  big:part "top":load{ 0, -ratio }
  big:part "left":fix "x"
  local other, count = state({ big, small }, small)
  check.near(other, uy, 1e-9 * math.abs(uy))
  check.that(count == closed)
end

-- A method that ran out of iterations has not converged, whatever tolerance was asked for.
local scene <const> = dotyk.scene{ alone }
local contact <const> = scene:contact{ alone:part "bottom", rigid = floor, friction = dotyk.friction.coulomb(0.3) }
for _, method in ipairs{ "psor", "projected_cg", "uzawa" } do
  check.that(not dotyk.solver[method]{ tol = 1e-3, max_iterations = 2 }:solve(scene).converged)
  check.that(dotyk.solver[method]{ tol = 1e-3 }:solve(scene).converged)
end
