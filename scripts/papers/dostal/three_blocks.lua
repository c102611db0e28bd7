-- Three blocks over an excavation (Dostál, Gomes, Santos: FETI domain decomposition for modelling of 3-D block structure).
--
--   ./dotyk scripts/papers/dostal/three_blocks.lua
--
-- A block of rock with an excavation at its foot, two blocks above it, own weight. Normal displacements are zero on the
-- outer vertical faces and on the bottom, not in the excavation: the upper blocks may move vertically. The drawing of
-- the paper is lost; the geometry is one of its size. FETI without further cutting of the bodies, supports in the
-- stiffness: the coarse space is the two vertical motions. Shown: the paper's table; the solution against a direct
-- method's; images/three_blocks.png.

-- 1. The blocks.
local scene <const>, contacts <const>, bodies <const> =
  include "../../lib/three_blocks.lua"({ 7, 17, 4, 3 }, { 3 / 7, 11 / 17, 2 / 3 })
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
-- The paper tells no units. "paper's": M and rho in one unit, as they are both a displacement per force, here 50 |PFP|, so chosen
-- that the fewest steps are at rho = 1 and grow to 1000 as they do there; eta in 0.001 |Pd|/|PFP|, so chosen that rho below 1 ends
-- at 1; its stopping rule. "own": rho in 1.2 |PFP|, just above the spectrum of PFP, beside which the penalty's one eigenvalue
-- costs no more than itself ((3.5)); M in |PFP|/100, eta in |Pd|/|PFP|, |Pd| in place of |d|: here an inner minimisation ends at the
-- step that meets M, not at the end of a face, and a greater M makes more outer steps of it.
local printed <const> = { -- outer and inner steps in the paper's table 1: none, lumped
  [0.01] = { [0.1] = { 4, 93, 4, 74 }, [1] = { 2, 67, 2, 60 }, [10] = { 2, 115, 2, 76 }, [100] = { 2, 154, 2, 118 }, [1000] = { 2, 171, 2, 158 } },
  [0.1] = { [0.1] = { 3, 85, 4, 58 }, [1] = { 2, 67, 2, 60 }, [10] = { 2, 115, 2, 76 }, [100] = { 2, 154, 2, 118 }, [1000] = { 2, 171, 2, 158 } },
  [1] = { [1] = { 2, 65, 2, 59 }, [10] = { 2, 113, 2, 76 }, [100] = { 2, 154, 2, 116 }, [1000] = { 2, 171, 2, 158 } } }
local units <const> = { paper = { M = 50, rho = 50, eta = 0.001, stop = "d" }, own = { M = 0.01, rho = 1.2, eta = 0.1, stop = "Pd" } }
local rules <const> = { M = { 0.01, 0.1, 1 }, rho = { 0.1, 1, 10, 100, 1000 }, preconditioner = { "none", "lumped" } }
local function run(M, rho, preconditioner, unit)
  local s <const> = dotyk.solver.feti{ supports = "stiffness", tol = 1e-4, update = "penalty", coarse = "whole", expansion = "projected_cg",
    M = M * unit.M, rho = rho * unit.rho, eta = unit.eta, stop = unit.stop, preconditioner = preconditioner }:solve(scene)
  assert(s.converged, s.reason)
  return { outer = s.iterations, inner = s.feti.inner, rho = math.floor(s.feti.rho / unit.rho * 1e6 + 0.5) / 1e6, off = math.max(difference(s, direct), displaced(s, direct)) }
end
print "\n            printed                 paper's units, final rho          own units, final rho"
print "M     rho   none       lumped       none            lumped            none            lumped         (outer, inner)"
local runs <const>, off = { paper = {}, own = {} }, { paper = 0, own = 0 }
for _, M in ipairs(rules.M) do
  for _, rho in ipairs(rules.rho) do
    local p <const> = printed[M][rho]
    local line = ("%-5g %-5g"):format(M, rho) .. (p and (" %2d %4d    %2d %4d   "):format(table.unpack(p)) or (" "):rep(23))
    for _, name in ipairs{ "paper", "own" } do
      for _, preconditioner in ipairs(rules.preconditioner) do
        local r <const> = run(M, rho, preconditioner, units[name])
        line = line .. ("  %2d %4d %-5.3g "):format(r.outer, r.inner, r.rho)
        off[name] = math.max(off[name], r.off)
        runs[name][M .. " " .. rho .. " " .. preconditioner] = r
        assert(r.outer >= 2 and r.outer <= 4)
      end
    end
    print(line)
  end
end
local function inner(name, M, rho, preconditioner) return runs[name][M .. " " .. rho .. " " .. preconditioner].inner end
for _, name in ipairs{ "paper", "own" } do
  local growth, apart, above, fewer = 0, 0, 0, true
  for _, M in ipairs(rules.M) do
    for _, preconditioner in ipairs(rules.preconditioner) do
      local fewest = math.huge
      for _, rho in ipairs(rules.rho) do fewest = math.min(fewest, inner(name, M, rho, preconditioner)) end
      local at_one <const> = inner(name, M, 1, preconditioner)
      above, growth = math.max(above, at_one / fewest), math.max(growth, inner(name, M, 1000, preconditioner) / at_one)
      apart = math.max(apart, at_one / inner(name, 1, 1, preconditioner), inner(name, 1, 1, preconditioner) / at_one)
    end
    for _, rho in ipairs(rules.rho) do fewer = fewer and inner(name, M, rho, "lumped") <= inner(name, M, rho, "none") end
  end
  print(("%s units: off by %.1e at most; inner steps at rho = 1: %.2f times the fewest; at 1000: %.2f times those; M = 1 and others: %.2f times; lumped never more: %s"):format(
    name, off[name], above, growth, apart, fewer))
  if name == "own" then assert(off.own < 1.5e-4 and growth < 3 and above < 1.3 and apart < 1.6 and fewer) end
end
-- In the paper's units, as printed for M <= 0.1: two outer steps from rho = 1 on, the fewest inner ones there, 2.6 times at 1000 (to
-- about a quarter, without preconditioner), and rho = 0.1 ends at 1. Not: M = 1 as 0.1; lumped with fewer steps for rho >= 100.
assert(off.paper < 3e-3) -- the rule with |d| asks for less
for _, M in ipairs{ 0.01, 0.1 } do
  for _, preconditioner in ipairs(rules.preconditioner) do
    assert(runs.paper[M .. " 0.1 " .. preconditioner].rho == 1)
    for _, rho in ipairs{ 1, 10, 100, 1000 } do
      assert(runs.paper[M .. " " .. rho .. " " .. preconditioner].outer == 2 and inner("paper", M, rho, preconditioner) >= inner("paper", M, 1, preconditioner))
    end
  end
  local growth <const> = inner("paper", M, 1000, "none") / inner("paper", M, 1, "none")
  assert(growth > 2 and growth < 3.5)
end

-- 4. Contact forces and status above the excavation.
local pictures = { tight:picture{ field = "pressure", explode = 0.35, units = { length = "m", stress = "Pa" }, title = "Blocks drawn apart" } }
for k, c in ipairs(contacts) do pictures[k + 1] = tight:picture{ map = c, units = { length = "m", stress = "Pa" }, title = ("Joint %d"):format(k) } end
dotyk.pictures{ file = "images/three_blocks.png", columns = 2, table.unpack(pictures) }
local forces = {}
for k, c in ipairs(contacts) do
  local r <const> = tight:contact(c)
  print(("%s: %.4g MN, %d closed, %d open"):format(c.name or k, math.sqrt(r.force[1]^2 + r.force[2]^2 + r.force[3]^2) / 1e6, r.closed, r.open))
end
print "images/three_blocks.png"
