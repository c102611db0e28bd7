-- Three blocks over an excavation (Dostál, Gomes, Santos: FETI domain decomposition for modelling of 3-D block structure).
--
--   ./dotyk scripts/three_blocks.lua
--
-- A block of rock with an excavation at its foot, two blocks above it, own weight. Normal displacements are zero on the
-- outer vertical faces and on the bottom, not in the excavation: the upper blocks may move vertically. The drawing of
-- the paper is lost; the geometry is one of its size. FETI without further cutting of the bodies, supports in the
-- stiffness: the coarse space is the two vertical motions. Shown: the paper's table; the solution against a direct
-- method's; images/three_blocks.png.

-- 1. The blocks.
local scene <const>, contacts <const>, bodies <const> =
  dofile((arg[0]:match "^(.*)/[^/]*$" or ".") .. "/scenes/three_blocks.lua")({ 7, 17, 4, 3 }, { 3 / 7, 11 / 17, 2 / 3 })
local bottom <const>, left <const>, right <const> = table.unpack(bodies)
print(scene:plan())

-- 2. The direct method, and FETI to the same precision.
local direct <const> = dotyk.solver.pdas{ tol = 1e-12 }:solve(scene)
-- How far a solution's contact forces are from another's, relative.
local function difference(s, other)
  local sum, whole = 0, 0
  for _, c in ipairs(contacts) do
    local mine <const>, theirs <const> = s:contact(c).nodes, other:contact(c).nodes
    for k, node in ipairs(mine) do sum, whole = sum + (node.force - theirs[k].force)^2, whole + theirs[k].force^2 end
  end
  return math.sqrt(sum / whole)
end
local function displaced(s, other) -- of the sides of the joint above the excavation, and of its roof
  local most, whole = 0, 0
  for _, at in ipairs{ { left, 0, 0, 18 }, { right, 0, 0, 0 }, { bottom, 0, 0, 0 }, { bottom, 5, 20, -4 }, { left, -20, 40, 9 } } do
    local u <const>, v <const> = { s:displacement(table.unpack(at)) }, { other:displacement(table.unpack(at)) }
    for i = 1, 3 do most, whole = math.max(most, math.abs(u[i] - v[i])), math.max(whole, math.abs(v[i])) end
  end
  return most / whole
end
local tight <const> = dotyk.solver.feti{ supports = "stiffness", tol = 1e-12 }:solve(scene)
assert(tight.converged, tight.reason)
print(("tight: forces differ by %.1e, displacements by %.1e from the direct method's; %d unknowns, %d dual, coarse space %d"):format(
  difference(tight, direct), displaced(tight, direct), tight.unknowns, tight.feti.rows, tight.feti.kernel))
assert(displaced(tight, direct) < 1e-9 and difference(tight, direct) < 1e-9)

-- 3. The paper's table: algorithm 4.1 with proportioning and projections, |g^P| <= 1e-4 |d|, |G lambda - e| <= 1e-4 |f|.
-- The paper does not tell the units of rho and M. Here rho = 1 is 1.2 |PFP|, just above the spectrum of PFP, beside which the
-- penalty's one eigenvalue costs no more than itself ((3.5)); M = 1 is |PFP|/100: here an inner minimisation ends at the
-- step that meets M, not at the end of a face, and a greater M makes more outer steps of it.
print "\n            no preconditioner             lumped                        off by"
print "M     rho   outer inner  seconds   outer inner  seconds   forces   displacements"
local rules <const> = { M = { 0.01, 0.1, 1 }, rho = { 0.1, 1, 10, 100, 1000 }, preconditioner = { "none", "lumped" } }
local runs, worst = {}, 0
local function run(M, rho, preconditioner)
  local s <const> = dotyk.solver.feti{ supports = "stiffness", tol = 1e-4, update = "penalty", coarse = "whole",
    expansion = "projected_cg", M = M / 100, rho = 1.2 * rho, preconditioner = preconditioner }:solve(scene)
  assert(s.converged, s.reason)
  local forces <const>, displacements <const> = difference(s, direct), displaced(s, direct)
  assert(s.iterations >= 2 and s.iterations <= 4)
  assert(math.max(forces, displacements) < 1.5e-4)
  return { outer = s.iterations, inner = s.feti.inner, seconds = s.time.iterate, forces = forces, displacements = displacements }
end
for _, M in ipairs(rules.M) do
  runs[M] = {}
  for _, rho in ipairs(rules.rho) do
    local line = ("%-5g %-5g"):format(M, rho)
    local r <const> = {}
    for _, preconditioner in ipairs(rules.preconditioner) do
      r[preconditioner] = run(M, rho, preconditioner)
      local it <const> = r[preconditioner]
      line = line .. ("  %5d %5d  %7.3f "):format(it.outer, it.inner, it.seconds)
    end
    local forces <const>, displacements <const> =
      math.max(r.none.forces, r.lumped.forces), math.max(r.none.displacements, r.lumped.displacements)
    print(line .. ("  %.1e  %.1e"):format(forces, displacements))
    worst = math.max(worst, forces, displacements)
    assert(r.lumped.inner <= r.none.inner, "lumped takes more steps than none")
    runs[M][rho] = r
  end
end
local growth, apart, above = 0, 0, 0
for _, preconditioner in ipairs(rules.preconditioner) do
  for _, M in ipairs(rules.M) do
    local fewest = math.huge
    for _, rho in ipairs(rules.rho) do fewest = math.min(fewest, runs[M][rho][preconditioner].inner) end
    local at_one <const> = runs[M][1][preconditioner].inner
    above = math.max(above, at_one / fewest)
    growth = math.max(growth, runs[M][1000][preconditioner].inner / at_one)
  end
  apart = math.max(apart, runs[0.01][1][preconditioner].inner / runs[1][1][preconditioner].inner)
end
print(("off by %.1e at most; inner steps at rho = 1: %.2f times the fewest; at 1000: %.2f times those; from M = 1 to 0.01: %.2f times"):format(
  worst, above, growth, apart))
assert(growth < 3 and above < 1.3 and apart < 1.6)

-- 4. Contact forces and status above the excavation.
tight:render{ file = "images/three_blocks.png", field = "uz", deform = "auto", contact = true, size = { 1400, 1000 } }
local forces = {}
for k, c in ipairs(contacts) do
  local r <const> = tight:contact(c)
  print(("%s: %.4g MN, %d closed, %d open"):format(c.name or k, math.sqrt(r.force[1]^2 + r.force[2]^2 + r.force[3]^2) / 1e6, r.closed, r.open))
end
print "images/three_blocks.png"
