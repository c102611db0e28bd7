-- A dual number compared with another kind of table was an error about a field of that table.
local b <const> = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {-1,0}, to = {1,1}, cells = {4,2} }, material = dotyk.material{ E = 100, nu = 0.3 } }
b:part "top":load{ 0, -1 }
b:part "left":fix "x"
local scene <const> = dotyk.scene{ b }
scene:contact{ b:part "bottom", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} } }
local shape <const> = dotyk.shape{ scene = scene, moves = { { part = b:part "bottom", control_points = 4, direction = {0,1}, lower = 0, upper = 0.05 } } }
local c <const> = shape:design{ 0.01, 0, 0, 0.01 }.compliance
assert(c ~= dotyk and c ~= {} and not (dotyk == c) and c == c and c == c + 0)
