-- What is called converged is a solution, measured by what drives the scene and by nothing of the answer: friction included, whatever the method
-- and its tolerance. What is a solution is called so, with springs that hold next to nothing and at the end of histories without load, too.
local that <const> = require("check").that

local function rotated(mesh, angle)
  local c <const>, s <const> = math.cos(angle), math.sin(angle)
  mesh:transform(function(x, y, z)
    if z then return c * x - s * z, y, s * x + c * z end
    return c * x - s * y, s * x + c * y
  end)
  return mesh
end
local function is_refused(scene, about)
  local ok <const>, s <const> = pcall(dotyk.solve, scene)
  that(not ok or not s.converged, about)
end

-- Two walls at a corner ask for what the support there does not allow.
for _, angle in ipairs{ 0.3, 0.6, 0.9 } do
  for _, mu in ipairs{ 0, 0.3, 1 } do
    for _, element in ipairs{ "Q1", "P1" } do
      local b <const> = dotyk.body{ mesh = rotated(dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {1, 1}, element = element }, angle), material = dotyk.material{ E = 1000, nu = 0.3 } }
      local friction <const> = mu > 0 and dotyk.friction.coulomb(mu) or nil
      b:part"right":spring{ x = 100, y = 100 }
      b:part"left":fix "y"
      local scene <const> = dotyk.scene{ b }
      local c <const>, s <const> = math.cos(angle), math.sin(angle)
      -- Along x the corner is to go back by 4e-4 / s, and the other wall leaves it 2e-4 / c.
      scene:contact{ b:part"bottom", rigid = dotyk.rigid.gap{ normal = { s, -c }, gap = -0.0004 }, friction = friction }
      scene:contact{ b:part"left", rigid = dotyk.rigid.gap{ normal = { -c, -s }, gap = 0.0002 }, friction = friction }
      is_refused(scene, ("walls at %g, friction %g, %s"):format(angle, mu, element))
    end
  end
end

-- A foot that slides obliquely, and a side whose displacement says otherwise.
for _, element in ipairs{ "P1", "Q1", "P2", "Q2" } do
  for _, angle in ipairs{ 0.3, 1.3, -1.1 } do
    for _, mu in ipairs{ 0, 0.3 } do
      local c <const>, s <const> = math.cos(angle), math.sin(angle)
      local b <const> = dotyk.body{ mesh = rotated(dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {1, 1, 1}, element = element }, angle), material = dotyk.material{ E = 1000, nu = 0.3 } }
      b:part"front":displace{ x = 3e-4, z = 7e-5 }
      if pcall(function() b:part"bottom":slide() end) then
        local scene <const> = dotyk.scene{ b }
        scene:contact{ b:part"top", rigid = dotyk.rigid.gap{ normal = { -s, 0, c }, gap = 0 }, friction = mu > 0 and dotyk.friction.coulomb(mu) or nil }
        is_refused(scene, ("slide at %g, friction %g, %s"):format(angle, mu, element))
      end
    end
  end
end

local function rubbed(friction)
  local b <const> = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {4, 1}, cells = {32, 8} }, material = dotyk.material{ E = 1000, nu = 0.3 } }
  b:part"top":displace{ y = -0.01, x = 0.004 }
  local scene <const> = dotyk.scene{ b }
  return scene, scene:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} }, friction = friction }
end

-- A rough tolerance gives a rough solution, by which the method is charted.
do
  local scene <const> = rubbed(dotyk.friction.tresca(1.2))
  local exact <const>, last = dotyk.solve(scene), math.huge
  for _, tol in ipairs{ 1e-1, 1e-2, 1e-3, 1e-5 } do
    local s <const> = dotyk.solver.uzawa{ tol = tol }:solve(scene)
    local off <const> = s:distance(exact).energy
    that(s.converged and s.residual.law <= tol, s.reason)
    that(off > 1e-4 * tol and off < last, ("%g: %g"):format(tol, off))
    last = off
  end
end

-- More digits than there are: as good as rounding allows, and not because of the tolerance.
for _, friction in ipairs{ dotyk.friction.tresca(1.2), dotyk.friction.coulomb(0.3) } do
  local s <const> = dotyk.solver.newton{ tol = 1e-30 }:solve((rubbed(friction)))
  that(s.converged and not s.reason:find("fell below tol", 1, true), s.reason)
end

-- Loaded, pushed to and fro, unloaded.
for _, element in ipairs{ "P1", "Q1", "P2" } do
  for _, way in ipairs{ { {1, 0}, {0, 0} }, { {1, 4}, {0, 0} }, { {1, 4}, {1, -4}, {0.5, 0}, {0, 0} }, { {1, 4}, {1e-9, 0} } } do
    local b <const> = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {-2, 0}, to = {2, 1}, cells = {12, 3}, element = element }, material = dotyk.material{ E = 1000, nu = 0.3 } }
    b:part"top":load({ 0, -10 }, "press")
    b:part"top":load({ 1, 0 }, "push")
    b:part"left":spring{ x = 30 }
    local scene <const>, steps <const> = dotyk.scene{ b }, {}
    local contact <const> = scene:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} }, friction = dotyk.friction.coulomb(0.3) }
    for k, step in ipairs(way) do steps[k] = { load = { press = step[1], push = step[2] } } end
    local s <const> = dotyk.solve(scene, { steps = steps })
    for _, step in ipairs(s.steps) do that(step.converged, step.reason) end
    that(s:contact(contact).max_pressure <= 30 * way[#way][1] + 1e-12)
  end
end

-- Thin strips on the ground, an end on a spring: each point of the ground bears what is above it.
for _, element in ipairs{ "P1", "P2" } do
  for _, height in ipairs{ 0.01, 0.003, 0.001 } do
    for _, mu in ipairs{ 0, 0.3 } do
      local b <const> = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {2, height}, cells = {10, 1}, element = element }, material = dotyk.material{ E = 1000, nu = 0.3 } }
      b:part"top":load{ 0, -1e-3 }
      b:part"left":spring{ x = 10, y = 10 }
      local scene <const> = dotyk.scene{ b }
      local contact <const> = scene:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} }, friction = mu > 0 and dotyk.friction.coulomb(mu) or nil }
      local s <const> = dotyk.solve(scene)
      that(s.converged, ("%s %g %g: %s"):format(element, height, mu, s.reason))
      for _, node in ipairs(s:contact(contact).nodes) do that(math.abs(node.pressure / 1e-3 - 1) < 2.5e-3, ("%s %g %g: %g"):format(element, height, mu, node.pressure)) end
    end
  end
end

-- Rows of glue and of contact at one node may bear great forces that balance each other. By whatever method: what is called converged has the energy that others find.
do
  local function box(name, E, nu, from, to, cells)
    return dotyk.body{ name = name, material = dotyk.material{ E = E, nu = nu }, mesh = dotyk.mesh.box{ from = {from, 0, 0}, to = {to, 0.7, 0.6}, cells = cells, element = "Q1" } }
  end
  local one <const>, soft <const>, other <const> = box("one", 2, 0, 0, 1, {1, 1, 1}), box("soft", 1e-5, 0.2, 0.962, 1.62, {1, 3, 3}), box("other", 1, 0.45, 1.6, 2.1, {1, 1, 1})
  local scene <const> = dotyk.scene{ one, soft, other }
  scene:glue{ one:part"right", soft:part"left" }
  scene:glue{ soft:part"right", other:part"left" }
  scene:contact{ other:part"bottom", rigid = dotyk.rigid.gap{ normal = {0, 0, -1}, gap = function(x) return 4e-8 * math.sin(4 * x + 0.2) end }, friction = dotyk.friction.coulomb(0.1) }
  soft:part"front":displace{ x = 2e-7, y = 1e-7, z = 7e-7 }
  other:part"right":spring{ x = 0.2, y = 0.2, z = 0.16 }
  local energy
  for _, name in ipairs{ "newton", "proximal", "psor", "coulomb_loop" } do
    local s <const> = dotyk.solver[name]{}:solve(scene)
    that(s.converged or name == "coulomb_loop", name .. ": " .. s.reason)
    energy = energy or s.energy
    that(not s.converged or math.abs(s.energy / energy - 1) < 1e-6, ("%s: %g for %g"):format(name, s.energy, energy))
  end
end

-- A tol that asks for nothing makes no state a solution.
do
  local b <const> = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {2, 1}, cells = {8, 4} }, material = dotyk.material{ E = 1000, nu = 0.3 } }
  b:part"top":load({0.2, -4})
  b:part"left":spring{ x = 10, y = 10 }
  local scene <const> = dotyk.scene{ b }
  scene:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0, -0.001}, normal = {0, 1} }, friction = dotyk.friction.tresca(0.05) }
  for _, method in ipairs{ dotyk.solver.uzawa{ tol = 1e9 }, dotyk.solver.psor{ tol = 100 }, dotyk.solver.psor{ tol = 1 } } do
    local s <const> = method:solve(scene)
    local off <const> = math.max(s.residual.equilibrium, s.residual.law, s.residual.penetration, s.residual.complementarity, s.residual.friction)
    that(s.converged == (off <= 0.1), ("%s: off by %g"):format(s.method, off))
  end
end

-- Along a plane bodies may slide as far as they like; on a curved side what lay across before the load is elsewhere, and a warning says so.
for _, far in ipairs{ 0.1, 10 } do
  for _, shape in ipairs{ dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} }, dotyk.rigid.ball{ center = {0.5, -50}, radius = 50 } } do
    local b <const> = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {4, 4} }, material = dotyk.material{ E = 1000, nu = 0.3 } }
    b:part"top":load({0, -0.1})
    b:part"left":displace{ x = far }
    local scene <const> = dotyk.scene{ b }
    scene:contact{ b:part"bottom", rigid = shape }
    local said <const> = table.concat(dotyk.solve(scene).warnings, "\n"):find("slides by", 1, true)
    that((said ~= nil) == (far > 1 and shape ~= nil and tostring(shape):find "ball" ~= nil), ("%s, %g: %s"):format(shape, far, said))
  end
end
