-- Tutorial 8: three dimensions, symmetry, files for other programs, and more processes.
--
--   ./dotyk scripts/tutorial/08_space.lua

-- A quarter of a block under a rigid ball: what is symmetric slides along the planes of symmetry. Cells get smaller towards the ball:
-- a grading maps [0, 1] onto itself.
local function towards_start(s) return s^2 end
local function towards_end(s) return 1 - (1 - s)^2 end
local function pressed(refine)
  local block <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 }, refine = refine,
    mesh = dotyk.mesh.box{ from = { 0, 0, -1 }, to = { 1, 1, 0 }, cells = { 10, 10, 10 }, element = "Q1",
                           grading = { x = towards_start, y = towards_start, z = towards_end } } }
  block:part"bottom":fix()
  block:part"left":slide()
  block:part"front":slide()
  local scene <const> = dotyk.scene{ block }
  return scene, scene:contact{ block:part"top", rigid = dotyk.rigid.ball{ center = { 0, 0, 1.97 }, radius = 2 }, interference = true }
end
local scene <const>, contact <const> = pressed(0)
local s <const> = dotyk.solve(scene)

-- Hertz: F = 4/3 E* √R d^{3/2}, of which the quarter bears a fourth; the block is no half-space, and the mesh is coarse.
local force <const>, d <const> = -4 * s:contact(contact).force[3], 0.03
local hertz <const> = 4 / 3 * 1000 / (1 - 0.3^2) * math.sqrt(2) * d^1.5
print(("force %.2f, by Hertz %.2f: a block 1 thick on a rigid base is %.0f %% stiffer than a half-space"):format(force, hertz, 100 * (force / hertz - 1)))
assert(force > hertz and force < 2 * hertz)

print("wrote", s:render{ file = "images/tutorial_08.png", title = "A quarter of a block under a ball", view = { 2, -3, 2 } })
-- What happens in the contact, on a map of it; and a cut through the block, whose inside is seen then.
local units <const> = { length = "mm", stress = "MPa" }
print("wrote", dotyk.pictures{ file = "images/tutorial_08_contact.png",
  s:picture{ map = contact, units = units, window = { 0, 0, 0.5, 0.5 }, isolines = true, title = "Contact pressure" },
  s:picture{ units = units, cut = { point = { 0, 0.15, 0 }, normal = { 0, -1, 0 } }, view = { 1, -2, 1 }, title = "A cut" } })
local vtu <const> = os.tmpname() .. ".vtu"
s:write(vtu) -- for ParaView
print "wrote a .vtu file for ParaView"
os.remove(vtu)

-- refine = 1 cuts all cells once, each into 8. Where several processes work, each of them cuts a share and solves for it; the script stays as it is:
--   ./dotyk --ranks 2 scripts/tutorial/08_space.lua
-- or dotyk.ranks(2) in the first line.
local refined <const>, touching <const> = pressed(1)
local fine <const> = dotyk.solve(refined)
print(("refined once, %d unknowns in place of %d: force %.2f in %.1f s; processes: %d"):format(fine.unknowns, s.unknowns,
  -4 * fine:contact(touching).force[3], fine.time.total, dotyk.ranks()))
