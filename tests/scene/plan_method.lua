-- The plan names the method that solves the scene where none is named.
local function block(name)
  return dotyk.body{ name = name, material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {3, 3} } }
end
local floor <const> = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} }
local function on_floor(friction)
  return function(b, scene)
    b:part"left":fix "x"
    scene:contact{ b:part"bottom", rigid = floor, friction = friction }
  end
end
local function with_support(laws)
  return function(b)
    b:part"bottom":fix()
    b:part"right":support(laws)
  end
end
local cases <const> = {
  ["no rows"] = { "one linear solve", function(b) b:part"bottom":fix() end },
  ["law.load"] = { "one linear solve", with_support{ normal = dotyk.law.load(1) } },
  ["law.free"] = { "one linear solve", with_support{ normal = dotyk.law.free() } },
  ["law.friction(0)"] = { "one linear solve", with_support{ tangential = dotyk.law.friction(0) } },
  ["law.friction"] = { "newton", with_support{ tangential = dotyk.law.friction(1) } },
  ["law.elastic"] = { "pdas", with_support{ normal = dotyk.law.elastic(10) } },
  ["contact on a fixed part"] = { "one linear solve", function(b, scene)
    b:part"bottom":fix()
    scene:contact{ b:part"bottom", rigid = floor }
  end },
  ["frictionless"] = { "pdas", on_floor() },
  ["coulomb(0)"] = { "pdas", on_floor(dotyk.friction.coulomb(0)) },
  ["tresca(0)"] = { "pdas", on_floor(dotyk.friction.tresca(0)) },
  ["tresca(math.huge)"] = { "pdas", on_floor(dotyk.friction.tresca(math.huge)) },
  ["coulomb"] = { "newton", on_floor(dotyk.friction.coulomb(0.1)) },
  ["tresca"] = { "newton", on_floor(dotyk.friction.tresca(0.1)) },
}
local names <const> = { ["one linear solve"] = "linear" }
for name, case in pairs(cases) do
  local b = block "block"
  local scene = dotyk.scene{ b }
  case[2](b, scene)
  b:part"top":load{ 0, -1 }
  local said = scene:plan():match "method: ([^\n]*)"
  assert(said:find(case[1], 1, true) == 1, ("%s: the plan says %s"):format(name, said))
  local used = dotyk.solve(scene).method
  assert(used == (names[case[1]] or case[1]), ("%s: solved by %s"):format(name, used))
end

-- Where it is worth a word: on how many rows, how much work and memory. The prediction is that of the orderings, alike on every machine but for METIS's version.
local n <const> = 15
local cube <const> = dotyk.body{ mesh = dotyk.mesh.box{ from = { 0, 0, 0 }, to = { 1, 1, 1 }, cells = { n, n, n } }, material = dotyk.material{ E = 210, nu = 0.3 } }
cube:part"bottom":fix()
local pressed <const> = dotyk.scene{ cube }
pressed:contact{ cube:part"top", rigid = dotyk.rigid.gap{ normal = { 0, 0, 1 }, gap = function(x, y) return (x - 0.5)^2 + (y - 0.5)^2 - 0.02 end } }
local rows <const>, gigaflop <const>, megabytes <const> = pressed:plan():match "first on the (%d+) rows that overlap, some (%d+) Gflop, %d+ s on a core, and (%d+) MB"
assert(rows == "16" and tonumber(gigaflop) >= 2 and tonumber(gigaflop) <= 10 and tonumber(megabytes) >= 30 and tonumber(megabytes) <= 120, pressed:plan())
local solved <const> = dotyk.solve(pressed)
assert(solved.converged and solved.rows == (n + 1)^2)

-- Glue has one branch: one linear solve with its rows held.
local function brick(name, low, cells)
  return dotyk.body{ name = name, material = dotyk.material{ E = 210, nu = 0.3 },
    mesh = dotyk.mesh.box{ from = { 0, 0, low }, to = { 1, 1, low + 1 }, cells = { cells, cells, 2 } } }
end
local lower <const>, upper <const> = brick("lower", 0, 7), brick("upper", 1, 8)
lower:part"bottom":fix()
upper:part"top":load{ 0, 0.1, -1 }
local glued <const> = dotyk.scene{ lower, upper }
glued:glue{ upper:part"bottom", lower:part"top" }
assert(glued:plan():find("one sparse factorisation an iteration (reduced = false): its 243 rows", 1, true), glued:plan())
local one_solve <const> = dotyk.solve(glued)
assert(one_solve.converged and one_solve.method == "pdas (held)" and one_solve.iterations == 1)

-- A large solid of which many rows close: multigrid, where it is installed; both estimates are said.
local slab <const> = dotyk.body{ mesh = dotyk.mesh.box{ from = { 0, 0, 0 }, to = { 3, 3, 1 }, cells = { 38, 38, 12 } }, material = dotyk.material{ E = 210, nu = 0.3 } }
slab:part"bottom":fix()
slab:part"top":load{ 0, 0, 3 }
local under <const> = dotyk.scene{ slab }
local stop <const> = under:contact{ slab:part"top", rigid = dotyk.rigid.gap{ normal = { 0, 0, 1 }, gap = function() return 0.005 end } }
local said <const> = under:plan()
local petsc <const> = select(2, pcall(function() return dotyk.solver.multigrid{}:solve(under).converged end)) == true
if petsc then
  assert(said:find("multigrid on all", 1, true) and said:find("some %d+%.?%d? s on a core and %d+ MB, where factors would take some %d+%.?%d? s on a core and %d+ MB"), said)
  local s <const> = dotyk.solve(under)
  assert(s.converged and s.method == "multigrid" and s.ordering:find("geometric multigrid", 1, true), s.ordering)
  -- What the stop bears and what the bottom bears carry the load of 27.
  local _, _, bottom <const> = s:reaction(slab:part"bottom")
  assert(s.residual.equilibrium < 1e-8 and math.abs(s:contact(stop).force[3] + bottom + 27) < 1e-7 * 27 and s:contact(stop).force[3] < -1)
else
  print "PETSc is absent: multigrid was not tried"
end

-- Slides along no axis are rows, which turned nodes make unnecessary: turning a scene changes no method.
local function corner(angle)
  local c <const>, sn <const> = math.cos(angle), math.sin(angle)
  local mesh <const> = dotyk.mesh.box{ from = { 0, 0, 0 }, to = { 1, 1, 1 }, cells = { n, n, n } }:transform(function(x, y, z) return c * x - sn * y, sn * x + c * y, z end)
  local block <const> = dotyk.body{ mesh = mesh, material = dotyk.material{ E = 210, nu = 0.3 } }
  for _, side in ipairs{ "left", "right", "front", "back" } do block:part(side):slide() end
  block:part"top":load{ 0, 0, -1 }
  local scene <const> = dotyk.scene{ block }
  scene:contact{ block:part"bottom", rigid = dotyk.rigid.plane{ point = { 0, 0, 0 }, normal = { 0, 0, 1 } }, friction = dotyk.friction.coulomb(0.2) }
  return scene:plan():match "method: (%a+)"
end
assert(corner(0) == "newton" and corner(0.3) == "newton", corner(0) .. " turned is " .. corner(0.3))

-- Factors are planned where they are faster, 0.6 GB of them, but not by a program that may take 0.7 GB. What is free while it runs does not count. A sanitized
-- program has terabytes of address space.
local kilobytes <const> = tonumber(io.open"/proc/self/status":read"a":match "VmSize:%s*(%d+)")
if kilobytes < 1e9 and petsc then
  local program <const> = io.popen("readlink /proc/$PPID/exe"):read "l"
  local function plan(options, cells, element, also)
    local code <const> = ([[
  local cube <const> = dotyk.body{ mesh = dotyk.mesh.box{ from = { 0, 0, 0 }, to = { 1, 1, 1 }, cells = { %d, %d, %d }, element = "%s" }, material = dotyk.material{ E = 210, nu = 0.3 } }
  cube:part"bottom":fix()
  local scene <const> = dotyk.scene{ cube }
  scene:contact{ cube:part"top", interference = true, rigid = dotyk.rigid.ball{ center = { 0.5, 0.5, 1.98 }, radius = 1 } }
  print(scene:plan()) %s]]):format(cells, cells, cells, element, also or "")
    return io.popen(("'%s' %s -e '%s' 2>&1"):format(program, options, code)):read "a"
  end
  local fits <const>, said <const> = plan("", 14, "P2"), plan("--memory 700M", 14, "P2")
  assert(fits:find "pdas on %d+ condensed rows %(.* multigrid would take some", fits)
  assert(said:find "multigrid on all %d+ unknowns: .* factors would take some .* MB, more than fits into the %d+ MB of memory", said)
  -- Nor is multigrid where its library does not fit: one choice, one refusal.
  local refused <const> = plan("--memory 300M", 20, "P1", "print(select(2, pcall(dotyk.solve, scene)))")
  assert(refused:find "pdas on %d+ condensed rows" and refused:find "the factor of %d+ unknowns needs" and not refused:find "before, on all unknowns", refused)
end
