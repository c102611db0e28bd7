-- The meshes of the bodies in random scenes, made anew from their description, for finite_elements.lua: nodes are where
-- dotyk.mesh.rectangle, box and disc put them. Loaded by include.
--
-- mesh.facets: all facets of the boundary; mesh.sides[name]: of boxes the facets of each side.

local solids = include "solids.lua"
local meshes = {}

local function permutations(d)
  if d == 2 then return { { 1, 2 }, { 2, 1 } } end
  return { { 1, 2, 3 }, { 1, 3, 2 }, { 2, 1, 3 }, { 2, 3, 1 }, { 3, 1, 2 }, { 3, 2, 1 } }
end

-- Corners, then middles of edges in the order of finite_elements.lua, of places on a lattice of doubled numbers.
local function simplex(corners, order)
  local places = { table.unpack(corners) }
  for b = 2, order == 2 and #corners or 1 do
    for a = 1, b - 1 do
      local middle = {}
      for k, v in ipairs(corners[a]) do middle[k] = (v + corners[b][k]) // 2 end
      table.insert(places, middle)
    end
  end
  return places
end

-- All places of a box of the lattice, the first axis fastest; `extent[k]` 0: none along that axis.
local function lattice(low, extent, order)
  local places = { {} }
  for k, v in ipairs(low) do
    local wider = {}
    for i = 0, extent[k] == 0 and 0 or order do
      for _, p in ipairs(places) do
        local q = { table.unpack(p) }
        q[k] = v + (order == 1 and 2 * i or i)
        table.insert(wider, q)
      end
    end
    places = wider
  end
  return places
end

local side_names <const> = { { { "left", "right" }, { "bottom", "top" } },
                             { { "left", "right" }, { "front", "back" }, { "bottom", "top" } } }

-- A box of cells: each place of the lattice that has a node gets its number.
local function box(body)
  local d <const> = #body.low
  local mesh = { dimension = d, order = tonumber(body.element:sub(2)), simplex = body.element:sub(1, 1) == "P",
                 points = {}, cells = {}, facets = {}, sides = {} }
  local along, number = {}, {}
  for axis, n in ipairs(body.cells) do
    along[axis] = {}
    for k = 0, n do
      local s = k / n
      if body.grading and body.grading.axis == axis then s = s ^ body.grading.power end
      along[axis][2 * k] = body.low[axis] + s * (body.high[axis] - body.low[axis])
      if k > 0 then along[axis][2 * k - 1] = (along[axis][2 * k - 2] + along[axis][2 * k]) / 2 end
    end
  end
  local function node(place)
    local key = 0
    for _, v in ipairs(place) do key = key * 1024 + v end
    if not number[key] then
      local x = {}
      for axis, v in ipairs(place) do x[axis] = along[axis][v] end
      table.insert(mesh.points, x)
      number[key] = #mesh.points
    end
    return number[key]
  end
  local function nodes(places)
    local all = {}
    for k, place in ipairs(places) do all[k] = node(place) end
    return all
  end
  local function add_facet(name, places)
    local facet = nodes(places)
    mesh.sides[name] = mesh.sides[name] or {}
    table.insert(mesh.sides[name], facet)
    table.insert(mesh.facets, facet)
  end
  local function on_side(corners, axis, at)
    for _, c in ipairs(corners) do if c[axis] ~= at then return false end end
    return true
  end
  local function add(corner)
    if not mesh.simplex then
      table.insert(mesh.cells, nodes(lattice(corner, { 2, 2, 2 }, mesh.order)))
      for axis = 1, d do
        for s, name in ipairs(side_names[d - 1][axis]) do
          local low, extent = { table.unpack(corner) }, { 2, 2, 2 }
          extent[axis] = 0
          low[axis] = corner[axis] + (s == 2 and 2 or 0)
          if low[axis] == (s == 2 and 2 * body.cells[axis] or 0) then add_facet(name, lattice(low, extent, mesh.order)) end
        end
      end
      return
    end
    for _, way in ipairs(permutations(d)) do
      local corners = { corner }
      for k, axis in ipairs(way) do
        corners[k + 1] = { table.unpack(corners[k]) }
        corners[k + 1][axis] = corners[k + 1][axis] + 2
      end
      table.insert(mesh.cells, nodes(simplex(corners, mesh.order)))
      for left_out = 1, d + 1 do
        local facet = {}
        for k, c in ipairs(corners) do if k ~= left_out then table.insert(facet, c) end end
        for axis = 1, d do
          for s, name in ipairs(side_names[d - 1][axis]) do
            if on_side(facet, axis, s == 2 and 2 * body.cells[axis] or 0) then add_facet(name, simplex(facet, mesh.order)) end
          end
        end
      end
    end
  end
  local function cells(corner)
    if #corner == d then return add(corner) end
    for k = 0, body.cells[#corner + 1] - 1 do
      local next_corner = { table.unpack(corner) }
      table.insert(next_corner, 2 * k)
      cells(next_corner)
    end
  end
  cells{}
  return mesh
end

-- A disc of cells of order 1: cells of corners, going round, the boundary's edges last in `edges`.
local function rings(n)
  local points, cells, edges = { { 0, 0 } }, {}, {}
  local function at(ring, sector, k)
    if ring == 0 then return 1 end
    return 2 + 3 * ring * (ring - 1) + (sector * ring + k) % (6 * ring)
  end
  for ring = 1, n do
    for k = 0, 6 * ring - 1 do
      local angle = 2 * math.pi * k / (6 * ring) - math.pi / 3
      table.insert(points, { ring / n * math.cos(angle), ring / n * math.sin(angle) })
    end
  end
  for ring = 1, n do
    for sector = 0, 5 do
      for k = 0, ring - 1 do
        local a, b, c = at(ring, sector, k), at(ring, sector, k + 1), at(ring - 1, sector, k)
        table.insert(cells, { a, b, c })
        if ring == n then table.insert(edges, { a, b }) end
        if k + 1 < ring then table.insert(cells, { c, b, at(ring - 1, sector, k + 1) }) end
      end
    end
  end
  return points, cells, edges
end

-- A square core of n × n cells whose sides bulge, and (n + 1) // 2 rings about it.
local function core_and_rings(n)
  local points, cells, edges, rim = {}, {}, {}, {}
  local half <const>, layers <const> = 0.6 / 2 ^ 0.5, (n + 1) // 2
  for j = 0, n do
    for i = 0, n do
      local x, y = half * (2 * i / n - 1), half * (2 * j / n - 1)
      local r = (x * x + y * y) ^ 0.5
      local scale = r > 0 and 0.7 + 0.3 * math.max(math.abs(x), math.abs(y)) * 2 ^ 0.5 / r or 1
      table.insert(points, { x * scale, y * scale })
    end
  end
  local function core(i, j) return j * (n + 1) + i + 1 end
  for j = 0, n - 1 do
    for i = 0, n - 1 do table.insert(cells, { core(i, j), core(i + 1, j), core(i + 1, j + 1), core(i, j + 1) }) end
  end
  for k = 0, n - 1 do
    rim[k], rim[n + k], rim[2 * n + k], rim[3 * n + k] = core(k, 0), core(n, k), core(n - k, n), core(0, n - k)
  end
  for layer = 1, layers do
    for k = 0, 4 * n - 1 do
      local angle, w = 5 * math.pi / 4 + 2 * math.pi * k / (4 * n), layer / layers
      local inner = points[rim[k]]
      table.insert(points, { (1 - w) * inner[1] + w * math.cos(angle), (1 - w) * inner[2] + w * math.sin(angle) })
    end
  end
  local function at(layer, k)
    return layer == 0 and rim[k % (4 * n)] or (n + 1) * (n + 1) + (layer - 1) * 4 * n + k % (4 * n) + 1
  end
  for layer = 0, layers - 1 do
    for k = 0, 4 * n - 1 do
      table.insert(cells, { at(layer, k), at(layer + 1, k), at(layer + 1, k + 1), at(layer, k + 1) })
      if layer == layers - 1 then table.insert(edges, { at(layer + 1, k), at(layer + 1, k + 1) }) end
    end
  end
  return points, cells, edges
end

local function disc(body)
  local simplices <const>, order <const> = body.element:sub(1, 1) == "P", tonumber(body.element:sub(2))
  local points, cells, edges = (simplices and rings or core_and_rings)(body.rings)
  local middles, outer = {}, {}
  local function middle(a, b) -- of an edge, on the circle where the edge is outside
    local key = math.min(a, b) * 65536 + math.max(a, b)
    if not middles[key] then
      local x, y = (points[a][1] + points[b][1]) / 2, (points[a][2] + points[b][2]) / 2
      local r = outer[key] and (x * x + y * y) ^ 0.5 or 1
      table.insert(points, { x / r, y / r, bulge = outer[key] and { x / r - x, y / r - y } })
      middles[key] = #points
    end
    return middles[key]
  end
  for _, e in ipairs(edges) do outer[math.min(e[1], e[2]) * 65536 + math.max(e[1], e[2])] = true end
  local mesh = { dimension = 2, order = order, simplex = simplices, cells = {}, facets = {}, sides = {} }
  for k, c in ipairs(cells) do
    if simplices then
      mesh.cells[k] = order == 1 and c or { c[1], c[2], c[3], middle(c[1], c[2]), middle(c[1], c[3]), middle(c[2], c[3]) }
    elseif order == 1 then
      mesh.cells[k] = { c[1], c[2], c[4], c[3] }
    else
      local m, centre = { middle(c[1], c[2]), middle(c[2], c[3]), middle(c[3], c[4]), middle(c[4], c[1]) }, { 0, 0 }
      for i = 1, 2 do
        for _, corner in ipairs(c) do centre[i] = centre[i] + points[corner][i] / 4 end
        for _, edge in ipairs(m) do centre[i] = centre[i] + (points[edge].bulge and points[edge].bulge[i] / 2 or 0) end
      end
      table.insert(points, centre)
      mesh.cells[k] = { c[1], m[1], c[2], m[4], #points, m[2], c[4], m[3], c[3] }
    end
  end
  for k, e in ipairs(edges) do
    mesh.facets[k] = order == 1 and e or simplices and { e[1], e[2], middle(e[1], e[2]) } or { e[1], middle(e[1], e[2]), e[2] }
  end
  local R <const> = (body.high[1] - body.low[1]) / 2
  mesh.points = {}
  for k, p in ipairs(points) do mesh.points[k] = { body.low[1] + R + R * p[1], body.low[2] + R + R * p[2] } end
  return mesh
end

function meshes.of(scene, body)
  local mesh <const> = (body.disc and disc or box)(body)
  local up <const> = scene.dimension
  for k, x in ipairs(mesh.points) do
    if not body.disc and body.bend ~= 0 then
      local middle, half = (body.low[1] + body.high[1]) / 2, (body.high[1] - body.low[1]) / 2
      local bulge = body.bend * (((x[1] - middle) / half) ^ 2 - (body.bend < 0 and 1 or 0))
      x[up] = x[up] + bulge * (body.high[up] - x[up]) / (body.high[up] - body.low[up])
    end
    if scene.angle ~= 0 and body.disc then -- the disc's centre is turned, its mesh is not
      local c, turned = { body.low[1], body.low[2] }, nil
      local R = (body.high[1] - body.low[1]) / 2
      c[1], c[2] = c[1] + R, c[2] + R
      turned = solids.turn(scene, c)
      mesh.points[k] = { x[1] - c[1] + turned[1], x[2] - c[2] + turned[2] }
    else
      mesh.points[k] = solids.turn(scene, x)
    end
  end
  return mesh
end

return meshes
