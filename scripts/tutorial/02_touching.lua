-- Tutorial 2: contact with a rigid obstacle, and what a solution tells about it.
--
--   ./dotyk scripts/tutorial/02_touching.lua

local block <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 210e3, nu = 0.3 },
  mesh = dotyk.mesh.rectangle{ from = { -10, -10 }, to = { 10, 0 }, cells = { 80, 40 } } }
block:part"bottom":fix()
local scene <const> = dotyk.scene{ block }

-- A rigid gap: along the normal each point of the part can move as far as the gap. Negative gaps press in: here a parabola, 0.02 mm deep.
-- Also dotyk.rigid.plane and dotyk.rigid.ball.
local punch <const> = dotyk.rigid.gap{ normal = { 0, 1 }, gap = function(x) return x^2 / 200 - 0.02 end }
local contact <const> = scene:contact{ block:part"top", rigid = punch }
local s <const> = dotyk.solve(scene)

-- The contact as a whole, and node by node: pressure is positive in compression, a gap positive when open.
local c <const> = s:contact(contact)
print(("%d nodes closed, %d open; force %.2f N/mm, greatest pressure %.1f MPa"):format(c.closed, c.open, -c.force[2], c.max_pressure))
print "     x       gap  pressure  status"
for k, n in ipairs(c.nodes) do
  if k % 4 == 1 and math.abs(n.x) < 4 then print(("%6.2f %9.5f %9.2f  %s"):format(n.x, n.gap, n.pressure, n.status)) end
  assert(n.pressure >= -1e-9 and n.gap > -1e-9 and math.min(n.pressure, n.gap) < 1e-9) -- never both
end

-- What acts on the block is what its support gives back.
local _, reaction <const> = s:reaction(block:part"bottom")
assert(math.abs(reaction + c.force[2]) < 1e-8 * math.abs(reaction))
print("wrote", s:render{ file = "images/tutorial_02.png", units = { length = "mm", stress = "MPa" }, title = "A parabola pressed into a block" })
-- For a column of a journal, 85 mm wide: lines and texts of a PDF (or SVG) stay sharp.
print("wrote", s:render{ file = "images/tutorial_02.pdf", width = 85, units = { length = "mm", stress = "MPa" } })
local file <const> = os.tmpname()
s:write_contact(file) -- the same as a table, for other programs
print("the first line of the table: " .. io.lines(file)())
os.remove(file)
