-- Finite elements of linear elasticity for scripts that check the program's own: P1, P2, Q1, Q2 in the plane and in
-- space, by their definition and without a matrix. Loaded by include; knows nothing of the program.
--
-- A mesh is { dimension, order, simplex, points = { {x, y[, z]}, … }, cells = { {node, …}, … } }. Nodes of a cell: of
-- simplices the corners, then the middles of edges in the order of pairs (1,2), (1,3), (2,3), (1,4), …; of tensor cells
-- those of a lattice, the first axis fastest. Facets are cells of the same family of one dimension less.

local fem = {}

local gauss <const> = { { { 0, 2 } }, { { -3 ^ -0.5, 1 }, { 3 ^ -0.5, 1 } },
                        { { -0.6 ^ 0.5, 5 / 9 }, { 0, 8 / 9 }, { 0.6 ^ 0.5, 5 / 9 } } }

-- 1. Shape functions: values N[a] and derivatives D[a][k] along the k-th reference coordinate.

-- On (0, …) (1, 0, …) …; λ_a, or λ_a (2 λ_a - 1) and 4 λ_a λ_b.
local function simplex_shape(d, order, x)
  local l, slope = { 1 }, { {} }
  for k = 1, d do l[1], l[k + 1], slope[1][k], slope[k + 1] = l[1] - x[k], x[k], -1, {} end
  for a = 2, d + 1 do for k = 1, d do slope[a][k] = a == k + 1 and 1 or 0 end end
  if order == 1 then return l, slope end
  local N, D = {}, {}
  local function add(value, derivative)
    table.insert(N, value)
    table.insert(D, {})
    for k = 1, d do D[#D][k] = derivative(k) end
  end
  for a = 1, d + 1 do add(l[a] * (2 * l[a] - 1), function(k) return (4 * l[a] - 1) * slope[a][k] end) end
  for b = 2, d + 1 do
    for a = 1, b - 1 do add(4 * l[a] * l[b], function(k) return 4 * (slope[a][k] * l[b] + l[a] * slope[b][k]) end) end
  end
  return N, D
end

local function line(order, x)
  if order == 1 then return { (1 - x) / 2, (1 + x) / 2 }, { -0.5, 0.5 } end
  return { x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2 }, { x - 0.5, -2 * x, x + 0.5 }
end

-- On [-1, 1]^d.
local function tensor_shape(d, order, x)
  local N, D = { 1 }, { {} }
  for axis = 1, d do
    local value, slope = line(order, x[axis])
    local wider, derivatives = {}, {}
    for i = 1, order + 1 do
      for a, n in ipairs(N) do
        table.insert(wider, n * value[i])
        local row = {}
        for k = 1, axis - 1 do row[k] = D[a][k] * value[i] end
        row[axis] = n * slope[i]
        table.insert(derivatives, row)
      end
    end
    N, D = wider, derivatives
  end
  return N, D
end

-- 2. Points of integration { x, weight }: Gauss's, `order + 1` along each axis of tensor cells, as these elements are
-- defined; simplices by Gauss's points on a cube that collapses to them, exact to degree 6 - d.
local function points(simplex, d, order)
  local all = { { x = {}, weight = 1 } }
  for axis = 1, d do
    local wider = {}
    for _, p in ipairs(all) do
      for _, g in ipairs(gauss[simplex and 3 or order + 1]) do
        local x = { table.unpack(p.x) }
        x[axis] = g[1]
        table.insert(wider, { x = x, weight = p.weight * g[2] })
      end
    end
    all = wider
  end
  for _, p in ipairs(simplex and all or {}) do
    local left = 1
    for axis = 1, d do
      local s = (1 + p.x[axis]) / 2
      p.x[axis], p.weight = left * s, p.weight * left / 2
      left = left * (1 - s)
    end
  end
  return all
end

-- Those of the stiffness of simplices of order 2: no rule is exact where they are curved, and these are the ones that
-- define them, by Dunavant (1985) and Walkington (2000), of degree 4 in the plane and 5 in space.
local function symmetric(d)
  local all = {}
  local function add(weight, low, high, first, second) -- barycentric coordinates `high` but for those of one or two corners
    local x = {}
    for k = 1, d do x[k] = (k + 1 == first or k + 1 == second) and low or high end
    table.insert(all, { x = x, weight = weight })
  end
  local near <const> = d == 2 and { { 0.22338158967801146570 / 2, 0.44594849091596488632 }, { 0.10995174365532186764 / 2, 0.09157621350977074346 } }
    or { { 0.11268792571801585080 / 6, 0.31088591926330060980 }, { 0.07349304311636194954 / 6, 0.09273525031089122640 } }
  for _, rule in ipairs(near) do
    for corner = 1, d + 1 do add(rule[1], 1 - d * rule[2], rule[2], corner) end
  end
  local a <const> = 0.04550370412564964949
  for second = 2, d == 3 and 4 or 0 do
    for first = 1, second - 1 do add(0.04254602077708146644 / 6, a, 0.5 - a, first, second) end
  end
  return all
end

local known <const> = {}
local function rule(mesh, d, of_stiffness)
  local own <const> = of_stiffness and mesh.simplex and mesh.order == 2
  local key = (mesh.simplex and "P" or "Q") .. mesh.order .. d .. (own and "own" or "")
  if not known[key] then
    known[key] = own and symmetric(d) or points(mesh.simplex, d, mesh.order)
    local shape <const> = mesh.simplex and simplex_shape or tensor_shape
    for _, p in ipairs(known[key]) do p.N, p.D = shape(d, mesh.order, p.x) end
  end
  return known[key]
end

-- 3. Integrals

-- Σ over the nodes of values[node][i] ∂N/∂ξ_k, rows i.
local function derivatives(cell, values, D, rows, columns)
  local J = {}
  for i = 1, rows do
    J[i] = {}
    for k = 1, columns do
      local sum = 0
      for a, node in ipairs(cell) do sum = sum + values[node][i] * D[a][k] end
      J[i][k] = sum
    end
  end
  return J
end

local function inverse(J)
  if #J == 2 then
    local det = J[1][1] * J[2][2] - J[1][2] * J[2][1]
    return { { J[2][2] / det, -J[1][2] / det }, { -J[2][1] / det, J[1][1] / det } }, math.abs(det)
  end
  local C = { {}, {}, {} }
  for i = 1, 3 do
    for k = 1, 3 do
      local i1, i2, k1, k2 = i % 3 + 1, (i + 1) % 3 + 1, k % 3 + 1, (k + 1) % 3 + 1
      C[k][i] = J[i1][k1] * J[i2][k2] - J[i1][k2] * J[i2][k1]
    end
  end
  local det = J[1][1] * C[1][1] + J[1][2] * C[2][1] + J[1][3] * C[3][1]
  for i = 1, 3 do for k = 1, 3 do C[i][k] = C[i][k] / det end end
  return C, math.abs(det)
end

-- Length or area of a facet per reference length or area.
local function measure(J)
  if #J == 2 then return (J[1][1] ^ 2 + J[2][1] ^ 2) ^ 0.5 end
  local square = 0
  for i = 1, 3 do
    local j, k = i % 3 + 1, (i + 1) % 3 + 1
    square = square + (J[j][1] * J[k][2] - J[k][1] * J[j][2]) ^ 2
  end
  return square ^ 0.5
end

local function zeros(mesh)
  local forces = {}
  for node in ipairs(mesh.points) do forces[node] = mesh.dimension == 2 and { 0, 0 } or { 0, 0, 0 } end
  return forces
end

-- Lamé's parameters; `plane`: "stress" or "strain".
function fem.lame(E, nu, plane)
  local lambda <const>, mu <const> = E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))
  return plane == "stress" and 2 * lambda * mu / (lambda + 2 * mu) or lambda, mu
end

-- Nodal forces K u and the energy ½ uᵀKu, of u[node] = { x, y[, z] }; and of each node (2μ + λ) ∫ |∇N|², the size
-- of K's entries there.
function fem.inner_forces(mesh, lambda, mu, u)
  local d <const>, forces <const>, stiffness <const>, energy = mesh.dimension, zeros(mesh), {}, 0
  for node in ipairs(mesh.points) do stiffness[node] = 0 end
  for _, cell in ipairs(mesh.cells) do
    for _, p in ipairs(rule(mesh, d, true)) do
      local inv, det = inverse(derivatives(cell, mesh.points, p.D, d, d))
      local H, g, trace, s, q = derivatives(cell, u, p.D, d, d), {}, 0, {}, {}
      for i = 1, d do
        g[i] = {}
        for j = 1, d do
          g[i][j] = 0
          for k = 1, d do g[i][j] = g[i][j] + H[i][k] * inv[k][j] end
        end
        trace = trace + g[i][i]
      end
      local weight, square = p.weight * det, 0
      for i = 1, d do
        s[i], q[i] = {}, {}
        for j = 1, d do
          local e = (g[i][j] + g[j][i]) / 2
          s[i][j] = weight * (2 * mu * e + (i == j and lambda * trace or 0))
          square = square + e * e
        end
        for k = 1, d do
          q[i][k] = 0
          for j = 1, d do q[i][k] = q[i][k] + s[i][j] * inv[k][j] end
        end
      end
      energy = energy + weight * (mu * square + lambda * trace * trace / 2)
      for a, node in ipairs(cell) do
        local steep, D, force = 0, p.D[a], forces[node]
        for i = 1, d do
          local f, slope = 0, 0
          for k = 1, d do f, slope = f + q[i][k] * D[k], slope + inv[k][i] * D[k] end
          force[i], steep = force[i] + f, steep + slope * slope
        end
        stiffness[node] = stiffness[node] + weight * (2 * mu + lambda) * steep
      end
    end
  end
  return forces, energy, stiffness
end

local function place(mesh, cell, N)
  local x = {}
  for i = 1, mesh.dimension do
    x[i] = 0
    for a, node in ipairs(cell) do x[i] = x[i] + N[a] * mesh.points[node][i] end
  end
  return x
end

-- Adds ∫ f(x) N over `cells`, those of the mesh or facets of its boundary, to forces; f(x, N, cell) may look at the
-- cell's nodes.
function fem.add_load(mesh, cells, f, forces)
  if #cells == 0 then return forces end
  local d <const> = #cells[1] == #mesh.cells[1] and mesh.dimension or mesh.dimension - 1
  for _, cell in ipairs(cells) do
    for _, p in ipairs(rule(mesh, d)) do
      local J = derivatives(cell, mesh.points, p.D, mesh.dimension, d)
      local size, load = p.weight, f(place(mesh, cell, p.N), p.N, cell)
      if d == mesh.dimension then size = size * select(2, inverse(J)) else size = size * measure(J) end
      for a, node in ipairs(cell) do
        for i, v in ipairs(load) do forces[node][i] = forces[node][i] + size * p.N[a] * v end
      end
    end
  end
  return forces
end

-- The value at a place of a cell of what is given at its nodes.
function fem.value(values, cell, N)
  local v = {}
  for i in ipairs(values[cell[1]]) do
    v[i] = 0
    for a, node in ipairs(cell) do v[i] = v[i] + N[a] * values[node][i] end
  end
  return v
end

fem.zeros = zeros

return fem
