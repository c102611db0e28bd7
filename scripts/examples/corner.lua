-- A broken contact line: a wedge pressed into a notch.
--
--   ./dotyk scripts/examples/corner.lua [CELLS]
--
-- At the wedge's tip the contact line breaks: the tip gets one condition of non-penetration for each
-- adjoining side (Hlaváček, report 965, (1.23)), so it cannot slip through either. Shows both rows of
-- the tip, and images/corner.png.

local n <const> = tonumber(arg[1]) or 24
local steel <const> = dotyk.material{ E = 2000, nu = 0.3 }

-- 1. Two halves of a square, folded along the diagonal line y = |x|: the wedge above, the notch below.
local function fold(from, to)
  return dotyk.mesh.rectangle{ from = from, to = to, cells = {2 * n, n} }
    :transform(function(x, y) return x, y + math.abs(x) end)
end
local wedge = dotyk.body{ name = "wedge", material = steel, mesh = fold({-1, 0}, {1, 1}) }
local notch = dotyk.body{ name = "notch", material = steel, mesh = fold({-1, -1}, {1, 0}) }
notch:part"bottom":fix()
wedge:part"top":displace{ x = 0.01, y = -0.02 } -- down, and a little to the right

-- 2. Contact along the whole broken line.
local scene = dotyk.scene{ wedge, notch }
local contact = scene:contact{ wedge:part"bottom", notch:part"top" }
local s = dotyk.solve(scene)
print(s)

-- 3. The rows at the tip.
local c = s:contact(contact)
print "rows at the tip (normal out of the wedge):"
for _, node in ipairs(c.nodes) do
  if math.abs(node.x) < 1e-12 then
    print(("  normal (%6.3f, %6.3f)  gap %9.2e  force %8.4f  %s"):format(
      node.normal[1], node.normal[2], node.gap, node.force, node.status))
  end
end
print(("left flank carries %s, right flank %s"):format((function()
  local left, right = 0, 0
  for _, node in ipairs(c.nodes) do
    if node.normal[1] < 0 then left = left + node.force else right = right + node.force end
  end
  return ("%.4f"):format(left), ("%.4f"):format(right)
end)()))

s:render{ file = "images/corner.png", field = "von_mises", units = { length = "mm", stress = "MPa" } }
print "images/corner.png"
