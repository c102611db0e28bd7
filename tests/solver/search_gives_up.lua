-- A block in a corner in space that friction hardly holds, if at all: what its pieces are searched by ends after some seconds' work, and says so.
local check <const> = require "check"

local block <const> = dotyk.body{ name = "b", material = dotyk.material{ E = 1000, nu = 0.3 },
  mesh = dotyk.mesh.box{ from = { 0, 0, 0 }, to = { 1, 0.5135, 1.0105 }, cells = { 3, 2, 2 } } }
block:part"top":load{ -0.9663, 0, -1 }
block:part"right":load(function(_, y) return 0, 1.0476, 3.3717 * (y - 0.3) end)
local scene <const> = dotyk.scene{ block }
scene:contact{ block:part"bottom", rigid = dotyk.rigid.plane{ point = { 0, 0, 0 }, normal = { 0, 0, 1 } }, friction = dotyk.friction.coulomb(0.8712) }
scene:contact{ block:part"left", rigid = dotyk.rigid.plane{ point = { 0, 0, 0 }, normal = { 1, 0, 0 } }, friction = dotyk.friction.coulomb(0.5358) }

local solved <const>, s = pcall(dotyk.solve, scene)
local said <const> = solved and s.reason or tostring(s)
local programmes <const> = tonumber(said:match"(%d+) linear programmes") or 0
check.equal(programmes < 2000, true, said)
check.equal(solved and not s.converged and not said:find"a search of pieces", false, said)
