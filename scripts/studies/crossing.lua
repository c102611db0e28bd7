-- Where multigrid overtakes factors, and whether the default method sees it.
--
--   OPENBLAS_NUM_THREADS=1 ./dotyk scripts/studies/crossing.lua [LEAST [MOST]]
--
-- Over forty scenes from 10³ to 10⁶ unknowns (from LEAST to MOST, 2000 and 20000 unless given), in the plane and in space, with and without friction, one
-- body and two, meshes with and without coarser ones, nearly incompressible material and stretched cells. Seconds of each method, by factors pdas, pdas on all
-- unknowns or newton, and how much longer the default method takes than the fastest. Solves are repeated, and the least time is taken; what the first solve by
-- multigrid takes to open its library is added, as a process that solves one scene takes it.

local least <const>, most <const> = tonumber(arg[1] or 2000), tonumber(arg[2] or 20000)
local S <const> = dotyk.solver

-- 1. Scenes.
local shared <const> = include "../lib/scale_scenes.lua"
local cube <const>, blocks <const> = shared.cube, shared.blocks

local function square(n, o)
  o = o or {}
  local body <const> = dotyk.body{ material = dotyk.material{ E = 1000, nu = 0.3 }, mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {n, n} } }
  body:part"bottom":fix()
  local scene <const> = dotyk.scene{ body }
  local parabola <const> = dotyk.rigid.gap{ normal = {0, 1}, gap = function(x) return (x - 0.5)^2 / 2 - 0.02 end }
  scene:contact{ body:part"top", rigid = parabola, interference = true, friction = o.friction and dotyk.friction.coulomb(o.friction) }
  return scene
end

-- A quarter of a ball of radius 10 in a quarter of its socket, from Gmsh, with edges h.
local function ball(h, o)
  local function body(name, geometry)
    local mesh <const> = dotyk.mesh.gmsh{ text = ("SetFactory(\"OpenCASCADE\"); Mesh.MeshSizeMax = %g; %s"):format(h, geometry) }
    local b <const> = dotyk.body{ name = name, material = dotyk.material{ E = 210e3, nu = 0.3 }, mesh = mesh }
    b:part("x", function(x) return math.abs(x) < 1e-6 end):slide()
    b:part("y", function(_, y) return math.abs(y) < 1e-6 end):slide()
    return b
  end
  local socket <const> = body("socket", "Box(1) = {0, 0, -18, 18, 18, 18}; Sphere(2) = {0, 0, 0, 10}; BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };")
  local sphere <const> = body("ball", "Sphere(1) = {0, 0, -0.05, 9.95}; Box(2) = {0, 0, -12, 12, 12, 12}; BooleanIntersection(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };")
  socket:part("base", function(_, _, z) return math.abs(z + 18) < 1e-6 end):fix()
  sphere:part("top", function(_, _, z) return math.abs(z) < 1e-6 end):load{ 0, 0, -150 }
  local function round(radius, z0)
    return function(x, y, z, nx, ny, nz)
      local dz <const> = z - z0
      local r <const> = math.sqrt(x^2 + y^2 + dz^2)
      return math.abs(r / radius - 1) < 0.02 and math.abs(x * nx + y * ny + dz * nz) > 0.9 * r
    end
  end
  local scene <const> = dotyk.scene{ socket, sphere }
  scene:contact{ sphere:part("sphere", round(9.95, -0.05)), socket:part("bowl", round(10, 0)), interference = true, friction = o.friction and dotyk.friction.coulomb(o.friction) }
  return scene
end

local scenes <const> = {
  -- name, about so many unknowns, what makes it, its arguments
  { "square 24", 1200, square, 24 }, { "square 64", 8320, square, 64 }, { "square 128", 33e3, square, 128 }, { "square 256", 132e3, square, 256 },
  { "square 512", 525e3, square, 512 }, { "square 64, Coulomb", 8320, square, 64, { friction = 0.3 } }, { "square 256, Coulomb", 132e3, square, 256, { friction = 0.3 } },
  { "cube 8", 1944, cube, 8 }, { "cube 12", 6084, cube, 12 }, { "cube 16", 13872, cube, 16 }, { "cube 20", 26460, cube, 20 }, { "cube 24", 45e3, cube, 24 },
  { "cube 32", 104e3, cube, 32 }, { "cube 40", 202e3, cube, 40 }, { "cube 64", 811e3, cube, 64 },
  { "cube 8, Coulomb", 1944, cube, 8, { friction = 0.3 } }, { "cube 16, Coulomb", 13872, cube, 16, { friction = 0.3 } }, { "cube 24, Coulomb", 45e3, cube, 24, { friction = 0.3 } },
  { "cube 32, Coulomb", 104e3, cube, 32, { friction = 0.3 } }, { "cube 16, loaded", 13872, cube, 16, { linear = true } }, { "cube 32, loaded", 104e3, cube, 32, { linear = true } },
  { "cube 16, nu = 0.49", 13872, cube, 16, { nu = 0.49 } }, { "cube 24, nu = 0.499", 45e3, cube, 24, { nu = 0.499 } },
  { "cube 16, height 8", 13872, cube, 16, { height = 8 } }, { "cube 24, height 1/8", 45e3, cube, 24, { height = 1 / 8 } },
  { "hexahedra 24", 45e3, cube, 24, { element = "Q1" } }, { "cube 12, order 2", 45e3, cube, 12, { element = "P2" } },
  { "blocks 16", 11e3, blocks, 16, {} }, { "blocks 32", 100e3, blocks, 32, {} }, { "blocks 32, glued", 100e3, blocks, 32, { linear = true } },
  { "blocks 24, Coulomb", 40e3, blocks, 24, { friction = 0.3 } }, { "ball, h = 2", 2.6e3, ball, 2, {} }, { "ball, h = 1.2", 9.9e3, ball, 1.2, {} },
  { "ball, h = 0.8", 32e3, ball, 0.8, {} }, { "ball, h = 0.6", 70e3, ball, 0.6, {} }, { "ball, h = 1.2, Coulomb", 9.9e3, ball, 1.2, { friction = 0.2 } },
  -- Odd numbers of cells: there are no coarser meshes, but of order 1 where these are of order 2.
  { "cube 17", 17e3, cube, 17 }, { "cube 23", 40e3, cube, 23 }, { "cube 31", 95e3, cube, 31 }, { "cube 23, Coulomb", 40e3, cube, 23, { friction = 0.3 } },
  { "cube 31, Coulomb", 95e3, cube, 31, { friction = 0.3 } }, { "cube 25, loaded", 51e3, cube, 25, { linear = true } }, { "hexahedra 23", 40e3, cube, 23, { element = "Q1" } },
  { "cube 11, order 2", 35e3, cube, 11, { element = "P2" } }, { "square 301", 182e3, square, 301 }, { "blocks 23", 37e3, blocks, 23, {} },
}

-- 2. Seconds.
local opening = 0
local function seconds(make, method)
  local best, used, count = math.huge, 0, 0
  repeat
    local scene <const> = make()
    local ok <const>, s = pcall(function() return method and method:solve(scene) or dotyk.solve(scene) end)
    if not method then assert(ok, s) end
    if not ok or not s.converged then return nil end
    best, used, count = math.min(best, s.time.total), used + s.time.total, count + 1
    -- The first of several pays for memory that the process has not used before.
    if (used > 2 and count > 2) or used > 20 or count == 5 then return best + (s.method == "multigrid" and opening or 0), s.unknowns, s.method end
  until false
end
do
  local first <const> = S.multigrid{}:solve(cube(8)).time.total
  opening = first - seconds(function() return cube(8) end, S.multigrid{})
  print(("The library of multigrid is opened in %.2f s.\n"):format(opening))
end

local methods <const> = { { "pdas", S.pdas{} }, { "all unknowns", S.pdas{ reduced = false } }, { "newton", S.newton{} }, { "multigrid", S.multigrid{} } }
print(("%-24s%9s%10s  %-16s%10s%14s%10s%11s%9s"):format("scene", "unknowns", "default", "by", "pdas", "all unknowns", "newton", "multigrid", "longer"))
local worst = 1
for _, entry in ipairs(scenes) do
  local name <const>, about <const> = entry[1], entry[2]
  if least <= about and about <= most then
    local function make() return entry[3](entry[4], entry[5]) end
    local default <const>, unknowns <const>, by <const> = seconds(make)
    local line, fastest = ("%-24s%9d%9.3fs  %-16s"):format(name, unknowns, default, by), default
    for k, method in ipairs(methods) do
      local factors <const> = k < 4
      local fits <const> = (not factors or about < (entry[3] == square and 1e6 or 250e3)) and (k ~= 1 or not (entry[5] and entry[5].friction))
      local t <const> = fits and seconds(make, method[2]) or nil
      if t then fastest = math.min(fastest, t) end
      line = line .. (k == 2 and "%14s" or k == 4 and "%11s" or "%10s"):format(t and ("%.3f"):format(t) or "-")
    end
    worst = math.max(worst, default / fastest)
    print(line .. ("%9.2f"):format(default / fastest))
  end
end
print(("The default method takes at most %.2f times as long as the fastest."):format(worst))
