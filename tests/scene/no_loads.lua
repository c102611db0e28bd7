-- Bodies that nothing loads and contact alone holds: what overlaps moves out of the way, without force.
local check <const> = require "check"

local steel <const> = dotyk.material{ E = 1000, nu = 0.3 }
local S <const> = dotyk.solver
local methods <const> = { S.pdas{}, S.pdas{ reduced = false }, S.pdas{ kernel = "screws" }, S.active_set{} }

local function free(dimension)
  local mesh = dimension == 2 and dotyk.mesh.rectangle{ from = {-0.5,0}, to = {0.5,1}, cells = {6,6} }
               or dotyk.mesh.box{ from = {-0.5,-0.5,0}, to = {0.5,0.5,1}, cells = {3,3,3} }
  local b = dotyk.body{ mesh = mesh, material = steel }
  return b, dotyk.scene{ b }
end
local function up(dimension, sign) return dimension == 2 and { 0, sign } or { 0, 0, sign } end

-- A punch that overlaps, a floor that touches, one that is apart and one that overlaps.
local function punch(dimension)
  local b, scene = free(dimension)
  local function gap(x, y) return x^2 + (dimension == 3 and y^2 or 0) - 0.01 end
  return b, scene, scene:contact{ b:part "top", rigid = dotyk.rigid.gap{ normal = up(dimension, 1), gap = gap } }
end
local function floor(height)
  return function(dimension)
    local b, scene = free(dimension)
    return b, scene, scene:contact{ b:part "bottom", interference = true, rigid = dotyk.rigid.plane{ point = up(dimension, height), normal = up(dimension, 1) } }
  end
end

for dimension = 2, 3 do
  for _, make in ipairs{ punch, floor(0), floor(-0.3), floor(0.1) } do
    for k = 0, #methods do
      local b, scene, contact = make(dimension)
      local s = k == 0 and dotyk.solve(scene) or methods[k]:solve(scene)
      check.that(s.converged, s.reason)
      check.that(s.reason:find("unique up to", 1, true), s.reason)  -- what is still free to move is named
      check.that(s.residual.equilibrium < 1e-6 and s.residual.complementarity < 1e-6)
      for _, force in ipairs(s:contact(contact).force) do check.near(force, 0, 1e-9) end
      for _, node in ipairs(s:contact(contact).nodes) do check.that(node.gap > -1e-12) end
    end
  end
end

-- A method that ends at a tolerance may have no scale to end by; it says so.
for dimension = 2, 3 do
  for _, method in ipairs{ S.feti{}, S.interior_point{} } do
    for _, make in ipairs{ punch, floor(0.1) } do
      local _, scene = make(dimension)
      local s = method:solve(scene)
      check.that(s.converged or s.reason:find("no load gives forces a scale: if they should vanish, take pdas", 1, true), s.reason)
    end
  end
end

-- Friction without a load, by its own default method.
local b <const>, scene <const> = free(2)
scene:contact{ b:part "bottom", rigid = dotyk.rigid.plane{ point = {0,0.1}, normal = {0,1} }, interference = true, friction = dotyk.friction.coulomb(0.3) }
check.that(dotyk.solve(scene).converged)

-- A press fit has forces though it has no loads, and they are in equilibrium to rounding.
local held <const>, fit <const> = free(2)
held:part "bottom":fix()
local pressed <const> = fit:contact{ held:part "top", rigid = dotyk.rigid.gap{ normal = {0,1}, gap = -0.01 } }
local s <const> = dotyk.solve(fit)
check.that(s.converged and s.residual.equilibrium < 1e-13 and s:contact(pressed).force[2] < -9)
