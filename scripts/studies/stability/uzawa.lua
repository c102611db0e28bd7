-- Stability atlas: the step of Uzawa's method.
--
--   ./dotyk scripts/studies/stability/uzawa.lua [FINEST]
--
-- λ := π(λ + ρDx), D = 1/W_rr, contracts for ρ < 2/λ_max(D^½WD^½), W the compliance of the contact rows. Near a
-- solution only the rows A that stay closed count, 2/λ_max(W_AA): beyond it no solution attracts, and between the two
-- the way there decides. Here W is measured node by node (a linear solve for each unit load), so both are known apart
-- from the method; the step at which it ceases to converge is found by bisection, for a flat punch (all rows closed,
-- the two are one) and a parabola (some), mesh by mesh. Draws images/stability_uzawa.png.

local finest <const> = tonumber(arg[1]) or 64
local common <const> = include "../../lib/common.lua"
local shapes <const> = { flat = function() return -0.02 end, parabola = function(x) return x^2 / 4 - 0.02 end }

-- 1. The block (-1,1) x (-1,0), held below.
local function block(n, load)
  local body = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = {-1, -1}, to = {1, 0}, cells = {n, n // 2}, element = "Q1" } }
  body:part"bottom":fix()
  if load then body:part"top":load(load) end
  return dotyk.scene{ body }, body
end
local function punched(n, shape)
  local scene, body = block(n)
  return scene, scene:contact{ body:part"top", rigid = dotyk.rigid.gap{ normal = {0, 1}, gap = shapes[shape] } }
end

-- 2. W: the load that falls off linearly from node k to its neighbours makes nodal forces M e_k, M the mass
-- matrix of the top's nodes; column k of WM is the answer, and M is tridiagonal.
local function compliance(n)
  local h, answers = 2 / n, {}
  for k = 0, n do
    local scene, body = block(n, function(x) return 0, math.max(0, 1 - math.abs(x + 1 - k * h) / h) end)
    local s = dotyk.solve(scene)
    answers[k + 1] = {}
    for i = 0, n do
      local _, uy = s:displacement(body, -1 + i * h, 0)
      answers[k + 1][i + 1] = uy
    end
  end
  local W = {}
  for i = 1, n + 1 do -- row i: W_i M = answers_i, by elimination from the left
    local d, r, w = {}, {}, {}
    for k = 1, n + 1 do
      d[k], r[k] = ((k == 1 or k == n + 1) and 1 or 2) * h / 3, answers[k][i]
      if k > 1 then
        local f = h / 6 / d[k - 1]
        d[k], r[k] = d[k] - f * h / 6, r[k] - f * r[k - 1]
      end
    end
    for k = n + 1, 1, -1 do w[k] = (r[k] - (k <= n and h / 6 * w[k + 1] or 0)) / d[k] end
    W[i] = w
  end
  for i = 1, n + 1 do for j = 1, i do assert(math.abs(W[i][j] - W[j][i]) < 1e-9 * W[1][1], "W is not symmetric") end end
  return W
end

-- λ_max(D^½WD^½) on the rows of a list, by power iteration on DW.
local function largest(W, rows)
  local v, value = {}, 0
  for a, i in ipairs(rows) do v[a] = 1 + 0.1 * math.sin(i) end
  for _ = 1, 500 do
    local w, size = {}, 0
    for a, i in ipairs(rows) do
      local sum = 0
      for b, j in ipairs(rows) do sum = sum + W[i][j] * v[b] end
      w[a] = sum / W[i][i]
      size = math.max(size, math.abs(w[a]))
    end
    for a = 1, #rows do v[a] = w[a] / size end
    value = size
  end
  return value
end

-- 3. Bisection for the step, in units of 1/W_rr, and the map of each shape.
local maps, found, theory = {}, {}, {}
for shape in pairs(shapes) do
  maps[shape] = common.map{ "converged", "not converged" }
  found[shape], theory[shape] = common.curve("boundary found", { style = "points" }), common.curve("theory: none beyond", { reference = true })
end
local certain <const> = common.curve("theory: all below", { style = "points" })
local worst, outside, wrong, above = 0, 0, 0, 0
print "shape       n  closed rows  2/λ_max all rows  of the closed rows     found   off [%]  dotyk's own bound"
for n = 8, finest do
  if n & (n - 1) == 0 then
    local W, all = compliance(n), {}
    for i = 1, n + 1 do all[i] = i end
    for _, shape in ipairs{ "flat", "parabola" } do
      local scene, contact = punched(n, shape)
      local exact = dotyk.solver.pdas{}:solve(scene)
      local closed = {}
      for i, node in ipairs(exact:contact(contact).nodes) do
        if node.status ~= "open" then closed[#closed + 1] = math.floor((node.x + 1) * n / 2 + 1.5) end
        assert(i <= n + 1)
      end
      local bound, limit = 2 / largest(W, all), 2 / largest(W, closed)
      local own = tonumber(dotyk.solver.uzawa{ max_iterations = 1 }:solve(scene).reason:match "bound 2/λ_max of ([%d%.e+-]+)")
      local function converges(rho)
        local s = dotyk.solver.uzawa{ rho = rho / own, max_iterations = 10000 }:solve(scene)
        if s.converged and (common.apart(s, exact, contact) > 1e-6 or common.residual(s) > 1e-8) then wrong = wrong + 1 end
        maps[shape]:add(s.converged and "converged" or "not converged", rho / limit, n)
        return s.converged
      end
      for tenth = 2, 16, 2 do converges(limit * tenth / 10) end
      local at = common.boundary(0.5 * limit, 2 * limit, converges, 0.005)
      found[shape]:add(at / limit, n)
      theory[shape]:add(1, n)
      if shape == "flat" then worst = math.max(worst, math.abs(at / limit - 1)) else certain:add(bound / limit, n) end
      outside, above = math.max(outside, at / limit - 1, bound / at - 1), math.max(above, own / bound - 1)
      print(("%-8s  %3d  %11d  %16.5f  %18.5f  %8.5f  %8.2f  %17.5f"):format(shape, n, #closed, bound, limit, at, 100 * (at / limit - 1), own))
    end
  end
end

local panels = {}
for k, shape in ipairs{ "flat", "parabola" } do
  local series = maps[shape]:series()
  table.move({ found[shape], theory[shape], shape == "parabola" and certain or nil }, 1, 3, #series + 1, series)
  panels[k] = { title = shape == "flat" and "Flat punch: all nodes close" or "Parabola: some nodes close", y = "contact cells", log = "y", series = series }
end
dotyk.chart{ file = "images/stability_uzawa.png", x = "step ρ relative to 2/λ_max of the closed nodes", panels = panels, size = { 1000, 900 } }
print "images/stability_uzawa.png"
common.verdict(worst < 0.05 and outside < 0.01 and wrong == 0 and above < 1e-6, ("Uzawa's method ceases to converge at ρ = 2/λ_max "
  .. "where all rows are closed (found within %.1f %%), else between that and 2/λ_max of the closed rows; dotyk measures ρ by a "
  .. "bound that is never above the theory's, and says that it stalls beyond"):format(100 * worst))
