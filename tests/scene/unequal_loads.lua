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
local function made(bodies, friction)
  local scene <const> = dotyk.scene(bodies)
  local contacts <const> = {}
  for k, body in ipairs(bodies) do contacts[k] = scene:contact{ body:part "bottom", rigid = floor, friction = friction } end
  return scene, contacts[#contacts]
end
local function big(ratio)
  local b <const> = dotyk.body{ name = "big", material = dotyk.material{ E = 1000 * ratio, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {4, 4}, element = "Q1" } }
  b:part "top":load{ 0, -ratio }
  b:part "left":fix "x"
  return b
end

local alone <const> = uneven()
for _, friction in ipairs{ false, dotyk.friction.coulomb(0.3) } do
  local function state(bodies)
    local scene <const>, contact <const> = made(bodies, friction or nil)
    local s <const> = dotyk.solve(scene)
    check.that(s.converged, s.reason)
    local _, uy <const> = s:displacement(bodies[#bodies], 5, 0.5)
    return uy, s:contact(contact).closed, scene:balance()
  end
  local uy <const>, closed <const>, balance <const> = state{ alone }
  for _, ratio in ipairs{ 1e6, 5e8, 1e12 } do
    local other, count, both = state{ big(ratio), uneven() }
    check.near(other, uy, 1e-8 * math.abs(uy))
    check.that(count == closed)
    check.that(both.limit == balance.limit and both.solvable == balance.solvable)
  end
end

-- A body that is pulled away is not held by what rounding leaves of another's load.
for _, ratio in ipairs{ 1, 1e9, 1e11, 1e14 } do
  local pulled <const> = dotyk.body{ name = "pulled", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = {3, 0}, to = {7, 1}, cells = {4, 1}, element = "Q1" }, force = {0, 0.25} }
  pulled:part "left":fix "x"
  local scene <const> = made{ big(ratio), pulled }
  for _, method in ipairs{ "pdas", "newton", "interior_point" } do
    local ok, message = pcall(function() return dotyk.solver[method]{}:solve(scene) end)
    check.that(not ok and message:find("nothing stops 'pulled': translation along y; the load does work 1 ", 1, true), message)
  end
end

-- A method that ran out of iterations has not converged, whatever tolerance was asked for.
local scene <const> = dotyk.scene{ alone }
local contact <const> = scene:contact{ alone:part "bottom", rigid = floor, friction = dotyk.friction.coulomb(0.3) }
for _, method in ipairs{ "psor", "projected_cg", "uzawa" } do
  check.that(not dotyk.solver[method]{ tol = 1e-3, max_iterations = 2 }:solve(scene).converged)
  check.that(dotyk.solver[method]{ tol = 1e-3 }:solve(scene).converged)
end
