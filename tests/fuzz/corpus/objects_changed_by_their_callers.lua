-- Functions given to a method that change the very object: mesh:keep read the mesh that transform had replaced,
-- refinement:project walked the facets of the mesh before its refinement.
local refused <const> = require "refused"
local mesh <const> = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {4, 4} }
local kept <const> = mesh:keep(function(x)
  mesh:transform(function(u, v) return u + 1, v end)
  collectgarbage()
  return x < 0.5
end)
assert(kept.cell_count == 16, kept.cell_count) -- chosen from the mesh as it was

local refinement <const> = dotyk.refinement{ dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {2, 2} } }
refinement:refine()
local before <const> = refinement.meshes[1].cell_count
refused(function()
  refinement:project("bottom", function(x, y)
    refinement:refine()
    return x, y
  end)
end, "the meshes were refined or projected by the function that says where nodes go")
assert(refinement.meshes[1].cell_count > before)
refinement:refine():project("bottom", function(x, y) return x, y end)
