-- What the scripts of the stability atlas share: boundaries by bisection, maps of outcomes, the comparison of two
-- solutions, the sentence at the end. Loaded by include.

local common = {}

-- The place where `holds` turns from true (at `low`) to false (at `high`), to a relative width; by halving
-- the ratio of the two, which are positive.
function common.boundary(low, high, holds, width)
  assert(holds(low), "the lower end does not hold")
  assert(not holds(high), "the upper end holds")
  while high / low > 1 + width do
    local between = math.sqrt(low * high)
    if holds(between) then low = between else high = between end
  end
  return math.sqrt(low * high)
end

-- Points of a map, gathered by what happened there: map:add("converged", x, y). For dotyk.chart map:series(), symbols in the
-- order of `outcomes` without those that never happened, or map:cells(), where the points are those of a grid.
function common.map(outcomes)
  local map = { of = {} }
  for _, name in ipairs(outcomes) do map.of[name] = { name = name, style = "points", x = {}, y = {} } end
  function map:add(outcome, x, y)
    local to = assert(self.of[outcome], outcome)
    to.x[#to.x + 1], to.y[#to.y + 1] = x, y
  end
  function map:series()
    local list = {}
    for _, name in ipairs(outcomes) do if #self.of[name].x > 0 then list[#list + 1] = self.of[name] end end
    return list
  end
  function map:cells()
    local function ascending(axis)
      local list, place = {}, {}
      for _, points in pairs(self.of) do
        for _, value in ipairs(points[axis]) do
          if not place[value] then list[#list + 1], place[value] = value, 0 end
        end
      end
      table.sort(list)
      for k, value in ipairs(list) do place[value] = k end
      return list, place
    end
    local x <const>, column <const> = ascending "x"
    local y <const>, row <const> = ascending "y"
    local values <const> = {}
    for j = 1, #y do
      values[j] = {}
      for i = 1, #x do values[j][i] = 0/0 end -- not applicable where nothing happened
    end
    for k, name in ipairs(outcomes) do
      local points <const> = self.of[name]
      for i = 1, #points.x do values[row[points.y[i]]][column[points.x[i]]] = k end
    end
    return { x = x, y = y, values = values, names = outcomes }
  end
  return map
end

-- A curve for dotyk.chart: curve(name, options):add(x, y).
function common.curve(name, options)
  local curve = { name = name, x = {}, y = {} }
  for key, value in pairs(options or {}) do curve[key] = value end
  return setmetatable(curve, { __index = { add = function(self, x, y) self.x[#self.x + 1], self.y[#self.y + 1] = x, y end } })
end

-- The name of a method in a figure: "projected CG" for projected_cg.
function common.method(name)
  if name == "pdas" or name == "psor" or name == "feti" then return name:upper() end
  if name == "newton" or name == "uzawa" then return (name:gsub("^%l", string.upper)) end
  return (name:gsub("_", " "):gsub("cg$", "CG"):gsub(" pdas$", " PDAS"):gsub("^uzawa", "Uzawa"):gsub("^coulomb", "Coulomb"))
end

-- How far the forces of two solutions on a contact are apart: the greatest difference of a node's normal force
-- or shear, over the greatest normal force.
function common.apart(s, t, contact)
  local most, size = 0, 0
  local others = t:contact(contact).nodes
  for k, node in ipairs(s:contact(contact).nodes) do
    local other = others[k]
    most, size = math.max(most, math.abs(node.force - other.force)), math.max(size, math.abs(other.force))
    for i, shear in ipairs(node.shear or {}) do
      most = math.max(most, math.abs(shear * node.weight - other.shear[i] * other.weight))
    end
  end
  return size > 0 and most / size or most
end

-- The greatest of a solution's relative residuals.
function common.residual(s)
  return math.max(s.residual.equilibrium, s.residual.penetration, s.residual.complementarity, s.residual.friction)
end

-- A word in s.reason, or a plain one, for how a run ended that did not converge.
function common.ending(s)
  if s.converged then return "converged" end
  return s.reason:find("diverge", 1, true) and "diverges" or s.reason:find("not fallen", 1, true) and "stalls" or "gives up"
end

-- A rigid parabola pressed into a block of n cells along its top: its scene and contact.
function common.punch(n)
  local body = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = {-1, -1}, to = {1, 0}, cells = {n, n // 2} } }
  body:part"bottom":fix()
  local scene = dotyk.scene{ body }
  return scene, scene:contact{ body:part"top", rigid = dotyk.rigid.gap{ normal = {0, 1}, gap = function(x) return x^2 / 4 - 0.02 end } }
end

-- The script's last line: what it found, if that is so.
function common.verdict(holds, sentence)
  print("verdict: " .. sentence)
  assert(holds, "the verdict does not hold")
end

return common
