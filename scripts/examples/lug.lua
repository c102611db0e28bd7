-- A lug pulled against a pin: a part with curved boundaries, meshed by Gmsh, in contact along an arc that it wraps round.
--
--   ./dotyk scripts/examples/lug.lua [SIZE] [FILE.msh]
--
-- Half of a steel lug, hole of radius R = 10 mm, outer radius 20 mm, plane stress, on a rigid frictionless pin. Nothing but
-- the pin keeps it from moving along the pull. With clearance between pin and hole, contact spreads as the load grows (an
-- advancing contact); with none it has its full size under the least load already, and everything is proportional to it: the
-- conditions are homogeneous then. A table shows both for three loads, beside the two pressures that are taken for design:
-- uniform on the projected area, F/(2R), and the cosine's, 4/π as much at its peak. A second table shows what cells of
-- second order, with curved sides on the arcs, are worth. SIZE is the greatest edge on the
-- arc, in mm; with FILE.msh the same lug is read instead: parts hole, symmetry and end. images/lug.png.

local size <const> = tonumber(arg[1]) or 0.25
local R <const>, outer <const>, length <const> = 10, 20, 45

-- 1. The geometry in Gmsh's language: fine where the pin presses, coarse at the far end. Physical names become parts.
local geometry <const> = [[
  R = %g; a = %g; L = %g; fine = %g; coarse = %g;
  Point(1) = {0, 0, 0};
  Point(2) = {-a, 0, 0, coarse};  Point(3) = {0, a, 0, coarse};  Point(4) = {L, a, 0, coarse};
  Point(5) = {L, 0, 0, coarse};   Point(6) = {R, 0, 0, 2 * fine};  Point(7) = {0, R, 0, fine};  Point(8) = {-R, 0, 0, fine};
  Circle(1) = {2, 1, 3};  Line(2) = {3, 4};  Line(3) = {4, 5};  Line(4) = {5, 6};
  Circle(5) = {6, 1, 7};  Circle(6) = {7, 1, 8};  Line(7) = {8, 2};
  Curve Loop(1) = {-7, -6, -5, -4, -3, -2, -1};
  Plane Surface(1) = {1};
  Physical Surface("lug") = {1};  Physical Curve("hole") = {5, 6};  Physical Curve("symmetry") = {4, 7};  Physical Curve("end") = {3};
]]
local function meshed(fine, coarse, order)
  return dotyk.mesh.gmsh{ text = geometry:format(R, outer, length, fine, coarse), order = order }
end
local mesh <const> = arg[2] and dotyk.mesh.load(arg[2]) or meshed(size, 2)
print(mesh)

-- 2. The lug on a pin that fills the hole but for the clearance, and touches it where it will press.
local steel <const> = dotyk.material{ E = 210e3, nu = 0.3, plane = "stress" }
local function pulled(force, clearance, mesh)
  local lug <const> = dotyk.body{ name = "lug", mesh = mesh, material = steel }
  lug:part "symmetry":slide()
  lug:part "end":load{ force / (2 * outer), 0 }  -- half of the force on half of the width
  local scene <const> = dotyk.scene{ lug }
  local pin <const> = dotyk.rigid.ball{ center = {-clearance, 0}, radius = R - clearance }
  local contact <const> = scene:contact{ lug:part "hole", rigid = pin }
  return dotyk.solve(scene), contact, lug
end

-- 3. Loads, with and without clearance.
local function half_angle(s, contact)
  local angle = 0
  for _, node in ipairs(s:contact(contact).nodes) do
    if node.status ~= "open" then angle = math.max(angle, math.deg(math.atan(node.y, -node.x))) end
  end
  return angle
end

print "clearance [mm]   force [N/mm]   half angle of contact [°]   peak pressure / (F/2R)   von Mises stress at the hole's side [MPa]"
local last
for _, clearance in ipairs{ 0.05, 0 } do
  for _, force in ipairs{ 200, 800, 3200 } do
    local s <const>, contact <const>, lug <const> = pulled(force, clearance, mesh)
    local c <const> = s:contact(contact)
    assert(s.converged and math.abs(2 * c.force[1] / force + 1) < 1e-8, "the pin bears what pulls")
    local stress <const> = s:stress(lug, 0, R).von_mises
    print(("%10g %16g %20.1f %26.3f %28.0f"):format(clearance, force, half_angle(s, contact), c.max_pressure / (force / (2 * R)), stress))
    if clearance > 0 then last = s end
  end
end
print(("cosine distribution: %.3f"):format(4 / math.pi))

-- 4. Cells of either order, the whole mesh finer and finer: 3200 N/mm, clearance 0.05 mm. The energy, how far the
-- end moves and the peak pressure are nearer their limits with order 2 for the same number of nodes; the von Mises stress at
-- the hole's side, where (0, R) is a corner of cells, is about alike.
if not arg[2] then
  print "cells  edge on the arc [mm]  nodes  seconds  displacement of the end [mm]  energy [N]  peak pressure [MPa]  von Mises [MPa]"
  for order, edges in ipairs{ { 4, 2, 1, 0.5 }, { 8, 4, 2, 1 } } do
    for _, times in ipairs(edges) do
      local m <const> = meshed(times * size, 4 * times * size, order)
      local start <const> = os.clock()
      local s <const>, contact <const>, lug <const> = pulled(3200, 0.05, m)
      local seconds <const>, u <const> = os.clock() - start, s:displacement(lug, length, 0)
      print(("%5s %21g %6d %8.2f %29.5f %11.3f %20.1f %16.1f"):format(m.element, times * size, m.node_count, seconds, u, s.energy,
        s:contact(contact).max_pressure, s:stress(lug, 0, R).von_mises))
    end
  end
end

last:render{ file = "images/lug.png", field = "von_mises", deform = 1, pressure = "arrows", units = { length = "mm", stress = "MPa" }, size = { 1200, 640 } }
print "images/lug.png"
