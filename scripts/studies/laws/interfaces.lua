-- Every normal law with every tangential law, where a part meets another part, a rigid plane or the ground, in the plane and in space. Each pair is solved by
-- two methods that share no step, Newton's and over-relaxation row by row; printed is how far apart their tractions are, relative to the greatest, or the reason why the
-- pair is refused.

local l <const> = dotyk.law
local normals <const> = {
  { "free", l.free() }, { "prescribed", l.prescribed(0.001) }, { "load", l.load(2) }, { "elastic", l.elastic(2e3) }, { "one_sided_elastic", l.one_sided_elastic(2e3) },
  { "signorini", l.signorini() }, { "friction", l.friction(3) }, { "one_sided_friction", l.one_sided_friction(3) }, { "capped_elastic", l.capped_elastic(2e3, 3) },
  { "unequal_elastic", l.unequal_elastic(2e3, 500) }, { "compliance", l.compliance{ c = 1e6, m = 2 } }, { "breaking", l.breaking(2e3, 1e3) },
}
local tangentials <const> = {
  { "free", l.free() }, { "no slip", l.prescribed(0) }, { "elastic", l.elastic(1e3) }, { "capped", l.capped_elastic(1e3, 0.5) }, { "given", dotyk.friction.tresca(0.5) },
  { "given(x)", dotyk.friction.tresca(function(x) return 0.5 + x end) }, { "Coulomb", dotyk.friction.coulomb(0.2) },
}
local wheres <const> = { "part", "rigid", "ground" }
local steel <const> = dotyk.material{ E = 1000, nu = 0.3 }

local function box(name, low, high, cells, element)
  local make <const> = #low == 2 and dotyk.mesh.rectangle or dotyk.mesh.box
  return dotyk.body{ name = name, material = steel, mesh = make{ from = low, to = high, cells = cells, element = element } }
end

-- A block whose top is pressed down on the left, lifted on the right and pushed along; below it is `where`.
local function scene(where, dimension, normal, tangential)
  local plane <const> = dimension == 2
  local block <const> = plane and box("block", { 0, 0 }, { 1, 0.5 }, { 8, 4 }, "Q1") or box("block", { 0, 0, 0 }, { 1, 0.5, 0.5 }, { 4, 2, 2 }, "Q1")
  local under <const> = block:part("bottom")
  local lowered <const> = function(x) return 0.01 * (x - 0.7) end
  local top <const> = block:part("top")
  if plane then top:displace{ x = 0.002, y = lowered } else top:displace{ x = 0.002, y = 0.001, z = lowered } end
  if where == "ground" then
    under:support{ normal = normal, tangential = tangential }
    return dotyk.scene{ block }, function(s) return s:support(under) end
  end
  local set, contact
  if where == "rigid" then
    set = dotyk.scene{ block }
    local floor <const> = dotyk.rigid.plane(plane and { point = { 0, 0 }, normal = { 0, 1 } } or { point = { 0, 0, 0 }, normal = { 0, 0, 1 } })
    contact = set:contact{ under, rigid = floor, normal = normal, tangential = tangential }
  else
    local base <const> = plane and box("base", { 0, -0.5 }, { 1, 0 }, { 8, 4 }, "Q1") or box("base", { 0, 0, -0.5 }, { 1, 0.5, 0 }, { 4, 2, 2 }, "Q1")
    base:part("bottom"):fix()
    set = dotyk.scene{ block, base }
    contact = set:contact{ under, base:part("top"), normal = normal, tangential = tangential }
  end
  return set, function(s) return s:contact(contact) end
end

-- The greatest difference of tractions, relative to the greatest traction.
local function apart(one, two)
  local greatest, difference = 0, 0
  for i, a in ipairs(one.nodes) do
    local b <const> = two.nodes[i]
    greatest, difference = math.max(greatest, math.abs(a.pressure)), math.max(difference, math.abs(a.pressure - b.pressure))
    for k = 1, #a.shear do
      greatest, difference = math.max(greatest, math.abs(a.shear[k])), math.max(difference, math.abs(a.shear[k] - b.shear[k]))
    end
  end
  return greatest > 0 and difference / greatest or difference
end

local newton <const>, psor <const> = dotyk.solver.newton{ tol = 1e-12 }, dotyk.solver.psor{ tol = 1e-12, max_iterations = 20000 }
local reasons <const>, number, solved, worst = {}, 0, 0, 0
local function cell(where, dimension, normal, tangential)
  local made <const>, set <const>, tractions <const> = pcall(scene, where, dimension, normal, tangential)
  if not made then
    local reason <const> = set:gsub("^[^:]*:%d+: ", ""):gsub("'[^']*'", "…"):gsub("contact of .- cannot", "contact cannot")
    if not reasons[reason] then
      number = number + 1
      reasons[reason], reasons[number] = number, reason
    end
    return ("(%d)"):format(reasons[reason])
  end
  local one <const>, two <const> = newton:solve(set), psor:solve(set)
  if not (one.converged and two.converged) then return "fails: " .. (one.converged and two.reason or one.reason) end
  local difference <const> = apart(tractions(one), tractions(two))
  solved, worst = solved + 1, math.max(worst, difference)
  return ("%.0e"):format(difference)
end

for _, where in ipairs(wheres) do
  for dimension = 2, 3 do
    print(("\n%s, %d-D: how far apart two methods are; (n): refused"):format(where, dimension))
    local head = ("%-20s"):format("normal \\ tangential")
    for _, t in ipairs(tangentials) do head = head .. ("%10s"):format(t[1]) end
    print(head)
    for _, n in ipairs(normals) do
      local line = ("%-20s"):format(n[1])
      for _, t in ipairs(tangentials) do line = line .. ("%10s"):format(cell(where, dimension, n[2], t[2])) end
      print(line)
    end
  end
end
print ""
for i, reason in ipairs(reasons) do print(("(%d) %s"):format(i, reason)) end
print(("%d pairs solved, at most %.0e apart"):format(solved, worst))
assert(worst < 1e-8)
