-- What contact costs on parts with free meshes: four of them from Gmsh, against one linear solve of the same bodies glued.
--
--   OPENBLAS_NUM_THREADS=1 ./dotyk scripts/studies/bench/gmsh_parts.lua [NODES…] [PARTS…] [aggregates|factors] [runs=5]
--
-- A lug on a pin, a ball in a socket, a pipe's flange on its gasket and a wheel on a rail, P1, quarters or sectors of them, meshes that do not match.
-- Each body is meshed from a STEP file, which Gmsh's library has written; c++ and Gmsh's headers are needed for that. The bodies are
-- glued, frictionless, and with Coulomb's coefficient 0.2; by the default method, or by the one that a word names: aggregates (algebraic multigrid) or
-- factors. For each: seconds of the solve, times the glued bodies', and iterations (of conjugate gradients, too, by multigrid); and the most memory that
-- the process has had. The three are taken in turn, runs= times, 1 unless given; medians of the seconds and of the runs' ratios.
-- NODES, 10000 unless given, are met to 3 %; more than 20000 of them to about a sixth. PARTS: some of lug, ball, flange and wheel, all of them unless given.

local sizes <const>, names, method, runs = {}, {}, nil, 1
for _, word in ipairs(arg) do
  if word:match "^runs=[1-9]%d*$" then runs = tonumber(word:match "%d+")
  elseif tonumber(word) then sizes[#sizes + 1] = tonumber(word)
  elseif word == "aggregates" then method = dotyk.solver.multigrid{ levels = "aggregates" }
  elseif word == "factors" then method = dotyk.solver.pdas{ linear = "factor" }
  else names[#names + 1] = word end
end
if #sizes == 0 then sizes[1] = 10000 end
if #names == 0 then names = { "lug", "ball", "flange", "wheel" } end
local peak_memory <const>, median <const> = include "../../lib/peak_memory.lua", include "../../lib/punch_scenes.lua".median
local steel <const> = dotyk.material{ E = 210e3, nu = 0.3 }

-- 1. Bodies. A geometry in Gmsh's language becomes a STEP file; what Gmsh reads from that is meshed, with the greatest edge h where bodies touch.
-- dotyk does not let Gmsh write files, so a small program writes the STEP file.
local scratch <close> = setmetatable({ name = os.tmpname(), count = 0 }, { __close = function(all) os.execute(("rm -rf %s %s.*"):format(all.name, all.name)) end })
local function ran(command) assert(os.execute(command), "this has failed: " .. command) end
local function write(file, text)
  local out <close> = assert(io.open(file, "w"))
  out:write(text)
end
write(scratch.name .. ".cpp", [[
#include <gmsh.h>
int main(int, char** files) {
  gmsh::initialize(), gmsh::merge(files[1]), gmsh::write(files[2]);
}
]])
ran(("c++ %s.cpp -lgmsh -o %s"):format(scratch.name, scratch.name .. ".exe"))

local steps <const> = {}
local function step(geometry)
  if not steps[geometry] then
    scratch.count = scratch.count + 1
    local file <const> = scratch.name .. "." .. scratch.count
    write(file .. ".geo", "SetFactory(\"OpenCASCADE\");\n" .. geometry .. "\n")
    ran(("%s.exe %s.geo %s.step >/dev/null"):format(scratch.name, file, file))
    steps[geometry] = file .. ".step"
  end
  return steps[geometry]
end
local function body(name, geometry, sizes, h, material)
  local text <const> = ("SetFactory(\"OpenCASCADE\"); Merge \"%s\"; Mesh.MeshSizeExtendFromBoundary = 0; h = %.9g;\n%s"):format(step(geometry), h, sizes)
  return dotyk.body{ name = name, mesh = dotyk.mesh.gmsh{ text = text }, material = material or steel }
end

-- Edges grow from h at a point with the distance from it.
local function graded(x, y, z, near, far, times)
  return ([[
    Field[1] = Ball; Field[1].XCenter = %g; Field[1].YCenter = %g; Field[1].ZCenter = %g;
    Field[1].Radius = %g; Field[1].Thickness = %g; Field[1].VIn = h; Field[1].VOut = %g * h;
    Background Field = 1;
  ]]):format(x, y, z, near, far, times)
end
local function even(times) return ("Mesh.MeshSizeMax = %g * h; Mesh.MeshSizeMin = %g * h;\n"):format(times, times) end

-- Facets at a coordinate; facets at a distance from a point or from an axis along z.
local function at(axis, value) return function(...) return math.abs((select(axis, ...)) - value) < 1e-6 end end
local function round(radius, cx, cz)
  return function(x, y, z, nx, ny, nz)
    local dx <const>, dz <const> = x - cx, cz and z - cz or 0
    local r <const> = math.sqrt(dx^2 + y^2 + dz^2)
    return math.abs(r / radius - 1) < 0.02 and math.abs(dx * nx + y * ny + dz * nz) > 0.9 * r
  end
end

-- 2. The parts: bodies, and what touches. Glued they have no clearance, and a smaller patch of the wheel: only parts that touch are glued.
local parts <const> = {}

-- Half of a lug, half of its thickness, is pulled along x against half of a pin that is held at its end.
function parts.lug(h, glued)
  local gap <const> = glued and 0 or 0.02
  local lug = body("lug", [[
    Cylinder(1) = {0, 0, 0, 0, 0, 5, 20, Pi};  Box(2) = {0, 0, 0, 45, 20, 5};  Cylinder(3) = {0, 0, 0, 0, 0, 5, 10, Pi};
    BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
    BooleanDifference(5) = { Volume{4}; Delete; }{ Volume{3}; Delete; };]], graded(0, 0, 0, 11, 20, 3), h)
  local pin = body("pin", ("Cylinder(1) = {%g, 0, 0, 0, 0, 8, %g, Pi};"):format(-gap, 10 - gap), even(1.2), h)
  for _, b in ipairs{ lug, pin } do
    b:part("middle", at(3, 0)):slide()
    b:part("axis", at(2, 0)):slide()
  end
  pin:part("end", at(3, 8)):fix()
  lug:part("pull", at(1, 45)):load{ 100, 0, 0 }
  return { lug, pin }, { lug:part("hole", round(10, 0)), pin:part("shank", round(10 - gap, -gap)) }
end

-- A quarter of a ball is pressed into a quarter of its socket.
function parts.ball(h, glued)
  local gap <const> = glued and 0 or 0.05
  local socket = body("socket", [[
    Box(1) = {0, 0, -18, 18, 18, 18};  Sphere(2) = {0, 0, 0, 10};
    BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };]], graded(0, 0, 0, 11, 10, 3), h)
  local ball = body("ball", ("Sphere(1) = {0, 0, %g, %g};"):format(-gap, 10 - gap) .. [[
    Box(2) = {0, 0, -12, 12, 12, 12};
    BooleanIntersection(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };]], even(1.2), h)
  for _, b in ipairs{ socket, ball } do
    b:part("x", at(1, 0)):slide()
    b:part("y", at(2, 0)):slide()
  end
  socket:part("base", at(3, -18)):fix()
  ball:part("top", at(3, 0)):load{ 0, 0, -150 }
  return { ball, socket }, { ball:part("sphere", round(10 - gap, 0, -gap)), socket:part("bowl", round(10, 0, 0)) }
end

-- A sector of 45° between bolts and half of the gasket, which is soft; the bolt presses round its hole, the fluid pushes off and out.
function parts.flange(h)
  local flange = body("flange", [[
    Cylinder(1) = {0, 0, 0, 0, 0, 12, 60, Pi / 4};  Cylinder(2) = {0, 0, 0, 0, 0, 45, 36, Pi / 4};  Cylinder(3) = {0, 0, 0, 0, 0, 45, 30, Pi / 4};
    Cylinder(4) = {48 * Cos(Pi / 8), 48 * Sin(Pi / 8), 0, 0, 0, 12, 4.5};
    BooleanUnion(5) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
    BooleanDifference(6) = { Volume{5}; Delete; }{ Volume{3, 4}; Delete; };]], even(1.5), h)
  local gasket = body("gasket", [[
    Cylinder(1) = {0, 0, -1, 0, 0, 1, 42, Pi / 4};  Cylinder(2) = {0, 0, -1, 0, 0, 1, 31, Pi / 4};
    BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };]], even(1), h, dotyk.material{ E = 2e3, nu = 0.4 })
  for _, b in ipairs{ flange, gasket } do
    b:part("first", at(2, 0)):slide()
    b:part("last", function(x, y) return math.abs(x - y) < 1e-6 end):slide()
  end
  gasket:part("middle", at(3, -1)):slide()
  flange:part("washer", function(x, y, z) return at(3, 12)(x, y, z) and math.sqrt((x - 48 * math.cos(math.pi / 8))^2 + (y - 48 * math.sin(math.pi / 8))^2) < 8 end):load{ 0, 0, -40 }
  flange:part("bore", round(30, 0)):pressure(4)
  flange:part("pipe", at(3, 45)):load{ 0, 0, 5 }
  return { flange, gasket }, { gasket:part("upper", at(3, 0)), flange:part("face", at(3, 0)) }
end

-- A quarter of a wheel's rim comes down on a quarter of a rail's head.
function parts.wheel(h, glued)
  local wheel = body("wheel", [[
    Cylinder(1) = {0, 0, 460, 0, 20, 0, 460};  Box(2) = {0, 0, 0, 40, 20, 40};
    BooleanIntersection(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };]], graded(0, 0, 0, 2.5, 25, 12), h)
  local rail = body("rail", [[
    Cylinder(1) = {0, 0, -300, 40, 0, 0, 300};  Box(2) = {0, 0, -40, 40, 20, 40};
    BooleanIntersection(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };]], graded(0, 0, 0, 2.5, 25, 12), h)
  for _, b in ipairs{ wheel, rail } do
    b:part("x", at(1, 0)):slide()
    b:part("y", at(2, 0)):slide()
  end
  rail:part("foot", at(3, -40)):fix()
  wheel:part("rim", at(3, 40)):displace{ x = 0, y = 0, z = -0.012 }
  local function near(x, y, z) return x^2 + y^2 < (glued and 1 or 2.5)^2 and math.abs(z) < 1 end
  return { wheel, rail }, { wheel:part("tread", near), rail:part("head", near) }
end

-- 3. The greatest edge for so many nodes. Gmsh takes minutes for hundreds of thousands of them. The edge then follows from two coarser meshes: the number of nodes is
-- nearly a power of it.
local function tried(part, count)
  local h, n = 3, 0
  for k = 1, 6 do
    if k > 1 then h = h * (n / count)^0.4 end
    n = 0
    for _, b in ipairs((parts[part](h))) do n = n + b.node_count end
    if math.abs(n / count - 1) < 0.03 then break end
  end
  return h, n
end

local coarse <const>, fine <const> = 6000, 20000
local function with_nodes(part, count)
  if count <= fine then return (tried(part, count)) end
  local h1 <const>, n1 <const> = tried(part, coarse)
  local h2 <const>, n2 <const> = tried(part, fine)
  return h2 * (h2 / h1)^(math.log(count / n2) / math.log(n2 / n1))
end

-- 4. One solve.
local function solved(part, h, join)
  local bodies <const>, pair <const> = parts[part](h, join.name == "glued")
  local scene <const> = dotyk.scene(bodies)
  join.make(scene, pair)
  local s <const> = method and method:solve(scene) or dotyk.solve(scene)
  assert(s.converged, part .. ", " .. join.name .. ": " .. s.reason)
  return s
end

local joins <const> = {
  { name = "glued", make = function(scene, pair) scene:glue(pair) end },
  { name = "contact", make = function(scene, pair) scene:contact{ pair[1], pair[2], interference = true } end },
  { name = "Coulomb", make = function(scene, pair) scene:contact{ pair[1], pair[2], interference = true, friction = dotyk.friction.coulomb(0.2) } end },
}

print "part        nodes        glued                  contact                    Coulomb 0.2      memory"
for _, count in ipairs(sizes) do
  for _, part in ipairs(names) do
    assert(parts[part], "there is no part " .. part)
    local h <const> = with_nodes(part, count)
    local seconds <const>, times <const>, iterations <const>, nodes = {}, {}, {}, nil
    for k in ipairs(joins) do seconds[k], times[k] = {}, {} end
    for run = 1, runs do
      for k, join in ipairs(joins) do
        local s <const> = solved(part, h, join)
        seconds[k][run] = s.time.total
        times[k][run] = seconds[k][run] / seconds[1][run]
        iterations[k] = (" %3d it"):format(s.iterations) .. (s.multigrid and (" %3d cg"):format(s.multigrid.cg) or "")
        nodes = nodes or s.unknowns // 3
      end
    end
    local line = ("%-8s %8d"):format(part, nodes)
    for k in ipairs(joins) do line = line .. ("  %8.2f s  x%.2f"):format(median(seconds[k]), median(times[k])) .. iterations[k] end
    print(line .. ("  %6.2f GB"):format(peak_memory()))
  end
end
