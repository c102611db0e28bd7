-- What the contacts of a scene measure of rigid motions: gaps and slips at their nodes where bodies are moved as rigid ones, one
-- motion at a time, with the obstacles far away. On plane sides that is known beforehand; on curved ones conditions are means of
-- places beside the node. Loaded by include; returns probe(scene, run, sides, motion, modes).

-- Bodies and contacts of the scene alone, contacts moved apart.
local function bare(scene)
  local lines, contacts, bodies = {}, {}, {}
  local far <const> = 10 + 10 * scene.extent / scene.size -- motions are of order 1
  table.insert(lines, ("local function apart(scene, t) t.gap = (t.gap or 0) + %.17g return scene:contact(t) end"):format(far))
  for _, line in ipairs(scene.lines) do
    if line:find "^local function" or line:find "^local b%d" or line:find "^local scene" then table.insert(lines, line) end
    if line:find "^local c%d" then table.insert(lines, (line:gsub("scene:contact(%b{})", "apart(scene, %1)"))) end
  end
  for k, contact in ipairs(scene.contacts) do contacts[k] = contact.name end
  for k, body in ipairs(scene.bodies) do bodies[k] = body.name end
  table.insert(lines, ("return { scene = scene, contacts = { %s }, bodies = { %s } }"):format(table.concat(contacts, ", "),
    table.concat(bodies, ", ")))
  return lines
end

-- Nodes of all contacts where the boundary of body `b` moves by velocity(x, y, z), that of the others not at all.
local function nodes_moved(scene, run, lines, sides, b, velocity)
  local made = run(lines)
  for k, body in ipairs(made.bodies) do
    local components = {}
    for i = 1, scene.dimension do
      components[("xyz"):sub(i, i)] = function(...) return k == b and velocity({ ... })[i] or 0 end
    end
    for _, side in ipairs(sides(scene.bodies[k])) do body:part(side):displace(components) end
  end
  local s, nodes = dotyk.solve(made.scene), {}
  for k, contact in ipairs(made.contacts) do nodes[k] = s:contact(contact).nodes end
  return nodes
end

-- Rows of contact → node: `normal` (how much it closes the gap) and `slip` (a row each component), as amounts of all motions.
-- `motion(b, mode)` is a velocity, `modes` how many a body has; `sides(body)` names the parts that make its boundary.
return function(scene, run, sides, motion, modes)
  local lines <const>, rows = bare(scene), {}
  local rest <const> = nodes_moved(scene, run, lines, sides, 0)
  for k, nodes in ipairs(rest) do
    rows[k] = {}
    for i in ipairs(nodes) do
      rows[k][i] = { normal = {}, slip = {} }
      for c = 1, scene.dimension do rows[k][i].slip[c] = {} end
    end
  end
  for b in ipairs(scene.bodies) do
    for mode = 1, modes do
      for k, nodes in ipairs(nodes_moved(scene, run, lines, sides, b, motion(b, mode))) do
        for i, node in ipairs(nodes) do
          local at <const>, row = (b - 1) * modes + mode, rows[k][i]
          row.normal[at] = rest[k][i].gap - node.gap
          for c = 1, scene.dimension do row.slip[c][at] = node.slip[c] end
        end
      end
    end
  end
  return rows
end
