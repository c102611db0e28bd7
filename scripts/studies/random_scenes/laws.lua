-- Laws of supports for scripts/studies/random_scenes.lua: random ones as source text, what they allow of a displacement v and a
-- reaction r, and what of a motion without end they resist. Loaded by include. v and r as in help "law": v is positive away
-- from the support, r where it pushes.

local dice = include "dice.lua"
local laws = {}

local function clamp(x, low, high) return math.max(low, math.min(high, x)) end

-- Each law: which numbers it has (stiffnesses k and k2, a bound g, a load f); its graph, r at v, on either side of its
-- jumps; `bounds`: the least and the greatest r, where they are not the number g; its energy at v, 0 where none is
-- given, r = -d energy / dv.
local kinds = {
  prescribed = { graph = function(v) return v >= 0 and -math.huge or math.huge end, bounds = { -math.huge, math.huge } },
  elastic = { k = true, graph = function(v, k) return -k * v end, bounds = { -math.huge, math.huge },
              energy = function(v, k) return k * v * v / 2 end },
  one_sided_elastic = { k = true, graph = function(v, k) return k * math.max(-v, 0) end, bounds = { 0, math.huge },
                        energy = function(v, k) return k * math.min(v, 0) ^ 2 / 2 end },
  unequal_elastic = { k = true, k2 = true, graph = function(v, k, pull) return v < 0 and -k * v or -pull * v end,
                      bounds = { -math.huge, math.huge }, energy = function(v, k, pull) return (v < 0 and k or pull) * v * v / 2 end },
  signorini = { graph = function(v) return v >= 0 and 0 or math.huge end, bounds = { 0, math.huge } },
  friction = { g = true, graph = function(v, g) return v >= 0 and -g or g end, energy = function(v, g) return g * math.abs(v) end },
  one_sided_friction = { g = true, graph = function(v, g) return v >= 0 and 0 or g end, energy = function(v, g) return g * math.max(-v, 0) end },
  capped_elastic = { k = true, g = true, graph = function(v, k, g) return clamp(-k * v, -g, g) end,
                     energy = function(v, k, g) return math.abs(v) < g / k and k * v * v / 2 or g * math.abs(v) - g * g / (2 * k) end },
  load = { f = true, graph = function(_, f) return f end, energy = function(v, f) return -f * v end },
}

-- A law of one of the names, { "name", weight, … }; `stiffness` and `stress` are what is usual in the scene.
function laws.random(names, stiffness, stress)
  local name = dice.weighted(names)
  local kind = kinds[name]
  local law = { name = name, numbers = {}, kind = kind }
  local function add(number) table.insert(law.numbers, number) end
  if name == "prescribed" then add(0) end
  if kind.k then add(stiffness * dice.power(-3, 2)) end
  if kind.k2 then add(stiffness * dice.power(-3, 2)) end
  if kind.g then add(stress * dice.power(-2, 1)) end
  if kind.f then add(stress * dice.between(-1, 1)) end
  law.text = ("dotyk.law.%s(%s)"):format(name, table.concat(law.numbers, ", "))
  return law
end

-- How far r is from what the law gives at v, in units of tr, where v is known up to tv: up to 1 it is on the law's graph.
-- The graph falls with v, so that r must lie between its values at v + tv and v - tv.
function laws.distance(law, v, r, tv, tr)
  if v ~= v or r ~= r then return math.huge end -- not numbers
  local graph, a, b = law.kind.graph, law.numbers[1], law.numbers[2]
  local low, high = graph(v + tv, a, b), graph(v - tv, a, b)
  if r < low then return (low - r) / tr end
  if r > high then return (r - high) / tr end
  return 0
end

-- What the law stores or dissipates on the way to v.
function laws.energy(law, v) return law.kind.energy and law.kind.energy(v, table.unpack(law.numbers)) or 0 end

-- The force at a node of a result, of a contact or of a support with a law: its pressure and shear over its share.
function laws.force_at(node)
  local f = {}
  for k, n in ipairs(node.normal) do f[k] = node.weight * (node.shear[k] - node.pressure * n) end
  return f
end

-- The reactions that the law can reach, from and to.
function laws.bounds(law)
  local kind, g = law.kind, law.numbers[#law.numbers]
  if kind.bounds then return table.unpack(kind.bounds) end
  if law.name == "load" then return 0, 0 end -- counted among the loads
  return law.name == "one_sided_friction" and 0 or -g, g
end

return laws
