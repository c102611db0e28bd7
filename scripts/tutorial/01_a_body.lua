-- Tutorial 1: an elastic body. Mesh, material, supports, load, solution, picture.
--
--   ./dotyk scripts/tutorial/01_a_body.lua
--
-- The same lines can be typed at the prompt (./dotyk); help(dotyk.body) there explains any of the words.

-- A mesh of triangles with parts left, right, bottom, top. Units are yours: here N and mm, so stresses are in MPa.
local mesh <const> = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 100, 20 }, cells = { 50, 10 } }
local steel <const> = dotyk.material{ E = 210e3, nu = 0.3, plane = "stress" }

-- A body is a mesh with a material. Its parts take supports and loads.
local bracket <const> = dotyk.body{ name = "bracket", mesh = mesh, material = steel }
bracket:part"left":fix()
bracket:part"top":load{ 0, -1 } -- per length: 1 N/mm on a plate 1 mm thick

-- A scene is what is solved together. Its plan says what it is, what is free to move and how it is solved.
local scene <const> = dotyk.scene{ bracket }
print(scene:plan())

local s <const> = dotyk.solve(scene)
print(s)
local _, tip <const> = s:displacement(bracket, 100, 20)
local _, force <const> = s:reaction(bracket:part"left")
print(("the tip sinks by %.4f mm, the support bears %.3f N, von Mises stress at (20, 18) is %.2f MPa"):format(
  -tip, force, s:stress(bracket, 20, 18).von_mises))

-- The load is 100 N. A beam's tip would sink by q L⁴/(8 E I), and by shear q L²/(2 κ G A).
local E <const>, G <const>, I <const>, A <const> = 210e3, 210e3 / 2.6, 20^3 / 12, 20
print(("beam theory: %.4f mm"):format(100^4 / (8 * E * I) + 100^2 / (2 * 5 / 6 * G * A)))
assert(math.abs(force - 100) < 1e-9)

print("wrote", s:render{ file = "images/tutorial_01.png", deform = "auto", supports = true, loads = true, units = { length = "mm", stress = "MPa" }, title = "A bracket under its load" })
