-- Deflections A(x) + B(x) ψ(y) of the unit square, D = 1, ψ = -y²(1 - y)², and the load, moments and forces of the edge that belong
-- to them. Where B' = A' = 0 at x = 0 and 1 the edge does not rotate; the twist u_xy is zero at the corners. Loaded by include; solves no plate.

local known = {}

-- Functions of one variable as five numbers: the value and four derivatives.
function known.polynomial(c) -- c[i] t^(i-1)
  return function(t)
    local out <const> = {}
    for d = 0, 4 do
      local sum = 0
      for i = #c, d + 1, -1 do
        local factor = c[i]
        for k = 0, d - 1 do factor = factor * (i - 1 - k) end
        sum = sum * t + factor
      end
      out[d + 1] = sum
    end
    return out
  end
end
function known.scaled(f, a, slope, shift) -- a f(slope (x - shift))
  return function(x)
    local out <const> = f(slope * (x - shift))
    for d = 0, 4 do out[d + 1] = a * slope^d * out[d + 1] end
    return out
  end
end
function known.none() return { 0, 0, 0, 0, 0 } end
local psi <const> = known.polynomial{ 0, 0, -1, 2, -1 }

-- u, its second derivatives, f = Δ²u, and Tₙu and Mₙu on a side.
function known.deflection(A, B, nu)
  local function parts(x, y) return A(x), B(x), psi(y) end
  local function u(x, y)
    local a <const>, b <const>, p <const> = parts(x, y)
    return a[1] + b[1] * p[1], a[3] + b[3] * p[1], b[1] * p[3], b[2] * p[2]
  end
  local function f(x, y)
    local a <const>, b <const>, p <const> = parts(x, y)
    return a[5] + b[5] * p[1] + 2 * b[3] * p[3] + b[1] * p[5]
  end
  local function T(side, x, y)
    local a <const>, b <const>, p <const> = parts(x, y)
    if side == "left" or side == "right" then
      return (side == "left" and 1 or -1) * (a[4] + b[4] * p[1] + (2 - nu) * b[2] * p[3])
    end
    return (side == "bottom" and 1 or -1) * (b[1] * p[4] + (2 - nu) * b[3] * p[2])
  end
  local function M(side, x, y)
    local _ <const>, xx <const>, yy <const> = u(x, y)
    if side == "left" or side == "right" then return -(xx + nu * yy) end
    return -(yy + nu * xx)
  end
  return { u = u, f = f, T = T, M = M }
end

-- The coordinate s runs along the edge from (0, 0) by (1, 0): the side and the point at s.
known.sides = { "bottom", "right", "top", "left" }
function known.place(s)
  local k <const> = math.min(3, math.floor(s))
  local t <const> = s - k
  return known.sides[k + 1], k == 0 and t or k == 1 and 1 or k == 2 and 1 - t or 0, k == 0 and 0 or k == 1 and t or k == 2 and 1 or 1 - t
end

return known
