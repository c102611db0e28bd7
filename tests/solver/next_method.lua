-- A method that fails names another one to try: one that can treat the scene, has not failed and was not tried.
local check <const> = require "check"

local known <const> = { pdas = true, proximal = true, newton = true, projected_cg = true, psor = true }
local function named(s, name)
  check.that(not s.converged, name)
  local next <const> = s.reason:match "a method to try next: ([%a_]+)"
  check.that(known[next] and next ~= name and not s.reason:find("tried " .. next, 1, true), name .. ": " .. s.reason)
  return next
end

-- 1. A disc that rolls out of a V: several methods fail, one solves.
local function disc()
  local b = dotyk.body{ name = "d", mesh = dotyk.mesh.disc{ center = {0,0}, radius = 1, cells = 8 }, material = dotyk.material{ E = 1000, nu = 0.3 },
                        force = { math.cos(math.rad(-146)), math.sin(math.rad(-146)) } }
  local scene, r = dotyk.scene{ b }, math.sqrt(2)
  for side, n in pairs{ l = 1, r = -1 } do
    scene:contact{ b:part(side, function(_, _, nx, ny) return n * nx < 0 and ny < 0.3 end), friction = dotyk.friction.coulomb(0.2),
                   rigid = dotyk.rigid.plane{ point = {0, -r}, normal = {n / r, 1 / r} } }
  end
  return scene
end
for _, name in ipairs{ "psor", "coulomb_loop", "uzawa", "uzawa_pdas" } do named(dotyk.solver[name]{}:solve(disc()), name) end

-- 2. Methods that are given too few iterations.
local function punch(friction)
  local b = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {4,1}, cells = {16,4} }, material = dotyk.material{ E = 1000, nu = 0.3 } }
  b:part"top":load(function(x) return 0.3, x < 2 and -20 or 8 end)
  b:part"left":fix"x"
  local scene = dotyk.scene{ b }
  scene:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} }, friction = friction }
  return scene
end
for _, name in ipairs{ "pdas", "proximal", "psor", "uzawa", "projected_cg" } do
  local s <const> = dotyk.solver[name]{ max_iterations = 1 }:solve(punch())
  check.equal(named(s, name), name == "pdas" and "proximal" or "pdas")
end
for _, name in ipairs{ "newton", "proximal", "psor", "uzawa", "uzawa_pdas", "feti" } do
  local s <const> = dotyk.solver[name]{ max_iterations = 1 }:solve(punch(dotyk.friction.tresca(1)))
  check.equal(named(s, name), name == "proximal" and "newton" or "proximal")
end

-- 3. Whoever stops a method is not told to take another.
local stopped <const> = dotyk.solver.psor{ on_iteration = function() return false end }:solve(punch())
check.that(not stopped.converged and not stopped.reason:find("to try next", 1, true), stopped.reason)
