-- Small dense matrices, tables of rows, for scripts. Loaded by include.

local dense = {}

-- Entries f(i, j), or zeros.
function dense.matrix(rows, columns, f)
  local A = {}
  for i = 1, rows do
    A[i] = {}
    for j = 1, columns do A[i][j] = f and f(i, j) or 0 end
  end
  return A
end

function dense.dot(u, v)
  local sum = 0
  for i = 1, #u do sum = sum + u[i] * v[i] end
  return sum
end

function dense.times(A, v) -- Av
  local w = {}
  for i = 1, #A do w[i] = dense.dot(A[i], v) end
  return w
end

function dense.transposed(A) return dense.matrix(#A[1], #A, function(i, j) return A[j][i] end) end

function dense.product(A, B)
  local T = dense.transposed(B)
  return dense.matrix(#A, #T, function(i, j) return dense.dot(A[i], T[j]) end)
end

function dense.sum(A, factor, B) -- A + factor B
  return dense.matrix(#A, #A[1], function(i, j) return A[i][j] + factor * B[i][j] end)
end

function dense.largest(A) -- of the entries' sizes
  local most = 0
  for _, row in ipairs(A) do
    for _, x in ipairs(row) do most = math.max(most, math.abs(x)) end
  end
  return most
end

-- Of a positive definite A = LLᵀ: a function that gives A⁻¹z and Lz.
function dense.solver(A)
  local L = {}
  for i = 1, #A do
    L[i] = {}
    for j = 1, i do
      local x = A[i][j]
      for k = 1, j - 1 do x = x - L[i][k] * L[j][k] end
      L[i][j] = i == j and math.sqrt(x) or x / L[j][j]
    end
  end
  return function(right)
    local x, product = {}, {}
    for i = 1, #L do
      product[i] = dense.dot(L[i], right)
      local y = right[i]
      for k = 1, i - 1 do y = y - L[i][k] * x[k] end
      x[i] = y / L[i][i]
    end
    for i = #L, 1, -1 do
      x[i] = x[i] / L[i][i]
      for k = 1, i - 1 do x[k] = x[k] - L[i][k] * x[i] end
    end
    return x, product
  end
end

-- Eigenvalues of a symmetric matrix, ascending, by Jacobi's rotations.
function dense.eigenvalues(S)
  local A, size = dense.sum(S, 0, S), #S
  repeat
    local off = 0
    for p = 1, size do
      for q = p + 1, size do
        local apq = A[p][q]
        if math.abs(apq) > 1e-18 * math.sqrt(math.abs(A[p][p] * A[q][q])) + 1e-300 then
          off = math.max(off, math.abs(apq))
          local theta = (A[q][q] - A[p][p]) / (2 * apq)
          local t = (theta >= 0 and 1 or -1) / (math.abs(theta) + math.sqrt(theta^2 + 1))
          local c = 1 / math.sqrt(t^2 + 1)
          local s, P, Q = t * c, A[p], A[q]
          local pp, qq = P[p] - t * apq, Q[q] + t * apq
          for k = 1, size do
            local x, y = P[k], Q[k]
            P[k], Q[k] = c * x - s * y, s * x + c * y
            A[k][p], A[k][q] = P[k], Q[k]
          end
          P[p], Q[q], P[q], Q[p] = pp, qq, 0, 0
        end
      end
    end
  until off < 1e-14 * dense.largest(A)
  local values = {}
  for i = 1, size do values[i] = A[i][i] end
  table.sort(values)
  return values
end

return dense
