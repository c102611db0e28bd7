-- Closed forms of square plates, and errors against known deflections. Loaded by include; solves no plate itself.

local plate = {}

local function tanh(x) return 1 - 2 / (math.exp(2 * x) + 1) end
local function cosh(x) return (math.exp(x) + math.exp(-x)) / 2 end

-- The simply supported unit square under q = 1, D = 1 (Lévy's series; Timoshenko and Woinowsky-Krieger 1959, article 30): the
-- deflection and the bending moment in the middle, and the force that holds each corner down.
function plate.simply_supported(nu)
  local w, wxx, wyy, wxy = 0, 0, 0, 0
  for m = 1, 20001, 2 do
    local b <const>, a <const>, turn <const> = m * math.pi, m * math.pi / 2, 1 - (m - 1) % 4
    local size <const> = 4 / (math.pi^5 * m^5)
    local c <const> = a < 300 and cosh(a) or math.huge
    local A <const>, B <const> = (a * tanh(a) + 2) / (2 * c), 1 / (2 * c) -- Y(y) = size (1 - A cosh by + B by sinh by)
    w = w + turn * size * (1 - A)
    wxx = wxx - turn * size * b^2 * (1 - A)
    wyy = wyy + turn * size * b^2 * (2 * B - A)
    wxy = wxy + size * b^2 * (a / c^2 - tanh(a)) / 2
  end
  return { deflection = w, moment = -(wxx + nu * wyy), corner = 2 * (1 - nu) * math.abs(wxy) }
end

-- Gaussian elimination with pivots; b becomes the solution of A x = b.
function plate.solve_linear(A, b)
  for i = 1, #b do
    local pivot = i
    for row = i + 1, #b do
      if math.abs(A[row][i]) > math.abs(A[pivot][i]) then pivot = row end
    end
    A[i], A[pivot], b[i], b[pivot] = A[pivot], A[i], b[pivot], b[i]
    for row = i + 1, #b do
      local factor <const> = A[row][i] / A[i][i]
      for j = i, #b do A[row][j] = A[row][j] - factor * A[i][j] end
      b[row] = b[row] - factor * b[i]
    end
  end
  for i = #b, 1, -1 do
    for j = i + 1, #b do b[i] = b[i] - A[i][j] * b[j] end
    b[i] = b[i] / A[i][i]
  end
  return b
end

-- The clamped unit square under q = 1, D = 1: the simply supported one, bent back by moments Σ E_m (−1)^((m−1)/2) cos mπx along all
-- edges such that these do not turn (same book, article 44). The deflection in the middle, and the moment in the middle of an edge.
function plate.clamped(terms)
  local A, E = {}, {}
  for k = 1, terms do
    local i <const> = 2 * k - 1
    local a <const> = i * math.pi / 2
    local t <const>, s <const> = tanh(a), a > 300 and 0 or a / cosh(a)^2
    A[k] = {}
    for l = 1, terms do
      local m <const> = 2 * l - 1
      A[k][l] = 8 * i / math.pi * m / (m^2 + i^2)^2 + (k == l and (t + s) / i or 0)
    end
    E[k] = 4 / math.pi^3 / i^4 * (s - t)
  end
  plate.solve_linear(A, E)
  local w, moment = plate.simply_supported(0).deflection, 0
  for k = 1, terms do
    local m <const>, a <const>, turn <const> = 2 * k - 1, (2 * k - 1) * math.pi / 2, k % 2 == 1 and 1 or -1
    if a < 300 then w = w + turn * E[k] * a * tanh(a) / (math.pi^2 * m^2 * cosh(a)) end
    moment = moment + turn * E[k]
  end
  return { deflection = w, moment = moment }
end

-- Points and weights of a rule for polynomials of degree 4 on a triangle.
local rule <const> = {}
for _, g in ipairs{ { 0.445948490915965, 0.223381589678011 }, { 0.091576213509771, 0.109951743655322 } } do
  for corner = 1, 3 do
    local at <const> = { g[1], g[1], g[1], weight = g[2] }
    at[corner] = 1 - 2 * g[1]
    rule[#rule + 1] = at
  end
end

-- Distance of the solution s on an n × n mesh of the unit square from a deflection u whose values and second derivatives are given,
-- u(x, y) → u, uxx, uyy, uxy: in the energy norm of D = 1, cell by cell, and in L2, both relative. Slopes are linear on a cell
-- (Morley) or quadratic on its thirds (HCT), so that differences of them within a third are exact.
function plate.distance(s, n, nu, u)
  local step <const> = 0.02 / n
  local energy, size, L2, size2 = 0, 0, 0, 0
  local function add(x, y, weight)
    local w <const>, wxx <const>, wyy <const>, wxy <const> = u(x, y)
    local ax <const>, ay <const> = s:slope(x + step, y)
    local bx <const>, by <const> = s:slope(x - step, y)
    local _ <const>, cy <const> = s:slope(x, y + step)
    local _ <const>, dy <const> = s:slope(x, y - step)
    local function squared(xx, yy, xy) return xx^2 + yy^2 + 2 * nu * xx * yy + 2 * (1 - nu) * xy^2 end
    energy = energy + weight * squared((ax - bx) / (2 * step) - wxx, (cy - dy) / (2 * step) - wyy, (ay - by) / (2 * step) - wxy)
    size = size + weight * squared(wxx, wyy, wxy)
    L2, size2 = L2 + weight * (s:deflection(x, y) - w)^2, size2 + weight * w^2
  end
  local thirds <const> = { { 1, 2 }, { 2, 3 }, { 3, 1 } }
  for i = 0, n - 1 do
    for j = 0, n - 1 do
      for _, px in ipairs{ { 0, 1, 1 }, { 0, 1, 0 } } do
        local py <const> = px[3] == 1 and { 0, 0, 1 } or { 0, 1, 1 }
        local mx <const>, my <const> = (px[1] + px[2] + px[3]) / 3, (py[1] + py[2] + py[3]) / 3
        for _, k in ipairs(thirds) do
          for _, at in ipairs(rule) do
            add((i + at[1] * px[k[1]] + at[2] * px[k[2]] + at[3] * mx) / n, (j + at[1] * py[k[1]] + at[2] * py[k[2]] + at[3] * my) / n, at.weight)
          end
        end
      end
    end
  end
  return math.sqrt(energy / size), math.sqrt(L2 / size2)
end

return plate
