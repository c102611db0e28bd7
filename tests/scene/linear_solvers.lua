-- pdas on all unknowns, its systems solved by a factor, by an incomplete one, by multigrid: the state of the condensed form, with friction that of newton.
local check <const> = require "check"

local S <const> = dotyk.solver
local material <const> = dotyk.material{ E = 1000, nu = 0.3 }
local function box(name, from, to, cells, element, force)
  return dotyk.body{ name = name, material = material, force = force, mesh = dotyk.mesh.box{ from = from, to = to, cells = cells, element = element } }
end

local scenes = {}
function scenes.oblique_punch()
  local b = box("b", {0, 0, 0}, {1, 1, 1}, {5, 5, 5})
  b:part"bottom":fix()
  local s = dotyk.scene{ b }
  s:contact{ b:part"top", rigid = dotyk.rigid.ball{ center = {0.4, 0.5, 1.48}, radius = 0.5 }, interference = true }
  return s
end
function scenes.two_that_do_not_match()
  local a, b = box("a", {0, 0, 0}, {1, 1, 0.5}, {6, 6, 3}), box("b", {0.1, 0.1, 0.5}, {0.9, 0.9, 1}, {5, 5, 3}, "Q1")
  a:part"bottom":fix()
  b:part"top":displace{ x = 0.01, y = 0, z = -0.05 }
  local s = dotyk.scene{ a, b }
  s:contact{ b:part"bottom", a:part"top" }
  return s
end
function scenes.free_block_on_glue_and_springs()
  local a, b = box("a", {0, 0, 0}, {1, 1, 0.5}, {4, 4, 2}), box("b", {0, 0, 0.5}, {1, 1, 1}, {4, 4, 2}, nil, {0, 0, -3})
  a:part"bottom":support{ normal = dotyk.law.elastic(40) }
  a:part"left":slide()
  a:part"front":slide()
  b:part"left":slide()
  b:part"front":slide()
  local s = dotyk.scene{ a, b }
  s:contact{ b:part"bottom", a:part"top" }
  return s
end
function scenes.plane_second_order()
  local b = dotyk.body{ name = "b", material = material, mesh = dotyk.mesh.rectangle{ from = {-1, -1}, to = {1, 0}, cells = {16, 8}, element = "P2" } }
  b:part"bottom":fix()
  local s = dotyk.scene{ b }
  s:contact{ b:part"top", rigid = dotyk.rigid.gap{ normal = {0, 1}, gap = function(x) return x^2 / 4 - 0.02 end }, interference = true }
  return s
end

local function with_friction(friction, element)
  local a, b = box("a", {0, 0, 0}, {1, 1, 0.5}, {4, 4, 2}, element), box("b", {0.1, 0, 0.5}, {0.9, 1, 1}, {3, 4, 2}, element)
  a:part"bottom":fix()
  b:part"front":slide()
  b:part"top":displace{ x = 0.02, z = -0.05 }
  local s = dotyk.scene{ a, b }
  s:contact{ b:part"bottom", a:part"top", friction = friction }
  return s
end
function scenes.coulomb() return with_friction(dotyk.friction.coulomb(0.3)) end
function scenes.given_friction() return with_friction(dotyk.friction.tresca(4)) end
function scenes.coulomb_on_bricks() return with_friction(dotyk.friction.coulomb(0.5), "Q1") end
function scenes.coulomb_in_the_plane()
  local b = dotyk.body{ name = "b", material = material, mesh = dotyk.mesh.rectangle{ from = {-1, -1}, to = {1, 0}, cells = {12, 6} } }
  b:part"bottom":displace{ x = 0.03, y = 0.02 }
  local s = dotyk.scene{ b }
  s:contact{ b:part"top", rigid = dotyk.rigid.gap{ normal = {0, 1}, gap = function(x) return x^2 / 4 end }, interference = true, friction = dotyk.friction.coulomb(0.4) }
  return s
end

-- Free to move: near the limit all points slip in some iterate, and nothing but their bounds holds the body.
function scenes.free_body_held_by_friction()
  local b = box("b", {0, 0, 0}, {1, 1, 1}, {3, 3, 3}, nil, { 0.45, 0, -1 })
  local s = dotyk.scene{ b }
  s:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0, 0}, normal = {0, 0, 1} }, friction = dotyk.friction.coulomb(0.5) }
  return s
end
-- Moved by its own size, strained by 1e-5 of it: what rounding leaves of gaps is no error. Of the energy, 7e-8, products of 1e3 with displacements of 1
-- leave some 1e-13.
function scenes.moved_far()
  local b = box("b", {0, 0, 0}, {1, 1, 1}, {3, 3, 3})
  b:part"top":displace{ x = 1, y = 0, z = -1e-5 }
  local s = dotyk.scene{ b }
  s:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0, 0}, normal = {0, 0, 1} }, friction = dotyk.friction.coulomb(0.3) }
  return s
end

local without, energies <const> = {}, { moved_far = 1e-5 }
for name, make in pairs(scenes) do
  local reference <const> = dotyk.solve(make())
  check.that(reference.converged, reference.reason)
  for _, linear in ipairs{ "factor", "incomplete_factor", "multigrid" } do
    local solver <const> = linear == "multigrid" and S.multigrid{} or S.pdas{ linear = linear }
    local there <const>, s <const> = pcall(solver.solve, solver, make())
    if there then
      check.that(s.converged, name .. ", " .. linear .. ": " .. s.reason)
      check.that(math.abs(s.energy / reference.energy - 1) < (energies[name] or 1e-9), ("%s, %s: energy %.15g, not %.15g"):format(name, linear, s.energy, reference.energy))
      local r <const> = s.residual
      check.that(r.equilibrium < 1e-9 and r.penetration < 1e-9, name .. ", " .. linear)
    else
      check.that(linear == "multigrid" and s:find("libpetsc-real-dev", 1, true), s)
      without[1] = "PETSc is absent: multigrid was not tried"
    end
  end
end
if without[1] then print(without[1]) end

-- A corner whose unknowns other rows have taken.
do
  local b <const> = dotyk.body{ name = "b", material = material, mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {2, 1}, cells = {4, 3} } }
  b:part"left":fix()
  b:part"top":load{ 0, -1 }
  b:part"right":support{ tangential = dotyk.friction.tresca(0.5) }
  local scene <const> = dotyk.scene{ b }
  scene:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0, -1}, normal = {0, 1} } }
  check.that(dotyk.solve(scene).converged, "newton")
  local solver <const> = S.pdas{ linear = "factor" }
  local solved <const>, said <const> = pcall(solver.solve, solver, scene)
  check.that(not solved and said:find("other rows have taken the unknowns there", 1, true), said)
end

-- One or the other.
local ok <const>, message <const> = pcall(S.pdas, { linear = "factor", reduced = true })
check.that(not ok and message:find("'linear' is given beside 'reduced'", 1, true), message)

-- Where iterations do not suffice, that is said.
do
  local long <const> = dotyk.body{ name = "long", material = dotyk.material{ E = 1000, nu = 0.4999 },
    mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 20}, cells = {6, 6, 6} } }
  long:part"bottom":fix()
  local scene <const> = dotyk.scene{ long }
  scene:contact{ long:part"top", rigid = dotyk.rigid.ball{ center = {0.5, 0.5, 20.49}, radius = 0.5 }, interference = true }
  local solver <const> = S.multigrid{}
  local solved <const>, said <const> = pcall(solver.solve, solver, scene)
  check.that(solved and said.converged or tostring(said):find("no solution of a linear system", 1, true) or tostring(said):find("libpetsc-real-dev", 1, true), said)
end
