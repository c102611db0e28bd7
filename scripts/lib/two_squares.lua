-- The matrices of Alesawi's experiment (ODAM 2001, 5–14, section 6), for scripts/papers/alesawi/augmented_lagrangian.lua and
-- scripts/papers/alesawi/raised_penalties.lua: −Δu = P on two unit squares side by side, u = 0 on the far sides, glued along x = 1 by the rows Dx = 0.
--
--   local B, D, unknown = include "two_squares.lua"(nodes)
--
-- `nodes` a side of each square. B: five-point differences of −Δ times h², half a spring along the edges of a square. unknown(square, i, j)
-- with i, j = 0 to nodes − 1: the number of a node's unknown, nil where u = 0. Square 1 has the columns x = h to 1, square 2 x = 1 to 2 − h.
local function add(matrix, i, j, value)
  local k = #matrix.i + 1
  matrix.i[k], matrix.j[k], matrix.value[k] = i, j, value
end

return function(nodes)
  local function unknown(square, i, j)
    local column = square == 1 and i - 1 or i
    if column < 0 or column > nodes - 2 then return nil end
    return (square - 1) * (nodes - 1) * nodes + column * nodes + j + 1
  end
  local B, D = { i = {}, j = {}, value = {} }, { i = {}, j = {}, value = {} }
  local function spring(a, b, weight)
    if a then add(B, a, a, weight) end
    if b then add(B, b, b, weight) end
    if a and b then add(B, a, b, -weight) add(B, b, a, -weight) end
  end
  for square = 1, 2 do
    for i = 0, nodes - 2 do
      for j = 0, nodes - 2 do
        local here, right = unknown(square, i, j), unknown(square, i + 1, j)
        local up, across = unknown(square, i, j + 1), unknown(square, i + 1, j + 1)
        spring(here, right, 0.5) spring(up, across, 0.5) spring(here, up, 0.5) spring(right, across, 0.5)
      end
    end
  end
  for j = 0, nodes - 1 do
    add(D, j + 1, unknown(1, nodes - 1, j), 1)
    add(D, j + 1, unknown(2, 0, j), -1)
  end
  return B, D, unknown
end
