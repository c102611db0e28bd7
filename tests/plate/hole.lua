-- Friction on edges apart from one another (P5, lemmas 13 and 14, false there): the outer edge may bear all that it can downwards and the
-- inner one all that it can upwards. The plate then moves freely within a range, and every method gives the least of all solutions.
local check <const> = require "check"
local law <const> = dotyk.law

local mesh <const> = dotyk.mesh.rectangle{ from = { -1.5, -1.5 }, to = { 1.5, 1.5 }, cells = { 12, 12 } }
  :keep(function(x, y) return math.max(math.abs(x), math.abs(y)) > 0.5 end, "hole")
local function plate(up, down, element)
  return dotyk.plate{ mesh = mesh, nu = 0.3, element = element, edge = { rotation = law.prescribed(), deflection = law.friction(1) },
    load = function(x, y) return math.max(math.abs(x), math.abs(y)) > 1 and up or -down end }
end

for _, element in ipairs{ "morley", "hct" } do
  -- 1. 20 up on the outer ring, 12 down on the inner one: 8 in all, 16 can be borne.
  local first
  for _, name in ipairs{ "pdas", "newton", "proximal", "feti" } do
    local s <const> = dotyk.solver[name]{ max_iterations = 2000 }:solve(plate(4, 4, element))
    check.that(s.converged and s.reason:find("unique stress, displacement up to", 1, true), s.reason)
    check.that(s.family and s.family.to - s.family.from > 0.02, s.reason)
    first = first or s
    check.near(s.energy, first.energy, 1e-9 * math.abs(first.energy))
    check.near(s.family.to - s.family.from, first.family.to - first.family.from, 1e-6)
    for _, at in ipairs{ { -1.5, -1.5 }, { 1, 0.3 }, { 0.5, 0.5 } } do check.near(s:deflection(at[1], at[2]), first:deflection(at[1], at[2]), 1e-6) end
  end
  -- 2. A load that slips on the outer edge alone: one solution.
  local s <const> = dotyk.solve(plate(3, 1, element))
  check.that(s.converged and not s.family and not s.reason:find("displacement up to", 1, true), s.reason)
end
