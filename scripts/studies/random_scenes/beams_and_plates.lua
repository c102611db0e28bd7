-- Random beams and plates for scripts/studies/random_scenes.lua: their source, checks and the problem of their solvability. Loaded by include.

local dice, laws = include "dice.lua", include "laws.lua"
local models = {}

local along <const> = { "prescribed", 2, "elastic", 3, "one_sided_elastic", 3, "unequal_elastic", 1, "signorini", 5, "friction", 1,
                        "one_sided_friction", 1, "capped_elastic", 1 }

-- What a law resists of the motions with these amounts along v.
local function resist(problem, law, row, share)
  local low, high = laws.bounds(law)
  table.insert(problem.forces, { rows = { row }, low = -high * share, high = -low * share })
end

-- How two lists of forces at points balance.
local function balanced(forces, moments, wrong)
  local sum, gross = 0, 1e-300
  for _, f in ipairs(forces) do sum, gross = sum + f, gross + math.abs(f) end
  if not (math.abs(sum) <= 1e-6 * gross) then wrong("forces do not balance: %.3g of %.3g", sum, gross) end
  sum = 0
  for _, m in ipairs(moments) do sum, gross = sum + m, gross + math.abs(m) end
  if not (math.abs(sum) <= 1e-6 * gross) then wrong("moments do not balance: %.3g of %.3g", sum, gross) end
end

-- 1. Beams: of unit length, with supports at the ends and within. Laws of a rotation act on v = -slope, see help "law".
local function support_text(support)
  local items = {}
  for _, what in ipairs{ "deflection", "rotation" } do
    if support[what] then table.insert(items, what .. " = " .. support[what].text) end
  end
  return table.concat(items, ", ")
end

function models.beam()
  local EJ <const>, q <const> = dice.power(-2, 4), dice.power(-2, 2) * dice.sign()
  local beam = { kind = "beam", supports = {}, points = {}, q = q, force = math.abs(q), EJ = EJ }
  local count <const> = dice.pick{ 0, 1, 2, 3, 5, 8, 12 }
  local inner, points = {}, {}
  for k = 0, count + 1 do
    local support = { x = k / (count + 1), at = k == 0 and "left" or k == count + 1 and "right" or k / (count + 1) }
    if dice.chance(0.85) then support.deflection = laws.random(along, 100 * EJ, beam.force) end
    if dice.chance(0.15) then support.rotation = laws.random(along, EJ, 0.1 * beam.force) end
    if k > 0 and k <= count then table.insert(inner, ("{ x = %.17g, %s }"):format(support.x, support_text(support))) end
    table.insert(beam.supports, support)
  end
  for k = 1, dice.pick{ 0, 0, 1, 2 } do
    points[k] = { x = dice.between(0, 1), force = q * dice.between(-0.5, 1), moment = 0.1 * q * dice.between(-1, 1) }
  end
  beam.points = points
  local loads = {}
  for k, p in ipairs(points) do loads[k] = ("{ x = %g, force = %.17g, moment = %.17g }"):format(p.x, p.force, p.moment) end
  beam.lines = { ("return dotyk.beam{ EJ = %g, load = %g, cells = %d, left = { %s }, right = { %s },"):format(EJ, q, dice.pick{ 4, 8, 16, 32 },
      support_text(beam.supports[1]), support_text(beam.supports[count + 2])),
    ("  supports = { %s },"):format(table.concat(inner, ", ")), ("  loads = { %s } }"):format(table.concat(loads, ", ")) }
  return beam
end

local function check_beam(beam, s)
  local complaints, forces, moments, reactions = {}, { beam.q }, { beam.q / 2 }, {}
  local function wrong(...) table.insert(complaints, (string.format(...))) end
  local most, u = 0, 0
  for k, support in ipairs(beam.supports) do
    local r = s:reaction(support.at)
    reactions[k] = r
    table.insert(forces, r.force)
    table.insert(moments, r.moment)
    table.insert(moments, support.x * r.force)
    most, u = math.max(most, math.abs(r.force), math.abs(r.moment)), math.max(u, math.abs(r.deflection), math.abs(r.rotation))
  end
  for _, p in ipairs(beam.points) do
    table.insert(forces, p.force)
    table.insert(moments, p.moment)
    table.insert(moments, p.x * p.force)
  end
  balanced(forces, moments, wrong)
  local tol = { p = 1e-6 * math.max(most, 0.01 * beam.force), u = 1e-6 * math.max(u, 0.01 * beam.force / beam.EJ) }
  for k, support in ipairs(beam.supports) do
    local r = reactions[k]
    for what, at in pairs{ deflection = { r.deflection, r.force }, rotation = { -r.rotation, -r.moment } } do
      local law, v, f = support[what], at[1], at[2]
      if not law and math.abs(f) > tol.p then wrong("%s reaction %.3g without a law at %s", what, f, support.at) end
      if law and laws.distance(law, v, f, tol.u, tol.p) > 1 then wrong("%s law %s: v = %.6g, r = %.6g at %s", what, law.name, v, f, support.at) end
    end
  end
  return complaints, { energy = 1e-9 * most * u }
end

local function problem_of_beam(beam)
  local problem = { modes = 2, fixed = {}, forces = {}, load = { beam.q, beam.q / 2 } }
  for _, p in ipairs(beam.points) do
    problem.load[1], problem.load[2] = problem.load[1] + p.force, problem.load[2] + p.x * p.force + p.moment
  end
  for _, support in ipairs(beam.supports) do
    if support.deflection then resist(problem, support.deflection, { 1, support.x }, 1) end
    if support.rotation then resist(problem, support.rotation, { 0, -1 }, 1) end
  end
  return problem
end

-- 2. Plates: rectangles with laws along sides, supports at points, an obstacle. Along a side v and r are those of its points, per length.
-- With HCT a point's law acts on a mean about it: laws and moments are checked with Morley's element alone.
local normal <const> = { left = { -1, 0 }, right = { 1, 0 }, bottom = { 0, -1 }, top = { 0, 1 } }

function models.plate()
  local width <const>, height <const>, D <const>, q <const> = dice.between(0.5, 2), dice.between(0.5, 2), dice.power(-2, 4), dice.power(-2, 2) * -1
  local plate = { kind = "plate", width = width, height = height, D = D, q = q, force = -q, sides = {}, points = {}, supports = {},
    element = dice.pick{ "morley", "morley", "hct" }, cells = { dice.pick{ 4, 8 }, dice.pick{ 4, 8 } } }
  local edges, loads, supports = {}, {}, {}
  for _, side in ipairs{ "left", "right", "bottom", "top" } do
    local edge = {}
    if dice.chance(0.6) then edge.deflection = laws.random(along, 100 * D, plate.force) end
    if dice.chance(0.2) then edge.rotation = laws.random(along, D, 0.1 * plate.force) end
    if edge.deflection or edge.rotation then
      plate.sides[side] = edge
      table.insert(edges, ("%s = { %s }"):format(side, support_text(edge)))
    end
  end
  for k = 1, dice.pick{ 0, 0, 1, 2 } do
    plate.points[k] = { x = width * dice.pick{ 0.25, 0.5, 0.75 }, y = height * dice.pick{ 0.25, 0.5 }, force = q * dice.between(-0.5, 1) }
    loads[k] = ("{ x = %.17g, y = %.17g, force = %.17g }"):format(plate.points[k].x, plate.points[k].y, plate.points[k].force)
  end
  for k = 1, dice.pick{ 0, 0, 0, 1, 3 } do
    local p = { x = width * k / 4, y = height * (k % 3 + 1) / 4, deflection = laws.random(along, 100 * D, plate.force) }
    plate.supports[k] = p
    supports[k] = ("{ x = %.17g, y = %.17g, %s }"):format(p.x, p.y, support_text(p))
  end
  plate.obstacle = dice.chance(0.3) and -dice.power(-4, -1) * plate.force / D
  plate.lines = { ("return dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {%g, %g}, cells = {%d, %d} },"):format(width, height,
      plate.cells[1], plate.cells[2]),
    ("  element = %q, D = %g, nu = %g, load = %g%s,"):format(plate.element, D, dice.between(0, 0.45), q,
      plate.obstacle and (", obstacle = %.17g"):format(plate.obstacle) or ""),
    ("  edges = { %s },"):format(table.concat(edges, ", ")), ("  loads = { %s },"):format(table.concat(loads, ", ")),
    ("  supports = { %s } }"):format(table.concat(supports, ", ")) }
  return plate
end

local function check_plate(plate, s)
  local complaints, area, whole = {}, plate.width * plate.height, plate.element == "morley"
  local function wrong(...) table.insert(complaints, (string.format(...))) end
  local forces, about_x, about_y, places = {}, {}, {}, {}
  local function push(x, y, force)
    table.insert(forces, force)
    table.insert(about_x, y * force)
    table.insert(about_y, x * force)
  end
  push(plate.width / 2, plate.height / 2, plate.q * area)
  for _, p in ipairs(plate.points) do push(p.x, p.y, p.force) end
  for k, p in ipairs(plate.supports) do
    local force = s:reaction(k).force
    push(p.x, p.y, force)
    table.insert(places, { law = p.deflection, v = s:deflection(p.x, p.y), r = force, share = 1, at = "point " .. k })
  end
  for side, edge in pairs(plate.sides) do
    if edge.rotation then whole = false end
    for k, p in ipairs(s:reaction(side).points) do
      push(p.x, p.y, p.force)
      if edge.deflection and not p.corner and plate.element == "morley" then
        table.insert(places, { law = edge.deflection, v = p.deflection, r = p.reaction, share = p.length, at = ("%s %d"):format(side, k) })
      end
    end
  end
  local contact = plate.obstacle and s.contact
  for _, node in ipairs(contact and contact.nodes or {}) do push(node.x, node.y, node.force) end
  balanced(forces, whole and about_x or {}, wrong)
  balanced({}, whole and about_y or {}, wrong)
  local most, u = 0.01 * plate.force, 0.01 * plate.force / plate.D
  for _, p in ipairs(places) do most, u = math.max(most, math.abs(p.r)), math.max(u, math.abs(p.v)) end
  for _, p in ipairs(places) do
    if laws.distance(p.law, p.v, p.r, 1e-6 * u, 1e-6 * most) > 1 then wrong("law %s: v = %.6g, r = %.6g at %s", p.law.name, p.v, p.r, p.at) end
  end
  return complaints, { energy = 1e-9 * plate.force * area * u }
end

local function problem_of_plate(plate)
  local area <const> = plate.width * plate.height
  local whole <const> = plate.q * area
  local problem = { modes = 3, fixed = {}, forces = {}, load = { whole, whole * plate.width / 2, whole * plate.height / 2 } }
  for _, p in ipairs(plate.points) do
    for k, v in ipairs{ 1, p.x, p.y } do problem.load[k] = problem.load[k] + v * p.force end
  end
  for _, p in ipairs(plate.supports) do resist(problem, p.deflection, { 1, p.x, p.y }, 1) end
  for side, edge in pairs(plate.sides) do
    local n = normal[side]
    local length, cells = n[1] ~= 0 and plate.height or plate.width, plate.cells[n[1] ~= 0 and 2 or 1]
    if edge.rotation then resist(problem, edge.rotation, { 0, -n[1], -n[2] }, length) end
    local inwards = plate.element == "hct" and 1 / 3 or 0 -- at the ends, where the mean about a vertex is
    for k = 0, edge.deflection and cells or -1 do
      local t = (k == 0 and inwards or k == cells and cells - inwards or k) / cells
      local x = n[1] ~= 0 and (n[1] > 0 and plate.width or 0) or t * plate.width
      local y = n[2] ~= 0 and (n[2] > 0 and plate.height or 0) or t * plate.height
      resist(problem, edge.deflection, { 1, x, y }, length / cells * ((k == 0 or k == cells) and 0.5 or 1))
    end
  end
  for _, x in ipairs(plate.obstacle and { 0, plate.width } or {}) do
    for _, y in ipairs{ 0, plate.height } do table.insert(problem.forces, { rows = { { 1, x, y } }, low = -math.huge, high = 0 }) end
  end
  return problem
end

function models.check(model, s) return (model.kind == "beam" and check_beam or check_plate)(model, s) end
function models.problem(model) return (model.kind == "beam" and problem_of_beam or problem_of_plate)(model) end
return models
